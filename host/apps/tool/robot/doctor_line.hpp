#pragma once
#include <cstdint>
#include <set>
#include <vector>

#include "host/os/link/link.hpp"

namespace verp::tool {

/// The bytes that came over a link after a request, taken apart.
struct LineAnswer {
  std::size_t bytes = 0;      ///< without the echo
  std::size_t garbage = 0;    ///< of them in no sound packet of Protocol 2
  bool echo = false;          ///< our own bytes came back
  bool master = false;        ///< another master's request was heard
  std::set<int> ids;          ///< of sound answers in Protocol 2
  std::set<int> old_ids;      ///< in Protocol 1
  std::uint32_t damaged = 0;  ///< packets
};

/// Takes apart what was heard after `sent`.
LineAnswer take_apart(const std::vector<std::uint8_t>& sent, std::vector<std::uint8_t> heard);

/// Listens for `time_us`.
LineAnswer listen(link::Link& link, std::uint32_t time_us);
/// Sends a Ping to all ids.
LineAnswer ping_all(link::Link& link);
/// Pings one id, or reads its position, and listens for `time_us`.
LineAnswer ping_one(link::Link& link, int id, std::uint32_t time_us);
LineAnswer read_one(link::Link& link, int id, std::uint32_t time_us);
/// Reads the position of a Feetech servo; of what came, only `bytes` and `echo` count.
LineAnswer read_one_feetech(link::Link& link, int id, std::uint32_t time_us);
/// Sends the Ping of Protocol 1 to all ids, then to the first ones in turn.
LineAnswer ping_all_old(link::Link& link);

}  // namespace verp::tool
