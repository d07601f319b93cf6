#include "board.hpp"
#include "boards/mps2/arguments.hpp"
#include "firmware/app/replay_job.hpp"
#include "firmware/boot/boot.hpp"
#include "firmware/boot/stack.hpp"
#include "hal/chip/semihosting/semihosting.hpp"

/// replay_<board> JOB RESULT: runs JOB's recorded inputs (replay_job.hpp) and writes RESULT.
namespace {

using verp::hal::semihosting::File;

struct StackGauge {
  std::uintptr_t from = 0;
  void begin() { from = verp::boot::paint_stack(); }
  std::uint32_t used_bytes() const { return verp::boot::stack_used_below(from); }
};

verp::Replay<verp::board::kReplayBlock> replay;

}  // namespace

extern "C" int verp_main() {
  using verp::ReplayResult;
  const verp::board::Arguments arguments;
  File job(arguments[1], File::Mode::kRead);
  File result(arguments[2], File::Mode::kWrite);
  if (!job.is_open() || !result.is_open()) {
    verp::hal::semihosting::print("replay: can't open the job or the result file\n");
    return 2;
  }
  switch (replay.run(job, result, StackGauge{})) {
    case ReplayResult::kDone:
      return 0;
    case ReplayResult::kBadJob:
      verp::hal::semihosting::print("replay: the job was made by another build; rebuild both\n");
      return 2;
    case ReplayResult::kLinkLost:
      break;
  }
  verp::hal::semihosting::print("replay: the job ended early, or the result can't be written\n");
  return 3;
}
