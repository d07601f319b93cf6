#pragma once
#include <cstddef>
#include <cstdint>

#include "common/control/state.hpp"
#include "common/model/image.hpp"

namespace verp::control {

/// Worst first. Later checks run only if earlier ones pass.
enum class BootVerdict : std::uint8_t {
  kSound = 0,
  kContracted = 1,  ///< built with fused multiply-add: other bits than the twin
  kCode = 2,        ///< built-in robot's walk differs: bad code, memory or core
  kImage = 3,       ///< missing, damaged, another version or implausible: `image`
  kKinematics = 4,  ///< the image's golden vectors differ
  kControl = 5,     ///< the image's 256 ticks differ
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
  FieldName bad_field;              ///< the number, for ImageFault::kOutOfRange
  std::uint64_t digest = 0;         ///< last walk checked
};

/// All checks before any torque: arithmetic contract, code on its built-in robot, image CRC and
/// version, code and image together. `image`: at most `size` bytes, aligned as ParamsImage.
/// Overwrites both scratches.
BootReport check_boot(const void* image, std::size_t size, Params& robot, State& state);

/// Last chain link of the built-in walk: on this core, and expected.
std::uint64_t built_in_digest(Params& robot, State& state);
extern const std::uint64_t kBuiltInDigest;

}  // namespace verp::control
