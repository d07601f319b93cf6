// Feetech's protocol: the parser, and the twin's virtual servos, IMU and soles.
#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::fuzz {
namespace {

/// Writes the right checksum behind everything that looks like a packet.
void repair_sums(std::string& stream) {
  auto* bytes = reinterpret_cast<std::uint8_t*>(stream.data());
  for (std::size_t at = 0; at + feetech::kInstructionBytes <= stream.size(); ++at) {
    if (bytes[at] != 0xFF || bytes[at + 1] != 0xFF || bytes[at + 2] == 0xFF) continue;
    const std::size_t end = at + feetech::kHeaderBytes + bytes[at + 3];
    if (bytes[at + 3] < 2 || end > stream.size()) continue;
    bytes[end - 1] = feetech::checksum(bytes + at + 2, end - at - 3);
    at = end - 1;
  }
}

void parse(const std::string& stream) {
  feetech::Parser parser;
  std::size_t packets = 0;
  for (const char each : stream) {
    for (bool found = parser.push(static_cast<std::uint8_t>(each)); found; found = parser.next()) {
      const feetech::Packet& packet = parser.packet();
      packets += packet.whole_size();
      require(packet.is(packet.whole, packet.whole_size()), "a packet is its own bytes");
    }
  }
  require(parser.noise_bytes() + packets <= stream.size(), "no byte counts twice");
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  Params params = test::bus_params(3);
  params.bus_protocol = BusProtocol::kFeetech;
  params.baud = 1'000'000;
  test::FakePlant plant;
  bus::VirtualBus bus(params, plant);
  const bool real_time = bytes.byte() % 2 == 1;
  bus.set_real_time(real_time);
  while (bytes.left() > 0) {
    const bool as_they_are = bytes.byte() == 0xFF;
    std::string frame(bytes.take(1 + bytes.word() % hal::kMaxFrame));
    if (!as_they_are) fuzz::repair_sums(frame);
    fuzz::parse(frame);
    bus.send(reinterpret_cast<const std::uint8_t*>(frame.data()), frame.size());
    std::uint8_t answer[hal::kMaxFrame];
    if (real_time) bus.bring_until(bus.now_us() + bytes.word(), answer, sizeof answer);
    for (int i = 0; i < 8 && bus.poll(answer, sizeof answer, 20'000) > 0; ++i) {
    }
  }
  fuzz::require(!plant.went_back, "the plant's time never goes back");
  return 0;
}
