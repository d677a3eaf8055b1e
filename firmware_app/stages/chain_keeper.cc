#include "firmware_app/stages/chain_keeper.h"

#include <utility>
#include <variant>

namespace nanomap {

ChainKeeper::ChainKeeper(const ChainParameters& parameters, const StuckDepthParameters& stuck_depth, bool camera_known,
                         const ChainPorts& ports)
    : stage_(parameters, stuck_depth), ports_(ports), camera_known_(camera_known) {}

std::size_t ChainKeeper::run(Time now) {
  std::size_t taken = 0;
  while (ports_.inputs.pop([&](const ArrivedInput& arrived) { take(arrived, now); })) ++taken;
  while (ports_.indexed.pop([&](IndexedFrame& arrived) { take(arrived, now); })) ++taken;
  if (views_entered_ > 0 && stage_.state()) askForAPlan();
  if (taken > 0) ports_.counters.put([this](ChainStageCounters& slot) { slot = stage_.counters(); });
  return taken;
}

void ChainKeeper::take(const ArrivedInput& arrived, Time now) {
  const auto kind = static_cast<InputKind>(arrived.input.index());
  noteStep(kind, arrived.arrival, arrived.stamp_shift, now);
  if (const auto* pose = std::get_if<PoseInput>(&arrived.input)) {
    views_entered_ += stage_.take(*pose);
    report();
  } else if (const auto* correction = std::get_if<Correction>(&arrived.input)) {
    views_entered_ += stage_.take(*correction);
  } else if (const auto* goal = std::get_if<Goal>(&arrived.input)) {
    views_entered_ += stage_.take(*goal);
  }
}

void ChainKeeper::take(IndexedFrame& arrived, Time now) {
  noteStep(arrived.kind, arrived.arrival, arrived.stamp_shift, now);
  camera_known_ = arrived.camera_known;
  if (arrived.kind == InputKind::kDepth) newest_frame_ = arrived.arrival;
  if (arrived.view) views_entered_ += stage_.take(std::exchange(arrived.view, nullptr));
}

void ChainKeeper::noteStep(InputKind kind, Time arrival, Duration stamp_shift, Time now) {
  ++steps_;
  ports_.steps.push([&](Step& slot) { slot = {now, steps_, kind, arrival, stamp_shift}; });
}

void ChainKeeper::report() {
  ports_.vehicle.push([this](VehicleReport& slot) {
    slot.camera = camera_known_;
    slot.camera_stuck = stage_.isCameraStuck();
    slot.state = stage_.state();
    slot.newest_view = stage_.newestView();
  });
}

void ChainKeeper::askForAPlan() {
  views_entered_ = 0;
  ports_.moments.put([this](PlanningMoment& moment) {
    stage_.chain().snapshotInto(moment.snapshot);
    moment.state = *stage_.state();
    moment.goal = stage_.goal();
    moment.step = steps_;
    moment.newest_frame = newest_frame_.value_or(Time{});
    moment.newest_view = stage_.newestView().value_or(moment.snapshot.stamp);
    ports_.newest.put([&](ChainSnapshot& newest) {
      newest.stamp = moment.snapshot.stamp;
      newest.T_W_B = moment.snapshot.T_W_B;
      newest.epoch = moment.snapshot.epoch;
      newest.views.assign(moment.snapshot.views.begin(),
                          moment.snapshot.views.begin() + !moment.snapshot.views.empty());
    });
  });
  ports_.planner_bell.ring();
}

}  // namespace nanomap
