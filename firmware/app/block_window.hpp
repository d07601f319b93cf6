#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/model/image.hpp"
#include "common/protocol/controller_table.hpp"

/// Images behind the registers window_..., block by block.
namespace verp::app {

enum class ImageKind : std::uint8_t {
  kNone = 0,
  kParams = 1,
  kActions = 2,
  kState = 3,  ///< read only, while tick_hold is 1: tick_log.hpp
  kTicks = 4,  ///< read only
};

/// Numbered above ImageFault and KeptFault.
inline constexpr std::uint8_t kWrongWindowCrc = 255;
inline constexpr std::uint8_t kBlockNotKept = 254;

enum class Taken : std::uint8_t {
  kYes = 0,
  kNotYet = 1,  ///< the memory is being prepared: write the block again
  kNo = 2,      ///< the memory failed: start the image again
};

/// Call between ticks; no call waits.
///  - size(kind): of the active image, bytes; 0: none of that kind.
///  - room(kind): for a new image; 0: none accepted.
///  - read(kind, offset, to, count): copies from the active image, `offset` + `count` at most its
///    size.
///  - begin(kind): discards what was written of a new image.
///  - write(kind, offset, from, count): a block of the new image, in any order, within its room.
///    Actions need torque off, because they are written to flash.
///  - commit(kind, crc): only with torque off. 0: the CRC-32 fits and the image is valid; the
///    controller starts with it next time. Otherwise the fault, and nothing changed.
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

/// The robot's Params image. A new one stays in RAM; the board stores it and starts with it.
class ParamsImages {
 public:
  explicit ParamsImages(const ParamsImage& in_force) : in_force_(in_force) {}

  /// Committed, or nullptr.
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
