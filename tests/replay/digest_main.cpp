#include <cinttypes>
#include <cstdio>

#include "common/control/step.hpp"
#include "common/model/image.hpp"
#include "common/safety/machine.hpp"
#include "tests/replay/divergence.hpp"
#include "tests/replay/trace_file.hpp"

/// replay_digest FILE: runs the core over FILE's inputs. Prints digests, the core's version and
/// some leg goals. Exit status 1 if a digest differs from the recorded one; stderr names the first
/// such tick and stage. Needs only the core and this file, so any compiler can build it.
namespace {

using namespace verp;

constexpr std::size_t kSummaryTicks = 5;  ///< per segment

/// Mode and both legs' goals, mrad, hip to ankle.
std::string legs(const Params& params, const Outputs& outputs) {
  std::string text = safety::kModeNames[outputs.mode];
  for (const LegParams& leg : params.leg) {
    text += " |";
    for (const std::uint8_t j : leg.joint) {
      if (j >= params.joint_count || params.joint[j].counts_per_rad == 0) continue;
      const JointParams& joint = params.joint[j];
      const double rad =
          (double{1} * outputs.goal_count[j] - joint.zero_count) / joint.counts_per_rad;
      char word[32];
      std::snprintf(word, sizeof word, " %.0f", 1000 * rad);
      text += word;
    }
  }
  return text;
}

/// Replaces the last link by this core's and appends the summary.
bool replay_here(replay::Segment& segment, std::string& summary) {
  const std::size_t pace = segment.ticks.size() / kSummaryTicks;
  State state;
  Outputs outputs;
  bool good = true;
  std::size_t nth = 0;
  for (TickRecord& tick : segment.ticks) {
    step(segment.params, state, tick.inputs, outputs);
    if (good && !replay::same(tick.digest, state.digest)) {
      replay::complain(segment, tick, state.digest);
      good = false;
    }
    if (++nth % pace == 0) {
      summary +=
          segment.name + " " + std::to_string(nth) + " " + legs(segment.params, outputs) + "\n";
    }
  }
  segment.ticks.back().digest = state.digest;
  return good;
}

}  // namespace

int main(int count, char** argument) {
  std::vector<replay::Segment> trace;
  if (count == 2) trace = replay::read_trace_file(argument[1]);
  if (trace.empty()) {
    std::fprintf(stderr, "usage: replay_digest FILE, where FILE is made by replay_make\n");
    return 2;
  }
  bool good = true;
  std::size_t ticks = 0;
  std::string summary;
  for (replay::Segment& segment : trace) {
    good = replay_here(segment, summary) && good;
    ticks += segment.ticks.size();
    std::printf("%-14s %7zu %016" PRIx64 "\n", segment.name.c_str(), segment.ticks.size(),
                segment.digest());
  }
  std::printf("%-14s %7zu %016" PRIx64 "\n", "all", ticks, replay::digest_of(trace));
  std::printf("%-14s %7" PRIu32 "\n%s", "core_version", kCoreVersion, summary.c_str());
  return good ? 0 : 1;
}
