#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::board {

/// Exact instruction counts.
struct TargetCost {
  std::uint64_t ticks = 0;
  double average = 0;  ///< of step(), digest included
  std::uint64_t worst = 0;
  std::uint64_t worst_tick = 0;  ///< index of the Inputs
  double digest_average = 0;     ///< the digest alone
  std::uint64_t digest_worst = 0;
  std::uint32_t stack_static_bytes = 0;    ///< from the machine code
  std::string stack_chain;                 ///< the deepest calls with frames
  std::uint32_t stack_measured_bytes = 0;  ///< in this replay
  std::uint32_t image_bytes = 0;           ///< code and constants
};

/// Runs under the instruction counter. Throws BoardError, also if a tool is missing.
TargetCost measure_target(const std::string& board, const Params& params,
                          std::span<const Inputs> inputs);

/// A function that was not inlined, callees included.
struct FunctionCost {
  std::string name;
  double calls_a_tick = 0;
  double average_a_tick = 0;
  std::uint64_t worst_tick = 0;
};

/// The most expensive first. Throws BoardError.
std::vector<FunctionCost> profile_target(const std::string& board, const Params& params,
                                         std::span<const Inputs> inputs);

std::string to_json(const std::string& board, const TargetCost& cost);

}  // namespace verp::board
