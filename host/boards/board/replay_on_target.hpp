#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"

namespace verp::board {

struct TargetReplay {
  std::vector<TickDigest> digests;  ///< one per Inputs
  std::optional<State> state;       ///< after the requested tick
  std::uint32_t stack_bytes = 0;    ///< deepest stack of step(); 0: not measured
};

struct TargetReplayOptions {
  std::optional<std::uint32_t> state_after = {};  ///< Inputs after which State is returned
  std::string plugin = {};                        ///< QEMU's -plugin option (tests/bench)
  std::uint32_t limit_s = 600;
};

/// Writes the job file, a replay image's first argument; the second is the result file. Throws
/// BoardError.
void write_replay_job(const std::filesystem::path& path, const Params& params,
                      std::span<const Inputs> inputs, const TargetReplayOptions& options = {});

/// Runs the controller over recorded inputs on an emulated board. Throws BoardError.
TargetReplay replay_on(const std::string& board, const Params& params,
                       std::span<const Inputs> inputs, const TargetReplayOptions& options = {});

}  // namespace verp::board
