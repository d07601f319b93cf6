#include "boards/stm32/hardware.hpp"
#include "firmware/boot/boot.hpp"
#include "firmware/boot/crash.hpp"

/// Ends an image by a reset. A fault keeps its crash record. The next start begins with torque off.
namespace {

[[noreturn]] void reset() {
  using namespace verp::hal::stm32;
  verp::board::Io io;
  io.barrier();
  io.write32(cortex_m::kAircr, cortex_m::kAircrKey | cortex_m::kAircrSysresetreq);
  for (;;) {
  }
}

}  // namespace

extern "C" void verp_exit(int) {
  reset();
}

extern "C" void verp_fault(const verp::boot::FaultReport& report) {
  verp::boot::keep_crash(report);
  reset();
}
