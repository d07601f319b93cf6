// The twin's servo bus: packets to virtual servos, an IMU and soles, in simulated and in real time.
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/host/bus/fake_plant.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  const Params params = test::bus_params(3);
  test::FakePlant plant;
  bus::VirtualBus bus(params, plant);
  const bool real_time = bytes.byte() % 2 == 1;
  bus.set_real_time(real_time);
  while (bytes.left() > 0) {
    const std::string frame = fuzz::packets(bytes, 1 + bytes.word() % hal::kMaxFrame);
    bus.send(reinterpret_cast<const std::uint8_t*>(frame.data()), frame.size());
    std::uint8_t answer[hal::kMaxFrame];
    if (real_time) bus.bring_until(bus.now_us() + bytes.word(), answer, sizeof answer);
    for (int i = 0; i < 8 && bus.poll(answer, sizeof answer, 20'000) > 0; ++i) {
    }
  }
  fuzz::require(!plant.went_back, "the plant's time never goes back");
  return 0;
}
