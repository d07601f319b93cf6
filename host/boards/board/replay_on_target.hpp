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

/// What a replay came to, on whatever machine it ran.
struct TargetReplay {
  std::vector<TickDigest> digests;  ///< one per Inputs
  std::optional<State> state;       ///< after the tick asked for
  std::uint32_t stack_bytes = 0;    ///< deepest stack of step(); 0 where it isn't measured
};

struct TargetReplayOptions {
  std::optional<std::uint32_t> state_after =
      {};                   ///< index of the Inputs after which State is wanted
  std::string plugin = {};  ///< QEMU's -plugin option (tests/bench)
  std::uint32_t limit_s = 600;
};

/// The file that tells a replay image what to do: its first argument; the second is where its
/// answer goes. Throws BoardError.
void write_replay_job(const std::filesystem::path& path, const Params& params,
                      std::span<const Inputs> inputs, const TargetReplayOptions& options = {});

/// Runs the controller over recorded inputs in firmware on an emulated board. Throws BoardError.
TargetReplay replay_on(const std::string& board, const Params& params,
                       std::span<const Inputs> inputs, const TargetReplayOptions& options = {});

}  // namespace verp::board
