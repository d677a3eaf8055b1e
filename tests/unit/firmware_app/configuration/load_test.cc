#include "firmware_app/configuration/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace nanomap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Configuration parsed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parseConfiguration(text, "drone.toml", overrides);
}

/// What the text is refused with; empty if it is accepted.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)parsed(text, overrides);
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

const std::string kCamera =
    "[camera]\nwidth_px = 64\nheight_px = 48\nfx_px = 60\nfy_px = 60\ncx_px = 31.5\ncy_px = 23.5\nmax_range_m = 10\n";

TEST(Load, EmptyFileGivesCoresDefaults) {
  const Configuration configuration = parsed("");
  EXPECT_FALSE(configuration.camera);
  EXPECT_EQ(configuration.chain.history_views, ChainParameters{}.history_views);
  EXPECT_EQ(configuration.chain.waiting_views, ChainParameters{}.waiting_views);
  EXPECT_EQ(configuration.chain.pose_capacity, ChainParameters{}.pose_capacity);
  EXPECT_EQ(configuration.chain.max_pose_gap, ChainParameters{}.max_pose_gap);
  EXPECT_EQ(configuration.chain.max_lead, ChainParameters{}.max_lead);
  EXPECT_EQ(configuration.chain.drift.horizontal_std_m, DriftModel{}.horizontal_std_m);
  EXPECT_EQ(configuration.chain.drift.vertical_std_m, DriftModel{}.vertical_std_m);
  EXPECT_EQ(configuration.chain.drift.after, DriftModel{}.after);
  EXPECT_EQ(configuration.chain.drift.law, DriftModel{}.law);
  EXPECT_EQ(configuration.chain.drift.use_increments, DriftModel{}.use_increments);
  EXPECT_EQ(configuration.planner.risk.query.k, QueryOptions{}.k);
  EXPECT_EQ(configuration.index, IndexKind::kImage);
  EXPECT_EQ(configuration.planner.risk.query.occlusion, QueryOptions{}.occlusion);
  EXPECT_EQ(configuration.planner.risk.query.open_window_px, QueryOptions{}.open_window_px);
  EXPECT_EQ(configuration.planner.risk.query.open_range_fraction, QueryOptions{}.open_range_fraction);
}

TEST(Load, EveryTypeOfValueArrives) {
  const Configuration configuration = parsed(
      "[history]\nviews = 300\nmax_pose_gap_s = 0.25\n[drift]\nlaw = \"linear\"\nuse_increments = true\nafter_s = 2\n"
      "[lcm]\npose_channel = \"VIO\"\n");
  EXPECT_EQ(configuration.chain.history_views, 300U);
  EXPECT_EQ(configuration.chain.max_pose_gap, std::chrono::milliseconds(250));
  EXPECT_EQ(configuration.chain.drift.law, GrowthLaw::kLinear);
  EXPECT_TRUE(configuration.chain.drift.use_increments);
  EXPECT_EQ(configuration.chain.drift.after, std::chrono::seconds(2));
  EXPECT_EQ(configuration.lcm.pose_channel, "VIO");
}

TEST(Load, VehicleAndPlannerArriveWhereThePlannerReadsThem) {
  const PlannerParameters planner =
      parsed(
          "[vehicle]\nradius_m = 0.3\nbubble_margin_m = 0.5\n[planner]\nstop_check = \"paper\"\nsamples = 40\n"
          "max_state_age_s = 0.5\n[limits]\njerk_m_s3 = 40\n[horizon]\nmax_s = 3\n[goal_directed]\n"
          "approach_s = 2\n[objective]\ncollision_reward = -10\n[risk]\nmax_risk = 0.01\n"
          "collision_model = \"half_spaces\"\nprior_hole = 0.25\nprior_beyond_range = 0.5\n"
          "vertical_per_time_m_s = 0.3\n[heading]\nreach_s = 1\n")
          .planner;
  EXPECT_EQ(planner.risk.collision.vehicle_radius_m, 0.3);
  EXPECT_EQ(planner.risk.bubble_margin_m, 0.5);
  EXPECT_EQ(planner.stop_check, StopCheck::kPaper);
  EXPECT_EQ(planner.samples, 40);
  EXPECT_EQ(planner.max_state_age, std::chrono::milliseconds(500));
  EXPECT_EQ(planner.limits.jerk_m_s3, 40.0);
  EXPECT_EQ(planner.horizon.max_s, 3.0);
  EXPECT_EQ(planner.goal_directed.approach_s, 2.0);
  EXPECT_EQ(planner.objective.collision_reward, -10.0);
  EXPECT_EQ(planner.risk.max_risk, 0.01);
  EXPECT_EQ(planner.risk.collision.model, CollisionModel::kHalfSpaces);
  EXPECT_EQ(planner.risk.prior[static_cast<std::size_t>(Status::kHole)], 0.25);
  EXPECT_EQ(planner.risk.prior[static_cast<std::size_t>(Status::kBeyondRange)], 0.5);
  EXPECT_EQ(planner.risk.prior[static_cast<std::size_t>(Status::kOccluded)], 1.0);
  EXPECT_EQ(planner.risk.vertical.per_time_m_s, 0.3);
  EXPECT_EQ(planner.heading.reach_s, 1.0);
}

