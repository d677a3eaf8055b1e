#include "firmware_app/supervision/end_signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

TEST(EndSignals, AreTakenOnceAndEndNothingByThemselves) {
  const EndSignals signals;
  EXPECT_FALSE(signals.wait(Duration::zero()));
  for (const int signal : {SIGINT, SIGTERM}) {
    kill(getpid(), signal);
    EXPECT_TRUE(signals.wait(10s));
    EXPECT_FALSE(signals.wait(Duration::zero()));
  }
}

TEST(EndSignals, AreLeftAloneByLaterThreads) {
  const EndSignals signals;
  sigset_t blocked{};
  std::thread([&] { pthread_sigmask(SIG_BLOCK, nullptr, &blocked); }).join();
  EXPECT_EQ(sigismember(&blocked, SIGINT), 1);
  EXPECT_EQ(sigismember(&blocked, SIGTERM), 1);
}

}  // namespace
}  // namespace nanomap
