#include "tools/replay/answers.h"

#include <cassert>
#include <cstdint>

#include "drivers/lcm/convert.h"

namespace nanomap {
namespace {

void store(const Vec3& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

void store(const Mat3& from, double (&to)[9]) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) to[3 * row + column] = from(row, column);
  }
}

answer_t toAnswer(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryReply& reply) {
  answer_t answer{};
  store(x_B.mean_m, answer.mean_body);
  store(x_B.covariance_m2, answer.covariance_body);
  answer.status = static_cast<std::int8_t>(reply.status);
  answer.has_view = reply.view_index.has_value() ? 1 : 0;
  if (reply.view_index) {
    const View& view = *snapshot.views[*reply.view_index].view;
    answer.view_index = static_cast<std::int32_t>(*reply.view_index);
    answer.view_sequence = static_cast<std::int64_t>(view.sequence());
    answer.view_utime = utimeFromTime(view.stamp());
  }
  store(reply.x_C.mean_m, answer.mean_camera);
  store(reply.x_C.covariance_m2, answer.covariance_camera);
  answer.num_neighbours = static_cast<std::int32_t>(reply.neighbour_count);
  for (const Neighbour& neighbour : reply.found()) {
    answer.neighbours.push_back({neighbour.point_C.x(), neighbour.point_C.y(), neighbour.point_C.z()});
    answer.distances.push_back(neighbour.distance_m);
  }
  return answer;
}

}  // namespace

answers_t toMessage(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B,
                    std::span<const QueryReply> replies, std::size_t fan_count) {
  assert(points_B.size() == replies.size() && fan_count <= points_B.size());
  answers_t message{};
  message.utime = utimeFromTime(snapshot.stamp);
  message.pose_sequence = static_cast<std::int64_t>(snapshot.pose_sequence);
  message.epoch = static_cast<std::int32_t>(snapshot.epoch);
  message.world_from_body = toMessage(snapshot.T_W_B);
  message.num_views = static_cast<std::int32_t>(snapshot.views.size());
  message.num_fan = static_cast<std::int32_t>(fan_count);
  message.num_answers = static_cast<std::int32_t>(replies.size());
  message.answers.reserve(replies.size());
  for (std::size_t i = 0; i < replies.size(); ++i) {
    message.answers.push_back(toAnswer(snapshot, points_B[i], replies[i]));
  }
  return message;
}

}  // namespace nanomap
