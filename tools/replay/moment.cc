#include "tools/replay/moment.h"

#include <cassert>

namespace nanomap {

void takeMoment(const Pipeline& pipeline, std::optional<Time> now, const std::optional<Goal>& other_goal,
                Moment& moment) {
  assert(pipeline.state());
  pipeline.chain().snapshotInto(moment.snapshot);
  moment.now = now.value_or(moment.snapshot.stamp);
  moment.state = *pipeline.state();
  moment.goal = other_goal ? other_goal : pipeline.goal();
  if (other_goal) moment.goal->epoch = moment.state.epoch;
}

}  // namespace nanomap
