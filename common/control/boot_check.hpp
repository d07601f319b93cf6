#pragma once
#include <cstddef>
#include <cstdint>

#include "common/control/state.hpp"
#include "common/model/image.hpp"

namespace verp::control {

/// What a boot may find, worst first: a later one is only looked for when no earlier one holds.
enum class BootVerdict : std::uint8_t {
  kSound = 0,
  kContracted = 1,  ///< the core was built with fused multiply-add: other bits than the twin's
  kCode = 2,        ///< the built-in robot does not walk as it should: damaged code, memory or core
  kImage = 3,  ///< the Params image is none, damaged, of another version or of no robot: `image`
  kKinematics = 4,  ///< the image's golden vectors do not come out
  kControl = 5,     ///< its 256 ticks do not come out
};
inline constexpr int kBootVerdicts = 6;
/// What went wrong, in words for an operator. Index: BootVerdict.
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
  FieldName bad_field;              ///< with ImageFault::kOutOfRange: which number
  std::uint64_t digest = 0;         ///< of the walk that was looked at last
};

/// Everything a boot checks before torque may ever be on: the arithmetic contract, the code on a
/// robot that is part of it, the image's CRC and version, then code and image together. What the
/// walks sense comes from an integer generator and from what the core itself made of it. `image`
/// holds at most `size` bytes and is aligned as ParamsImage; both scratches are overwritten.
BootReport check_boot(const void* image, std::size_t size, Params& robot, State& state);

/// The built-in robot's last link of the chain, as this core computes it now; what it must be.
std::uint64_t built_in_digest(Params& robot, State& state);
extern const std::uint64_t kBuiltInDigest;

}  // namespace verp::control
