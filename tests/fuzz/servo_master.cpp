// The control loop's end of the servo bus: virtual servos' answers are lost, changed and forged.
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/loop.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::fuzz {
namespace {

struct BadWire final : hal::FrameBus {
  BadWire(bus::VirtualBus& whole, Bytes& what) : bus(whole), bytes(what) {}
  bool send(const std::uint8_t* data, std::size_t size) override { return bus.send(data, size); }
  std::size_t poll(std::uint8_t* to, std::size_t capacity, std::uint32_t timeout_us) override {
    const std::size_t count = bus.poll(to, capacity, timeout_us);
    const std::uint8_t how = bytes.byte();
    if (how < 128) return count;
    if (how < 160) return 0;
    std::string answer(reinterpret_cast<const char*>(to), count);
    const std::size_t at = bytes.below(count + 1);
    if (how < 208) answer.replace(at, 1, bytes.take(1 + how % 4));
    if (how >= 208) answer = bytes.take(how);
    if (how % 2 == 0) repair_packets(answer);
    const std::size_t stored = answer.size() < capacity ? answer.size() : capacity;
    std::memcpy(to, answer.data(), stored);
    return stored;
  }
  std::uint64_t now_us() override { return bus.now_us(); }
  bus::VirtualBus& bus;
  Bytes& bytes;
};

Params robot() {
  Params params = test::make_robot();
  params.servo[0] = {1030, 800, 0, 0, 10, 1};
  return params;
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  static Params params = fuzz::robot();
  params.servo[0].fast_sync_read = bytes.byte() % 2;
  test::FakePlant plant;
  for (auto& servo : plant.measured) servo.position_count = 2048;
  bus::VirtualBus whole(params, plant);
  fuzz::BadWire wire(whole, bytes);
  fuzz::run_loop(params, wire, bytes);
  return 0;
}
