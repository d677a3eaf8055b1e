#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

#include "drivers/recording/log_writer.h"
#include "tests/integration/lcm/network.h"
#include "tests/unit/drivers/temporary_file.h"

namespace nanomap::test {
namespace {

using ::testing::ElementsAreArray;

class LogPlayerTest : public MulticastTest {};

TEST_F(LogPlayerTest, PlaysALogToUs) {
  const TemporaryFile file;
  std::vector<std::string> written;
  {
    LogWriter log(file.path());
    for (int i = 0; i < 300; ++i) {
      log.writeEncoded("POSE", Time(std::chrono::milliseconds(i)), bytesOf(std::to_string(i)));
      written.push_back("POSE:" + std::to_string(i));
    }
    log.close();
  }
  LcmNetwork network(url(), {"POSE"});
  const std::string command = std::string(NANOMAP_LCM_LOGPLAYER) + " --lcm-url='" + network.url() + "' '" +
                              file.path().string() + "' > /dev/null";
  int status = -1;
  std::thread player([&] { status = std::system(command.c_str()); });
  hear(network, written.size());
  player.join();
  EXPECT_EQ(status, 0) << command;
  EXPECT_THAT(heard_, ElementsAreArray(written));
  EXPECT_EQ(network.loss().datagrams, 0U);
  EXPECT_EQ(network.loss().full_queues, 0U);
}

}  // namespace
}  // namespace nanomap::test
