#include "host/twin/bus/client.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <thread>

namespace verp::bus {
namespace {

/// Servos that answer each broadcast Ping; the first answers come damaged.
void answer_two_scans(link::Link& wire, int servos, int damaged) {
  std::uint8_t ping[dxl::kStatusBytes];
  for (int scan = 0; scan < 2; ++scan) {
    if (wire.read(ping, sizeof ping, 5'000'000) == 0) return;
    for (int id = 1; id <= servos; ++id) {
      const std::uint8_t identity[3] = {0x24, 0x04, 50};
      std::uint8_t answer[32];
      const std::size_t size =
          dxl::encode_status(answer, sizeof answer, static_cast<std::uint8_t>(id), 0, identity, 3);
      if (scan == 0 && id <= damaged) answer[size - 1] ^= 0x10;
      wire.write(answer, size, 1'000'000);
    }
  }
}

TEST(Client, AScanWhoseAnswersCameDamagedIsMadeAgain) {
  const std::string place =
      (std::filesystem::temp_directory_path() / ("verp-scan-" + std::to_string(::getpid())))
          .string();
  link::Link servos(link::parse_endpoint("unix-listen:" + place));
  std::thread wire([&] { answer_two_scans(servos, 5, 2); });
  Client client(link::parse_endpoint("unix:" + place), 1000);
  const auto found = client.scan();
  wire.join();
  ASSERT_EQ(found.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(found[static_cast<std::size_t>(i)].id, i + 1);
}

}  // namespace
}  // namespace verp::bus
