#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/model/image.hpp"
#include "common/protocol/controller_table.hpp"

/// What stands behind the registers window_...: whole images that the operator reads and replaces
/// block by block.
namespace verp::app {

enum class ImageKind : std::uint8_t {
  kNone = 0,
  kParams = 1,
  kActions = 2,
  kState = 3,  ///< read only, while tick_hold is 1: tick_log.hpp
  kTicks = 4,  ///< read only
};

/// Why an image was refused, above the values of ImageFault and KeptFault.
inline constexpr std::uint8_t kWrongWindowCrc = 255;
inline constexpr std::uint8_t kBlockNotKept = 254;

/// What became of a block.
enum class Taken : std::uint8_t {
  kYes = 0,
  kNotYet = 1,  ///< a place for the image is being made: write it again
  kNo = 2,      ///< the memory did not keep it: begin the image again
};

/// Images: what can be read and replaced. Called between ticks; no call waits.
///  - size(kind): bytes of the image in force; 0: there is none of that kind here.
///  - room(kind): how many bytes a new one may have; 0: none is taken here.
///  - read(kind, offset, to, count): the image in force; `offset` + `count` is at most its size.
///  - begin(kind): forgets what was written of a new one.
///  - write(kind, offset, from, count): a block of the new one, any order; inside its room. Actions
///    with torque off only: flash is where they wait.
///  - commit(kind, crc): asked with torque off only. 0: the bytes have that CRC-32 and are a good
///    image, with which the controller starts next; else why not, and nothing changed.
template <class Store>
concept Images = requires(Store& store, const Store& seen, ImageKind kind, std::size_t offset,
                          std::uint8_t* to, const std::uint8_t* from, std::size_t count,
                          std::uint32_t crc) {
  { seen.size(kind) } -> std::same_as<std::size_t>;
  { seen.room(kind) } -> std::same_as<std::size_t>;
  { seen.read(kind, offset, to, count) } -> std::same_as<void>;
  { store.begin(kind) } -> std::same_as<void>;
  { store.write(kind, offset, from, count) } -> std::same_as<Taken>;
  { store.commit(kind, crc) } -> std::same_as<std::uint8_t>;
};

/// Nothing to replace: the window stays shut.
struct NoImages {
  static std::size_t size(ImageKind) { return 0; }
  static std::size_t room(ImageKind) { return 0; }
  static void read(ImageKind, std::size_t, std::uint8_t*, std::size_t) {}
  static void begin(ImageKind) {}
  static Taken write(ImageKind, std::size_t, const std::uint8_t*, std::size_t) {
    return Taken::kNo;
  }
  static std::uint8_t commit(ImageKind, std::uint32_t) { return kWrongWindowCrc; }
};
inline constinit NoImages no_images;

/// The robot's Params image; a new one is kept in RAM for the board to start with, and to store.
class ParamsImages {
 public:
  explicit ParamsImages(const ParamsImage& in_force) : in_force_(in_force) {}

  /// The new image, once it was committed; nullptr before.
  const ParamsImage* accepted() const { return accepted_ ? &staged_ : nullptr; }

  // Images
  std::size_t size(ImageKind kind) const {
    return kind == ImageKind::kParams ? sizeof(ParamsImage) : 0;
  }
  std::size_t room(ImageKind kind) const { return size(kind); }
  void read(ImageKind, std::size_t offset, std::uint8_t* to, std::size_t count) const {
    __builtin_memcpy(to, reinterpret_cast<const std::uint8_t*>(&in_force_) + offset, count);
  }
  void begin(ImageKind) {
    accepted_ = false;
    __builtin_memset(reinterpret_cast<std::uint8_t*>(&staged_), 0xFF, sizeof staged_);
  }
  Taken write(ImageKind, std::size_t offset, const std::uint8_t* from, std::size_t count) {
    accepted_ = false;
    __builtin_memcpy(reinterpret_cast<std::uint8_t*>(&staged_) + offset, from, count);
    return Taken::kYes;
  }
  std::uint8_t commit(ImageKind, std::uint32_t crc) {
    if (crc32(&staged_, sizeof staged_) != crc) return kWrongWindowCrc;
    const ImageFault fault = check_image(&staged_, sizeof staged_);
    accepted_ = fault == ImageFault::kNone;
    return static_cast<std::uint8_t>(fault);
  }

 private:
  const ParamsImage& in_force_;
  ParamsImage staged_;
  bool accepted_ = false;
};

static_assert(Images<NoImages> && Images<ParamsImages>);

}  // namespace verp::app
