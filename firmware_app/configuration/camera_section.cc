#include <cmath>

#include "firmware_app/configuration/camera_mount.h"
#include "firmware_app/configuration/sections.h"

namespace nanomap {
namespace {

constexpr NumberRule kFocalLength{0.0, 100'000.0, true};
constexpr NumberRule kPrincipalPoint{-100'000.0, 100'000.0};
constexpr double kFullTurn_deg = 360.0;

/// Angles are printed to a billionth of a degree, so that what was written as 15.0 reads 15.0.
double rounded(double angle_deg) { return std::round(angle_deg * 1e9) / 1e9; }

Key required(Key key) {
  key.presence = Presence::kRequired;
  return key;
}

Key distortionKey() {
  return {"distortion", "Brown-Conrady coefficients k1, k2, p1, p2, k3 (OpenCV's order and sign).",
          NumbersRule{5, {-100.0, 100.0}},
          [](const Configuration& c) {
            const Distortion& d = c.camera->distortion;
            return Value(std::vector<double>{d.k1, d.k2, d.p1, d.p2, d.k3});
          },
          [](Configuration& c, const Value& value) {
            const auto& list = std::get<std::vector<double>>(value);
            c.camera->distortion = {list[0], list[1], list[2], list[3], list[4]};
          }};
}

Key noReturnKey() {
  return {"no_return_values", "Raw values that mean \"no depth\".", IntegersRule{16, {0, 65535}},
          [](const Configuration& c) {
            const auto& raw = c.camera->no_return_values;
            return Value(std::vector<std::int64_t>(raw.begin(), raw.end()));
          },
          [](Configuration& c, const Value& value) {
            c.camera->no_return_values.clear();
            for (const std::int64_t raw : std::get<std::vector<std::int64_t>>(value)) {
              c.camera->no_return_values.push_back(static_cast<std::uint16_t>(raw));
            }
          }};
}

Key positionKey() {
  return {"position_m", "The camera's place in the body frame: forward, left, up.", NumbersRule{3, {-100.0, 100.0}},
          [](const Configuration& c) {
            const Vec3& p_B = c.camera->T_B_C.translation_m;
            return Value(std::vector<double>{p_B.x(), p_B.y(), p_B.z()});
          },
          [](Configuration& c, const Value& value) {
            const auto& list = std::get<std::vector<double>>(value);
            c.camera->T_B_C.translation_m = {list[0], list[1], list[2]};
          }};
}

Key mountAnglesKey() {
  return {
      "mount_roll_pitch_yaw_deg",
      "Turn against a camera that looks straight ahead: roll about forward, then pitch about left (positive\n"
      "tilts the view down), then yaw about up (positive turns it left), about the body's axes.",
      NumbersRule{3, {-kFullTurn_deg, kFullTurn_deg}},
      [](const Configuration& c) {
        const MountAngles angles = anglesOfMount(c.camera->T_B_C.rotation);
        return Value(std::vector<double>{rounded(angles.roll_deg), rounded(angles.pitch_deg), rounded(angles.yaw_deg)});
      },
      [](Configuration& c, const Value& value) {
        const auto& list = std::get<std::vector<double>>(value);
        c.camera->T_B_C.rotation = rotationOfMount({list[0], list[1], list[2]});
      }};
}

Key rotationKey() {
  return {"rotation_wxyz",
          "Instead of the angles: unit quaternion w, x, y, z from the camera's axes (right, down, forward) to the\n"
          "body's (forward, left, up). Straight ahead is [0.5, -0.5, 0.5, -0.5].",
          NumbersRule{4, {-1.0, 1.0}},
          [](const Configuration& c) {
            const Quat& q = c.camera->T_B_C.rotation;
            return Value(std::vector<double>{q.w(), q.x(), q.y(), q.z()});
          },
          [](Configuration& c, const Value& value) {
            const auto& list = std::get<std::vector<double>>(value);
            c.camera->T_B_C.rotation = Quat(list[0], list[1], list[2], list[3]);
          },
          Presence::kAlternative};
}

void createCamera(Configuration& c) {
  c.camera.emplace();
  c.camera->T_B_C.rotation = rotationOfMount({});
}

/// A stereo depth camera of 87 degrees, looking straight ahead.
void fillExample(Configuration& c) {
  createCamera(c);
  c.camera->width_px = 424;
  c.camera->height_px = 240;
  c.camera->fx_px = 223.0;
  c.camera->fy_px = 223.0;
  c.camera->cx_px = 211.5;
  c.camera->cy_px = 119.5;
  c.camera->T_B_C.translation_m = {0.1, 0.0, 0.03};
  c.camera->min_range_m = 0.3;
  c.camera->max_range_m = 10.0;
}

}  // namespace

Section cameraSection() {
  return {"camera",
          "The depth camera. Without this section the camera's own message says what it is (lcm.camera_channel).\n"
          "Pixel centres are at integer coordinates.",
          {required(integerKey(
               "width_px", "Image width.", {1, 8192}, [](auto& c) -> auto& { return c.camera->width_px; })),
           required(integerKey(
               "height_px", "Image height.", {1, 8192}, [](auto& c) -> auto& { return c.camera->height_px; })),
           required(numberKey(
               "fx_px", "Focal length, horizontal.", kFocalLength, [](auto& c) -> auto& { return c.camera->fx_px; })),
           required(numberKey(
               "fy_px", "Focal length, vertical.", kFocalLength, [](auto& c) -> auto& { return c.camera->fy_px; })),
           required(numberKey(
               "cx_px", "Principal point, column.", kPrincipalPoint, [](auto& c) -> auto& { return c.camera->cx_px; })),
           required(numberKey(
               "cy_px", "Principal point, row.", kPrincipalPoint, [](auto& c) -> auto& { return c.camera->cy_px; })),
           distortionKey(),
           numberKey(
               "depth_unit_m", "Metres per count of the depth image.", {0.0, 1.0, true},
               [](auto& c) -> auto& { return c.camera->depth_unit_m; }),
           numberKey(
               "min_range_m", "Nearest depth to be trusted, along the optical axis.", {0.0, 1000.0},
               [](auto& c) -> auto& { return c.camera->min_range_m; }),
           required(numberKey(
               "max_range_m", "Farthest depth to be trusted, along the optical axis; above min_range_m.",
               {0.0, 1000.0, true}, [](auto& c) -> auto& { return c.camera->max_range_m; })),
           noReturnKey(), positionKey(), mountAnglesKey(), rotationKey()},
          Section::Optional{[](const Configuration& c) { return c.camera.has_value(); }, createCamera, fillExample}};
}

}  // namespace nanomap
