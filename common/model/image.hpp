#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/crc32.hpp"
#include "common/base/fields.hpp"
#include "common/model/numbers.hpp"
#include "common/model/params.hpp"

/// The Params image: a robot as bytes, in flash, trace or file. Its CRC names it in every link
/// handshake. It carries the results that every core must reproduce.
namespace verp {

/// Raise when the layout of ParamsImage or a member changes.
inline constexpr std::uint32_t kImageVersion = 6;
/// Raise when the same Params and Inputs give other Outputs.
inline constexpr std::uint32_t kCoreVersion = 29;

inline constexpr char kImageMagic[8] = {'V', 'E', 'R', 'P', 'P', 'A', 'R', '1'};

struct ImageHeader {
  char magic[8] = {};
  std::uint32_t image_version = 0;
  std::uint32_t core_version = 0;
  std::uint32_t size = 0;   ///< of the whole image, header included
  std::uint32_t crc32 = 0;  ///< of all bytes after the header
  VERP_FIELDS(magic, image_version, core_version, size, crc32)
};
VERP_PACKED(ImageHeader);

/// Kinematics of one whole-body posture (control/golden.hpp).
struct GoldenVector {
  std::uint32_t seed = 0;          ///< draws the joint angles
  std::uint32_t poses_digest = 0;  ///< of the poses of all nodes
  std::uint32_t legs_digest = 0;   ///< of both legs' angles and flags for the soles' poses
  Xyz com_m;                       ///< body frame
  Xyz sole_m[kFeet];               ///< body frame
  VERP_FIELDS(seed, poses_digest, legs_digest, com_m, sole_m)
};
VERP_PACKED(GoldenVector);
inline constexpr int kGoldenVectors = 8;

struct ParamsImage {
  ImageHeader header;
  Params params;
  GoldenVector golden[kGoldenVectors];
  std::uint32_t self_test_ticks = 0;       ///< control/self_test.hpp; 0: no self-test
  std::uint32_t self_test_digest[2] = {};  ///< low and high word of the chain's last link
  VERP_FIELDS(header, params, golden, self_test_ticks, self_test_digest)
};
VERP_PACKED(ParamsImage);

enum class ImageFault : std::uint8_t {
  kNone = 0,
  kTruncated = 1,
  kNotAnImage = 2,
  kOtherLayout = 3,  ///< written for another kImageVersion
  kOtherCore = 4,    ///< golden results of another kCoreVersion
  kDamaged = 5,      ///< CRC mismatch
  kOutOfBounds = 6,  ///< an index outside its table
  kOutOfRange = 7,   ///< not finite or implausible; numbers_fit() names it
};

/// Names the robot: equal only for equal bytes, up to 2^-32.
std::uint32_t params_crc(const Params& params);

/// Fills in the header.
void seal_image(ParamsImage& image);

/// `size` may exceed the image (a flash section).
ImageFault check_image(const void* bytes, std::size_t size);

/// True if indices are inside their tables and parents precede children.
bool is_well_formed(const Params& params);

}  // namespace verp
