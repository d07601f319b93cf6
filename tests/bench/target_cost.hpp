#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::board {

/// What a tick costs on a board: exact instruction counts, not times. QEMU has no clock worth
/// reading.
struct TargetCost {
  std::uint64_t ticks = 0;
  double average = 0;  ///< instructions of step(), digest included
  std::uint64_t worst = 0;
  std::uint64_t worst_tick = 0;  ///< index of the Inputs that took most
  double digest_average = 0;     ///< instructions of the digest, which are part of the above
  std::uint64_t digest_worst = 0;
  std::uint32_t stack_static_bytes = 0;    ///< a bound, from the machine code
  std::string stack_chain;                 ///< the calls that need it, each with its frame
  std::uint32_t stack_measured_bytes = 0;  ///< the deepest that this replay went
  std::uint32_t image_bytes = 0;           ///< code and constants of the replay image
};

/// Replays inputs on an emulated board under the instruction counter. Throws BoardError, also when
/// a tool is missing.
TargetCost measure_target(const std::string& board, const Params& params,
                          std::span<const Inputs> inputs);

/// Where a tick's instructions go: one of the core's functions that the compiler left whole, with
/// all it calls.
struct FunctionCost {
  std::string name;
  double calls_a_tick = 0;
  double average_a_tick = 0;     ///< instructions, callees included
  std::uint64_t worst_tick = 0;  ///< the most that all its calls in one tick took
};

/// The core's functions, the most expensive first. Throws BoardError.
std::vector<FunctionCost> profile_target(const std::string& board, const Params& params,
                                         std::span<const Inputs> inputs);

/// One JSON object in one line.
std::string to_json(const std::string& board, const TargetCost& cost);

}  // namespace verp::board
