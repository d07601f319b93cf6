#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::board {

/// A tick's cost in exact instruction counts: QEMU has no meaningful clock.
struct TargetCost {
  std::uint64_t ticks = 0;
  double average = 0;  ///< step()'s instructions, digest included
  std::uint64_t worst = 0;
  std::uint64_t worst_tick = 0;  ///< index of the Inputs that took most
  double digest_average = 0;     ///< instructions of the digest alone
  std::uint64_t digest_worst = 0;
  std::uint32_t stack_static_bytes = 0;    ///< bound from the machine code
  std::string stack_chain;                 ///< the deepest calls, each with its frame
  std::uint32_t stack_measured_bytes = 0;  ///< the deepest of this replay
  std::uint32_t image_bytes = 0;           ///< code and constants of the replay image
};

/// Replays inputs on an emulated board under the instruction counter. Throws BoardError, also if a
/// tool is missing.
TargetCost measure_target(const std::string& board, const Params& params,
                          std::span<const Inputs> inputs);

/// The instructions of one core function that the compiler did not inline, callees included.
struct FunctionCost {
  std::string name;
  double calls_a_tick = 0;
  double average_a_tick = 0;     ///< instructions, callees included
  std::uint64_t worst_tick = 0;  ///< the most by all its calls in one tick
};

/// The core's functions, the most expensive first. Throws BoardError.
std::vector<FunctionCost> profile_target(const std::string& board, const Params& params,
                                         std::span<const Inputs> inputs);

/// One line of JSON.
std::string to_json(const std::string& board, const TargetCost& cost);

}  // namespace verp::board
