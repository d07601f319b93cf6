#pragma once
#include <cstddef>
#include <cstdint>

#include "common/control/state.hpp"
#include "common/model/image.hpp"

namespace verp::control {

/// Results of the boot check, worst first. Later checks run only if the earlier ones pass.
enum class BootVerdict : std::uint8_t {
  kSound = 0,
  kContracted = 1,  ///< the core was built with fused multiply-add: its bits differ from the twin's
  kCode = 2,        ///< the built-in robot's walk differs: damaged code, memory or core
  kImage = 3,       ///< Params image missing, damaged, of another version or implausible: `image`
  kKinematics = 4,  ///< the image's golden vectors are not reproduced
  kControl = 5,     ///< the image's 256 ticks are not reproduced
};
inline constexpr int kBootVerdicts = 6;
/// Messages for an operator. Index: BootVerdict.
inline constexpr const char* kBootWords[kBootVerdicts] = {
    "sound",
    "built with fused multiply-add: build with toolchains/floating_point.cmake",
    "the core fails its own walk: flash it again; if it fails again, do not use this board",
    "no usable Params image: write one with verp export and flash it",
    "the Params image's kinematics do not come out on this core: export it anew",
    "the Params image's walk does not come out on this core: export it anew"};

struct BootReport {
  BootVerdict verdict = BootVerdict::kSound;
  ImageFault image = ImageFault::kNone;
  std::uint8_t golden_matches = 0;  ///< of kGoldenVectors
  FieldName bad_field;              ///< for ImageFault::kOutOfRange: the number
  std::uint64_t digest = 0;         ///< of the last walk checked
};

/// All checks before torque may ever be on: the arithmetic contract, the code on its built-in
/// robot, the image's CRC and version, then code and image together. The walks' sensor data come
/// from an integer generator and from the core's own outputs. `image` holds at most `size` bytes
/// and is aligned as ParamsImage. Both scratches are overwritten.
BootReport check_boot(const void* image, std::size_t size, Params& robot, State& state);

/// Last chain link of the built-in robot's walk as this core computes it, and its expected value.
std::uint64_t built_in_digest(Params& robot, State& state);
extern const std::uint64_t kBuiltInDigest;

}  // namespace verp::control
