#include "board.hpp"
#include "firmware/boot/boot.hpp"
#include "hal/chip/semihosting/semihosting.hpp"

namespace {

constexpr int kFaultStatus = 70;  // EX_SOFTWARE of BSD's sysexits.h; differs from a failed run

struct Hex {
  char text[12];
};

Hex to_hex(std::uint32_t value) {
  Hex hex{{'0', 'x'}};
  for (int digit = 0; digit < 8; ++digit) {
    hex.text[2 + digit] = "0123456789abcdef"[(value >> (28 - 4 * digit)) & 0xF];
  }
  return hex;
}

}  // namespace

extern "C" void verp_exit(int status) {
  verp::hal::semihosting::exit(status);
}

extern "C" void verp_fault(const verp::boot::FaultReport& report) {
  using verp::hal::semihosting::print;
  print(verp::board::kName);
  if (report.stack_overflow) {
    print(": stack overflow");
  } else {
    print(": fault at pc ");
    print(to_hex(report.pc).text);
    print(", called from ");
    print(to_hex(report.lr).text);
  }
  print(", CFSR ");
  print(to_hex(report.cause).text);
  print(", address ");
  print(to_hex(report.address).text);
  print("\n");
  verp::hal::semihosting::exit(kFaultStatus);
}
