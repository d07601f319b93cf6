#include <cinttypes>
#include <cstdio>

#include "common/control/step.hpp"
#include "tests/replay/trace_file.hpp"

/// replay_digest FILE: runs the core over the inputs of FILE and prints the last link of each
/// segment's digest chain, and one for all. Exit status 1 when a digest is not the recorded one;
/// the first such tick and its stage go to stderr. Nothing but the core and this file: built by
/// every compiler and optimisation level that must agree.
namespace {

using namespace verp;

bool same(const TickDigest& a, const TickDigest& b) {
  return __builtin_memcmp(&a, &b, sizeof a) == 0;
}

void complain(const replay::Segment& segment, const TickRecord& recorded, const TickDigest& now) {
  int stage = 0;
  while (stage < kStages - 1 && recorded.digest.stage[stage] == now.stage[stage]) ++stage;
  std::fprintf(stderr, "%s: first divergence: tick %" PRIu32 ", stage %s\n", segment.name.c_str(),
               recorded.inputs.tick, kStageNames[stage]);
}

/// Replaces the recorded digests' last link by this core's.
bool replay_here(replay::Segment& segment) {
  State state;
  Outputs outputs;
  bool good = true;
  for (TickRecord& tick : segment.ticks) {
    step(segment.params, state, tick.inputs, outputs);
    if (good && !same(tick.digest, state.digest)) {
      complain(segment, tick, state.digest);
      good = false;
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
  for (replay::Segment& segment : trace) {
    good = replay_here(segment) && good;
    ticks += segment.ticks.size();
    std::printf("%-14s %7zu %016" PRIx64 "\n", segment.name.c_str(), segment.ticks.size(),
                segment.digest());
  }
  std::printf("%-14s %7zu %016" PRIx64 "\n", "all", ticks, replay::digest_of(trace));
  return good ? 0 : 1;
}
