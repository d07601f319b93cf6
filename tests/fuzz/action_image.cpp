// An action library as flash and links bring it; what the check accepts is played.
#include "common/action/kept.hpp"
#include "common/control/step.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/action/shelf.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::fuzz {
namespace {

const control::test::Loop& standing() {
  static const control::test::Loop loop = [] {
    control::test::Loop made;
    made.command.request = Request::kStand;
    require(made.until(safety::Mode::kStanding, 300) >= 0, "the robot stands up");
    made.ticks(30);
    return made;
  }();
  return loop;
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  static action::test::Shelf& shelf = *new action::test::Shelf;
  shelf = action::test::Shelf();
  const std::uint8_t how = bytes.byte(), wanted = bytes.byte();
  fuzz::patch(shelf, 12, bytes);
  if (how < 240) shelf.seal();
  action::KeptLibrary(&shelf, sizeof shelf, test::kRobot);
  const std::size_t seen = how % 8 == 7 ? bytes.below(sizeof shelf) : sizeof shelf;
  if (action::check_library(&shelf, seen) != action::LibraryFault::kNone) return 0;
  static control::test::Loop loop;
  loop = fuzz::standing();
  loop.actions = {&shelf, seen};
  loop.inputs.action = wanted;
  for (int i = 0; i < 300 && (i < 9 || loop.state.action.number != 0); ++i) {
    if (i % 64 == 63) loop.inputs.action = bytes.byte();
    loop.tick();
  }
  fuzz::require(test::struct_is_finite(loop.state), "no action makes the State infinite");
  return 0;
}
