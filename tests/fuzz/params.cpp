// A Params image, as flash, files and the operator's port bring it, and the boot check behind it.
#include "common/control/boot_check.hpp"
#include "common/control/golden.hpp"
#include "common/control/self_test.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::fuzz {
namespace {

const ParamsImage& sound_image() {
  static const ParamsImage image = [] {
    ParamsImage made;
    made.params = test::kRobot;
    for (std::uint32_t i = 0; i < kGoldenVectors; ++i)
      made.golden[i] = control::golden_vector(made.params, i);
    State state;
    made.self_test_ticks = control::kSelfTestTicks;
    const std::uint64_t digest = control::self_test_digest(made.params, state);
    made.self_test_digest[0] = static_cast<std::uint32_t>(digest);
    made.self_test_digest[1] = static_cast<std::uint32_t>(digest >> 32);
    seal_image(made);
    return made;
  }();
  return image;
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  static ParamsImage& image = *new ParamsImage;
  image = fuzz::sound_image();
  const std::uint8_t how = bytes.byte();
  fuzz::patch(image, 12, bytes);
  if (how < 224) seal_image(image);
  const std::size_t seen = how % 32 == 31 ? bytes.below(sizeof image + 64) : sizeof image;
  if (check_image(&image, seen < sizeof image ? seen : sizeof image) != ImageFault::kNone) return 0;
  fuzz::require(control::count_golden_matches(image) <= kGoldenVectors, "there are eight");
  static Params robot;
  static State state;
  if (how % 4 == 0) control::self_test_digest(image.params, state = State{});
  if (how == 1) control::check_boot(&image, sizeof image, robot, state);
  fuzz::require(test::struct_is_finite(state), "the State of a sound image's walk is finite");
  return 0;
}
