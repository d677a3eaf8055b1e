#include "drivers/lcm/lcm_url.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "drivers/lcm/udp_receiver.h"

namespace nanomap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::ThrowsMessage;

TEST(LcmUrl, StaysOnThisMachineUnlessItSaysOtherwise) {
  EXPECT_EQ(parseLcmUrl("udpm://239.255.76.67:7667").text, "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152");
  EXPECT_EQ(parseLcmUrl("udpm://239.255.76.67:7667?ttl=1").text,
            "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=2097152");
}

TEST(LcmUrl, EverythingMayBeLeftOut) {
  for (const char* url : {"udpm://", "udpm://239.255.76.67", "udpm://:7667", "udpm://239.255.76.67:", "udpm://?"}) {
    EXPECT_EQ(parseLcmUrl(url).text, "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152") << url;
  }
}

TEST(LcmUrl, SaysWhatToAskOfTheKernel) {
  const LcmUrl url = parseLcmUrl("udpm://239.1.2.3:1024?recv_buf_size=4096,ttl=0");
  EXPECT_TRUE(url.multicast);
  EXPECT_EQ(url.port, 1024);
  EXPECT_EQ(url.receive_buffer_bytes, 4096);
  EXPECT_EQ(url.text, "udpm://239.1.2.3:1024?ttl=0&recv_buf_size=4096");
}

TEST(LcmUrl, WithinTheProcessHasNoPort) {
  const LcmUrl url = parseLcmUrl("memq://");
  EXPECT_EQ(url.text, "memq://");
  EXPECT_FALSE(url.multicast);
  EXPECT_EQ(url.port, 0);
}

struct BadUrl {
  const char* url;
  const char* complaint;
};
class BadLcmUrl : public ::testing::TestWithParam<BadUrl> {};
INSTANTIATE_TEST_SUITE_P(LcmUrl, BadLcmUrl,
                         ::testing::Values(BadUrl{"", "no network"}, BadUrl{"239.255.76.67:7667", "no network"},
                                           BadUrl{"tcpq://host", "no network"}, BadUrl{"memq://?ttl=0", "no network"},
                                           BadUrl{"file:///tmp/a.lcmlog", "is a log"},
                                           BadUrl{"udpm://239.255.76.67:0", "port '0'"},
                                           BadUrl{"udpm://239.255.76.67:65536", "port '65536'"},
                                           BadUrl{"udpm://239.1.1.1:7x", "port '7x'"},
                                           BadUrl{"udpm://?ttl=256", "ttl '256'"}, BadUrl{"udpm://?ttl=", "ttl ''"},
                                           BadUrl{"udpm://?recv_buf_size=0", "recv_buf_size '0'"},
                                           BadUrl{"udpm://?recv_buf_size=2MB", "recv_buf_size '2MB'"},
                                           BadUrl{"udpm://?tll=0", "option 'tll'"}));

TEST_P(BadLcmUrl, IsNamedWithWhatToWrite) {
  EXPECT_THAT([] { (void)parseLcmUrl(GetParam().url); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("'" + std::string(GetParam().url) + "'"),
                                                         HasSubstr(GetParam().complaint),
                                                         HasSubstr("udpm://239.255.76.67:7667"))));
}

TEST(ReceiveBufferWarning, NamesTheSettingOnlyIfLessWasGranted) {
  EXPECT_EQ(receiveBufferWarning(2'097'152, 2'097'152), std::nullopt);
  EXPECT_EQ(receiveBufferWarning(1, 1152), std::nullopt);
  EXPECT_THAT(receiveBufferWarning(2'097'152, 212'992),
              Optional(AllOf(HasSubstr("212992 of 2097152"), HasSubstr("net.core.rmem_max=2097152"))));
}

}  // namespace
}  // namespace nanomap
