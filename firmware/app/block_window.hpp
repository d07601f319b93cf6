#pragma once
#include <cstddef>
#include <cstdint>

#include "common/model/image.hpp"
#include "common/protocol/controller_table.hpp"

/// Images behind the registers window_..., block by block.
namespace verp {
struct State;
struct TickRecord;
}  // namespace verp
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
///  - keeps_ticks(): it takes ticks (tick_log.hpp). keep(): the tick that ended. hold(): the value
///  of
///    register tick_hold.
class Images {
 public:
  virtual std::size_t size(ImageKind kind) const = 0;
  virtual std::size_t room(ImageKind kind) const = 0;
  virtual void read(ImageKind kind, std::size_t offset, std::uint8_t* to,
                    std::size_t count) const = 0;
  virtual void begin(ImageKind kind) = 0;
  virtual Taken write(ImageKind kind, std::size_t offset, const std::uint8_t* from,
                      std::size_t count) = 0;
  virtual std::uint8_t commit(ImageKind kind, std::uint32_t crc) = 0;
  virtual bool keeps_ticks() const { return false; }
  virtual void keep(const TickRecord&, const State&) {}
  virtual void hold(std::uint8_t) {}

 protected:
  ~Images() = default;
};

class NoImages final : public Images {
 public:
  std::size_t size(ImageKind) const override { return 0; }
  std::size_t room(ImageKind) const override { return 0; }
  void read(ImageKind, std::size_t, std::uint8_t*, std::size_t) const override {}
  void begin(ImageKind) override {}
  Taken write(ImageKind, std::size_t, const std::uint8_t*, std::size_t) override {
    return Taken::kNo;
  }
  std::uint8_t commit(ImageKind, std::uint32_t) override { return kWrongWindowCrc; }
};
inline constinit NoImages no_images;

/// The robot's Params image. A new one stays in RAM; the board stores it and starts with it.
class ParamsImages final : public Images {
 public:
  explicit ParamsImages(const ParamsImage& in_force) : in_force_(in_force) {}

  /// Committed, or nullptr.
  const ParamsImage* accepted() const { return accepted_ ? &staged_ : nullptr; }

  // Images
  std::size_t size(ImageKind kind) const override;
  std::size_t room(ImageKind kind) const override { return size(kind); }
  void read(ImageKind, std::size_t offset, std::uint8_t* to, std::size_t count) const override;
  void begin(ImageKind) override;
  Taken write(ImageKind, std::size_t offset, const std::uint8_t* from, std::size_t count) override;
  std::uint8_t commit(ImageKind, std::uint32_t crc) override;

 private:
  const ParamsImage& in_force_;
  ParamsImage staged_;
  bool accepted_ = false;
};

}  // namespace verp::app
