#include <core/chain.h>
#include <core/query.h>

int main() {
  nanomap::Chain chain(nanomap::ChainParameters{});
  chain.addPose({});
  const auto reply = nanomap::query(chain.snapshot(), {{1.0, 0.0, 0.0}, nanomap::Mat3::Zero()}, {});
  return reply.status == nanomap::Status::kEmpty ? 0 : 1;
}
