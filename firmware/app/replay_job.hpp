#pragma once
#include <cstddef>
#include <cstdint>

#include "common/control/step.hpp"
#include "common/record/tick_record.hpp"

/// Replays recorded inputs on another core; returns its digests.
///
/// Over any byte stream. In: one ReplayJob, the Params image, `ticks` Inputs. Out: one TickDigest
/// per tick, one ReplayReport and, on request, the State after one tick.
namespace verp {

struct ReplayJob {
  static constexpr std::uint32_t kMagic = 0x31'4c'50'52;  ///< "RPL1"
  static constexpr std::uint32_t kNoState = 0xFFFFFFFF;
  std::uint32_t magic = kMagic;
  std::uint32_t params_size = sizeof(Params);  ///< sizes detect other builds
  std::uint32_t inputs_size = sizeof(Inputs);
  std::uint32_t state_size = sizeof(State);
  std::uint32_t ticks = 0;
  std::uint32_t state_after = kNoState;  ///< index of an Inputs
  VERP_FIELDS(magic, params_size, inputs_size, state_size, ticks, state_after)
};
VERP_PACKED(ReplayJob);

struct ReplayReport {
  std::uint32_t magic = ReplayJob::kMagic;
  std::uint32_t ticks = 0;
  std::uint32_t stack_bytes = 0;  ///< deepest, below step()'s caller; 0: not measured
  std::uint32_t reserved = 0;
  VERP_FIELDS(magic, ticks, stack_bytes, reserved)
};
VERP_PACKED(ReplayReport);

/// Blocks until all bytes moved; false: the far end is gone.
template <class Stream>
concept ByteStream = requires(Stream& stream, void* to, const void* from, std::size_t size) {
  { stream.read(to, size) } -> std::same_as<bool>;
  { stream.write(from, size) } -> std::same_as<bool>;
};

enum class ReplayResult : std::uint8_t { kDone, kBadJob, kLinkLost };

/// A replay's memory, too big for a microcontroller's stack. A bigger Block gives fewer transfers.
template <int Block>
class Replay {
 public:
  /// gauge.begin() before the first tick, gauge.used_bytes() after the last.
  template <ByteStream In, ByteStream Out, class StackGauge>
  ReplayResult run(In& in, Out& out, StackGauge&& gauge) {
    ReplayJob job;
    if (!in.read(&job, sizeof job)) return ReplayResult::kLinkLost;
    if (!fits(job)) return ReplayResult::kBadJob;
    if (!in.read(&params_, sizeof params_)) return ReplayResult::kLinkLost;
    state_ = State{};
    gauge.begin();
    for (std::uint32_t tick = 0; tick < job.ticks; tick += Block) {
      const std::uint32_t left = job.ticks - tick;
      const std::uint32_t count = left < Block ? left : Block;
      if (!in.read(inputs_, count * sizeof(Inputs))) return ReplayResult::kLinkLost;
      run_block(tick, count, job.state_after);
      if (!out.write(digests_, count * sizeof(TickDigest))) return ReplayResult::kLinkLost;
    }
    const ReplayReport report{.ticks = job.ticks, .stack_bytes = gauge.used_bytes()};
    bool sent = out.write(&report, sizeof report);
    if (job.state_after < job.ticks) sent = sent && out.write(&kept_, sizeof kept_);
    return sent ? ReplayResult::kDone : ReplayResult::kLinkLost;
  }

 private:
  static bool fits(const ReplayJob& job) {
    return job.magic == ReplayJob::kMagic && job.params_size == sizeof(Params) &&
           job.inputs_size == sizeof(Inputs) && job.state_size == sizeof(State);
  }

  void run_block(std::uint32_t first_tick, std::uint32_t count, std::uint32_t state_after) {
    for (std::uint32_t i = 0; i < count; ++i) {
      step(params_, state_, inputs_[i], outputs_);
      digests_[i] = state_.digest;
      if (first_tick + i == state_after) kept_ = state_;
    }
  }

  Params params_;
  State state_;
  State kept_;
  Outputs outputs_;
  Inputs inputs_[Block];
  TickDigest digests_[Block];
};

}  // namespace verp
