#include <gtest/gtest.h>

#include "boards/mps2/arguments.hpp"
#include "firmware/boot/boot.hpp"

/// unit_<board> [FILTER]: runs tests/unit.
void testing::put(const char* text) {
  verp::hal::semihosting::print(text);
}

extern "C" int verp_main() {
  const verp::board::Arguments arguments;
  return testing::run_all(arguments[1]) == 0 ? 0 : 1;
}
