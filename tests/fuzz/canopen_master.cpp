// The control loop's end of the CAN bus: drives' frames are lost, changed and forged.
#include "host/twin/can/virtual_can.hpp"
#include "tests/fuzz/canopen.hpp"
#include "tests/fuzz/loop.hpp"
#include "tests/host/can/can_bench.hpp"

namespace verp::fuzz {
namespace {

struct BadWire final : hal::CanBus {
  BadWire(can::VirtualCan& whole, Bytes& what) : bus(whole), bytes(what) {}
  bool send(const CanFrame& frame) override { return bus.send(frame); }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    const std::uint8_t how = bytes.byte();
    if (how >= 224) {
      frame = frame_to(static_cast<std::uint8_t>(1 + how % 4), bytes);
      return true;
    }
    if (!bus.poll(frame, timeout_us)) return false;
    if (how >= 192) frame.data[how % 8] = bytes.byte();
    return how < 160 || how >= 192 || bus.poll(frame, timeout_us);
  }
  std::uint64_t now_us() override { return bus.now_us(); }
  hal::CanErrors errors() const override { return bus.errors(); }
  can::VirtualCan& bus;
  Bytes& bytes;
};

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  test::CanBench bench(3);
  fuzz::BadWire wire(bench.bus, bytes);
  fuzz::run_loop(bench.params, wire, bytes);
  return 0;
}
