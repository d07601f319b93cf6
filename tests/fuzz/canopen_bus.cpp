// The twin's CAN bus: any frames to virtual drives, an IMU and soles.
#include "host/twin/can/virtual_can.hpp"
#include "tests/fuzz/canopen.hpp"
#include "tests/host/can/can_bench.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  test::CanBench bench(2);
  bench.let_pass(5000);
  for (int frames = 0; bytes.left() > 0 && frames < 300; ++frames) {
    const std::uint8_t what = bytes.byte();
    bench.bus.send(fuzz::frame_to(static_cast<std::uint8_t>(1 + what % 2), bytes));
    bench.let_pass(what < 192 ? 300 : what * 50U);
    if (what == 255) bench.bus.set_powered(1, bytes.byte() % 2 == 0);
    CanFrame heard;
    if (what % 16 == 3) bench.bus.poll(heard, 2000);
  }
  fuzz::require(!bench.plant.went_back, "the plant's time never goes back");
  return 0;
}
