#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "host/apps/libverp/verp.h"
#include "host/twin/radio/radio.hpp"

namespace verp::abi {

struct Run;

class Air {
 public:
  /// Throws Failure that names the invalid number.
  explicit Air(const verp_radio& what);

  /// Call it before the first tick, when all robots are there.
  void begin(std::size_t robots);
  void ticked(Run& run, std::uint32_t robot);
  int send(Run& run, std::uint32_t robot, std::int32_t to, std::string data);
  int take(std::uint32_t robot, void* data, std::uint64_t room, std::uint64_t* size,
           std::uint32_t* from);

 private:
  static constexpr std::size_t kMostHeard = 256;
  radio::Radio radio_;
  std::vector<std::deque<radio::ReceivedMessage>> heard_;
};

}  // namespace verp::abi
