#pragma once
#include <string>
#include <vector>

namespace verp::tool {

struct BusOptions {
  std::string link;
  std::string protocol = "dynamixel2";  ///< of a byte link
  double timeout_ms = 100;
  int id = -1;  ///< default: the controller on that link
  std::vector<std::string> names;
  int address = -1;
  std::string object;  ///< on CAN: INDEX:SUBINDEX
  int size = 4;
  std::vector<std::string> values;
  std::string node;
  bool each = false;
  double seconds = 2;
  int bench_address = 0;
  bool json = false;
};

}  // namespace verp::tool
