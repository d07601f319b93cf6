#include "common/control/boot_check.hpp"

#include "common/control/built_in_robot.hpp"
#include "common/control/golden.hpp"
#include "common/control/self_test.hpp"
#include "common/math/contraction.hpp"

namespace verp::control {

// Changes with kCoreVersion; the boot check's test prints it.
const std::uint64_t kBuiltInDigest = 0xbee5009ab73d0560;

namespace {

BootReport check_image_walk(const ParamsImage& image, State& state, BootReport report) {
  report.golden_matches = static_cast<std::uint8_t>(count_golden_matches(image));
  if (report.golden_matches != kGoldenVectors) {
    report.verdict = BootVerdict::kKinematics;
    return report;
  }
  report.digest = self_test_digest(image.params, state);
  const std::uint64_t wanted =
      std::uint64_t{image.self_test_digest[1]} << 32 | image.self_test_digest[0];
  if (image.self_test_ticks != kSelfTestTicks || report.digest != wanted) {
    report.verdict = BootVerdict::kControl;
  }
  return report;
}

}  // namespace

std::uint64_t built_in_digest(Params& robot, State& state) {
  make_built_in_robot(robot);
  return self_test_digest(robot, state);
}

BootReport check_boot(const void* image, std::size_t size, Params& robot, State& state) {
  BootReport report;
  if (math::is_contracted(1.0F + 0x1p-13F, 1.0F + 0x1p-12F)) {
    report.verdict = BootVerdict::kContracted;
    return report;
  }
  report.digest = built_in_digest(robot, state);
  if (report.digest != kBuiltInDigest) {
    report.verdict = BootVerdict::kCode;
    return report;
  }
  report.image = check_image(image, size);
  if (report.image != ImageFault::kNone) {
    report.verdict = BootVerdict::kImage;
    if (report.image == ImageFault::kOutOfRange) {
      numbers_fit(static_cast<const ParamsImage*>(image)->params, report.bad_field);
    }
    return report;
  }
  return check_image_walk(*static_cast<const ParamsImage*>(image), state, report);
}

}  // namespace verp::control