TEST(Load, PlannerParametersMustFitEachOther) {
  EXPECT_THAT(refusal("[limits]\nhorizontal_at_rest_m_s2 = 9\n"), HasSubstr("limits.horizontal_at_full_m_s2"));
  EXPECT_THAT(refusal("", {"planner.brake_after_s=2"}), HasSubstr("horizon.push_s"));
  EXPECT_THAT(refusal("", {"risk.max_risk=1.5"}), HasSubstr("must be a number, 0 .. 1"));
}

TEST(Load, CameraKeepsDefaultsOfWhatItDoesNotSay) {
  const Configuration configuration = parsed(kCamera);
  ASSERT_TRUE(configuration.camera);
  EXPECT_EQ(configuration.camera->width_px, 64);
  EXPECT_EQ(configuration.camera->depth_unit_m, CameraParameters{}.depth_unit_m);
  EXPECT_EQ(configuration.camera->no_return_values, CameraParameters{}.no_return_values);
  EXPECT_LT((configuration.camera->T_B_C.rotation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-12);
}

TEST(Load, CameraListsArrive) {
  const Configuration configuration =
      parsed(kCamera + "distortion = [0.1, 0, 0.01, 0, 0]\nno_return_values = [0]\nposition_m = [0.1, 0.2, 0.3]\n" +
             "rotation_wxyz = [1, 0, 0, 0]\n");
  EXPECT_EQ(configuration.camera->distortion.k1, 0.1);
  EXPECT_EQ(configuration.camera->distortion.p1, 0.01);
  EXPECT_EQ(configuration.camera->no_return_values, std::vector<std::uint16_t>{0});
  EXPECT_EQ(configuration.camera->T_B_C.translation_m, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(configuration.camera->T_B_C.rotation.w(), 1.0);
}

TEST(Load, CameraWithoutARequiredKeySaysWhich) {
  EXPECT_EQ(refusal("\n[camera]\nwidth_px = 64\nheight_px = 48\nfx_px = 60\nfy_px = 60\ncx_px = 1\ncy_px = 1\n"),
            "drone.toml:3: [camera] needs 'camera.max_range_m', a number, above 0, up to 1000");
  EXPECT_THAT(refusal("[camera]\n"), HasSubstr("drone.toml:1: [camera] needs 'camera.width_px'"));
}

TEST(Load, CameraRangesMustBeInOrder) {
  EXPECT_THAT(refusal(kCamera + "min_range_m = 10\n"), AllOf(HasSubstr("[camera]"), HasSubstr("max_range_m")));
}

TEST(Load, CameraRotationMustBeAUnitQuaternion) {
  EXPECT_THAT(refusal(kCamera + "rotation_wxyz = [1, 1, 0, 0]\n"), HasSubstr("unit quaternion"));
}

TEST(Load, CameraTakesAnglesOrQuaternionNotBoth) {
  EXPECT_THAT(refusal(kCamera + "mount_roll_pitch_yaw_deg = [0, 10, 0]\nrotation_wxyz = [1, 0, 0, 0]\n"),
              AllOf(HasSubstr("drone.toml:10"), HasSubstr("keep one")));
}

TEST(Load, ChannelsMustDiffer) {
  EXPECT_THAT(refusal("[lcm]\npose_channel = \"DEPTH\"\n"), HasSubstr("[lcm]: two channels are named 'DEPTH'"));
}

TEST(Load, RecordingsNeedRoomForTwoFiles) {
  EXPECT_THAT(refusal("[recorder]\nsegment_mb = 100\ntotal_mb = 199\n"), HasSubstr("at least twice segment_mb = 100"));
  EXPECT_EQ(parseConfiguration("[recorder]\nsegment_mb = 100\ntotal_mb = 200\n", "x").recorder.total_mb, 200U);
}

TEST(Load, OdometryHasNoHalfOfACovariance) {
  EXPECT_THAT(refusal("[mavlink]\nodometry_position_sd_m = 0.1\n"), HasSubstr("odometry_attitude_sd_rad"));
  EXPECT_THAT(refusal("[mavlink]\nodometry_attitude_sd_rad = 0.1\n"), HasSubstr("odometry_position_sd_m"));
  const std::string both = "[mavlink]\nodometry_position_sd_m = 0.1\nodometry_attitude_sd_rad = 0.02\n";
  EXPECT_EQ(parseConfiguration(both, "x").mavlink.odometry.attitude_sd_rad, 0.02);
}

TEST(Load, AlignmentIsNotSilentByTheRateOfItsOwnStream) {
  EXPECT_THAT(refusal("[mavlink]\npose_rate_hz = 5\n"), HasSubstr("max_age_s = 0.5 must be at least 4 /"));
  EXPECT_EQ(parseConfiguration("[mavlink]\npose_rate_hz = 8\n", "x").mavlink.link.pose_rate_hz, 8.0);
  EXPECT_EQ(refusal("[mavlink]\npose_rate_hz = 5\n[alignment]\nmax_age_s = 0.8\n"), "");
}

TEST(Load, NoPlanIsToldWithTheAccelerationOfItsBrake) {
  EXPECT_THAT(refusal("[mavlink]\ntilt_lag_s = 0.2\n"),
              HasSubstr("[planner]: brake_after_s = 0.25 must be at least 0.365, safety.max_plan_age_s with"));
  EXPECT_EQ(refusal("[mavlink]\ntilt_lag_s = 0.2\n[planner]\nbrake_after_s = 0.365\n"), "");
  EXPECT_EQ(refusal("[mavlink]\ntilt_lag_s = 0.2\n[safety]\nmax_plan_age_s = 0.03\n"), "");
  EXPECT_THAT(refusal("[safety]\nmax_plan_age_s = 0.2\n"), HasSubstr("must be at least 0.295"));
}

TEST(Load, UnknownKeySuggestsTheOneMeant) {
  EXPECT_EQ(refusal("[history]\n\nveiws = 3\n"),
            "drone.toml:3: unknown key 'history.veiws': did you mean 'history.views'?");
}

TEST(Load, UnknownKeyFarFromAllListsItsSection) {
  EXPECT_THAT(refusal("[query]\nzzzzzzzz = 3\n"), AllOf(HasSubstr("drone.toml:2: unknown key 'query.zzzzzzzz'"),
                                                        HasSubstr("[query] has index, k, occlusion")));
}

TEST(Load, KeyInAMisspeltSectionSuggestsTheSection) {
  EXPECT_THAT(refusal("[histroy]\nviews = 3\n"), HasSubstr("did you mean 'history.views'?"));
  EXPECT_THAT(refusal("[histroy]\n"), HasSubstr("unknown section 'histroy': did you mean 'history'?"));
}

TEST(Load, KeyOutsideAnySectionListsTheSections) {
  EXPECT_THAT(refusal("zzzzzzzz = 150\n"), HasSubstr("the sections are camera, vehicle, history"));
}

TEST(Load, SectionGivenAsAValueIsExplained) {
  EXPECT_THAT(refusal("history = 150\n"),
              AllOf(HasSubstr("drone.toml:1"), HasSubstr("'history' is a section"), HasSubstr("150")));
}

TEST(Load, WrongTypeNamesKeyValueAndType) {
  EXPECT_EQ(refusal("[history]\nviews = \"many\"\n"),
            "drone.toml:2: history.views = 'many': must be an integer, 1 .. 2000");
  EXPECT_THAT(refusal("[history]\nviews = 1.5\n"), HasSubstr("history.views = 1.5: must be an integer"));
  EXPECT_THAT(refusal("[history]\nviews = 2026-01-01\n"), HasSubstr("must be an integer"));
  EXPECT_THAT(refusal("[history]\nviews = [1]\n"), HasSubstr("must be an integer"));
  EXPECT_THAT(refusal("[drift]\nuse_increments = 1\n"), HasSubstr("must be true or false"));
  EXPECT_THAT(refusal(kCamera + "no_return_values = [0, \"x\"]\n"), HasSubstr("must be at most 16 integers"));
}

TEST(Load, OutOfRangeNamesKeyValueAndRange) {
  EXPECT_EQ(refusal("[query]\nk = 17\n"), "drone.toml:2: query.k = 17: must be an integer, 1 .. 16");
  EXPECT_THAT(refusal("[drift]\nlaw = \"cubic\"\n"), HasSubstr("must be \"square_root\" or \"linear\""));
}

TEST(Load, NanAndInfinityAreRefused) {
  EXPECT_THAT(refusal("[vehicle]\nradius_m = nan\n"), HasSubstr("vehicle.radius_m = nan: must be"));
  EXPECT_THAT(refusal("[vehicle]\nradius_m = inf\n"), HasSubstr("vehicle.radius_m = inf: must be"));
  EXPECT_THAT(refusal("[vehicle]\nradius_m = -inf\n"), HasSubstr("must be"));
}

TEST(Load, EveryFaultIsReportedAtOnce) {
  EXPECT_THAT(refusal("[query]\nk = 0\n[history]\nviews = 0\nveiws = 1\n"),
              AllOf(HasSubstr("drone.toml:2"), HasSubstr("drone.toml:4"), HasSubstr("drone.toml:5")));
}

TEST(Load, TextThatIsNotTomlSaysWhere) {
  EXPECT_THAT(refusal("[query]\nk = = 3\n"), HasSubstr("drone.toml:2: "));
  EXPECT_THAT(refusal("[query]\nk = 3\nk = 4\n"), HasSubstr("drone.toml:3: "));
}

TEST(Load, OverrideWinsOverTheFile) {
  EXPECT_EQ(parsed("[history]\nviews = 300\n", {"history.views=20"}).chain.history_views, 20U);
  EXPECT_EQ(parsed("", {"history.views=20", "history.views=30"}).chain.history_views, 30U);
}

TEST(Load, OverrideReplacesAWrongValueOfTheFile) {
  EXPECT_EQ(parsed("[query]\nk = 0\n", {"query.k=4"}).planner.risk.query.k, 4);
  EXPECT_EQ(parsed("[query]\n", {"query.index=flann"}).index, IndexKind::kFlann);
}

TEST(Load, OverrideNeedsNoQuotes) {
  EXPECT_EQ(parsed("", {"drift.law=linear"}).chain.drift.law, GrowthLaw::kLinear);
  EXPECT_EQ(parsed("", {"drift.law=\"linear\""}).chain.drift.law, GrowthLaw::kLinear);
}

TEST(Load, OverrideTakesPartInTheChecks) {
  EXPECT_EQ(refusal("", {"query.k=17"}), "--set: query.k = 17: must be an integer, 1 .. 16");
  EXPECT_THAT(refusal("", {"query.kk=1"}), HasSubstr("--set: unknown key 'query.kk': did you mean 'query.k'?"));
  EXPECT_THAT(refusal("", {"query.k"}), HasSubstr("section.key=value"));
  EXPECT_THAT(refusal("", {"=3"}), HasSubstr("section.key=value"));
  EXPECT_THAT(refusal("", {"query.k="}), HasSubstr("must be an integer"));
  EXPECT_THAT(refusal("", {"query.k=1\nother = 2"}), HasSubstr("must be an integer"));
}

TEST(Load, OverridesCanGiveAWholeCamera) {
  const Configuration configuration =
      parsed("", {"camera.width_px=4", "camera.height_px=3", "camera.fx_px=4", "camera.fy_px=4", "camera.cx_px=1.5",
                  "camera.cy_px=1", "camera.max_range_m=8"});
  EXPECT_EQ(configuration.camera->max_range_m, 8.0);
}

TEST(Load, MissingFileIsNamed) {
  try {
    (void)loadConfiguration("/nonexistent/drone.toml");
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("/nonexistent/drone.toml"), HasSubstr("cannot be read")));
  }
}

TEST(Load, FolderIsNotAFile) { EXPECT_THROW((void)loadConfiguration(::testing::TempDir()), ConfigurationError); }

TEST(Load, EmptyPathMeansDefaultsAndOverrides) {
  EXPECT_EQ(loadConfiguration({}, {"history.views=7"}).chain.history_views, 7U);
}

TEST(Load, FileOnDiskIsRead) {
  const std::string path = ::testing::TempDir() + "load_test.toml";
  std::ofstream(path) << "[history]\nviews = 11\n";
  EXPECT_EQ(loadConfiguration(path).chain.history_views, 11U);
}

}  // namespace
}  // namespace nanomap
