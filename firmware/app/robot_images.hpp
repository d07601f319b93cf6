#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/action/kept.hpp"
#include "firmware/app/block_window.hpp"

namespace verp::app {

/// Flash where new actions wait until they are complete.
///  - room(): bytes; bytes(): memory address, aligned to 4.
///  - begin(): discards the contents. ready(): it may be written.
///  - write(offset, from, count): in any order, repeats allowed. False: the memory failed.
template <class Place>
concept ActionPlace = requires(Place& place, const Place& seen, std::size_t offset,
                               const std::uint8_t* from, std::size_t count) {
  { seen.room() } -> std::same_as<std::size_t>;
  { seen.bytes() } -> std::same_as<const std::uint8_t*>;
  { seen.ready() } -> std::same_as<bool>;
  { place.begin() } -> std::same_as<void>;
  { place.write(offset, from, count) } -> std::same_as<bool>;
};

/// Params image and actions. New actions must carry the active robot's own Params in front. The
/// board stores both and starts with them.
template <ActionPlace Place>
class RobotImages final : public Images {
 public:
  /// `actions`: the active ones, perhaps none, in a memory of `actions_bytes`.
  RobotImages(const ParamsImage& robot, const std::uint8_t* actions, std::size_t actions_bytes,
              Place& place)
      : robot_(robot),
        robots_(robot),
        actions_(actions),
        actions_bytes_(action::kept_size(actions, actions_bytes)),
        place_(place) {}

  const ParamsImage* accepted_robot() const { return robots_.accepted(); }
  /// Bytes of the committed new actions, or 0.
  std::size_t accepted_actions() const { return accepted_bytes_; }
  /// Bytes of the active actions; 0: none, or damaged.
  std::size_t actions_bytes() const { return actions_bytes_; }

  // Images
  std::size_t size(ImageKind kind) const override {
    return kind == ImageKind::kActions ? actions_bytes_ : robots_.size(kind);
  }
  std::size_t room(ImageKind kind) const override {
    return kind == ImageKind::kActions ? place_.room() : robots_.room(kind);
  }
  void read(ImageKind kind, std::size_t offset, std::uint8_t* to,
            std::size_t count) const override {
    if (kind != ImageKind::kActions) return robots_.read(kind, offset, to, count);
    __builtin_memcpy(to, actions_ + offset, count);
  }
  void begin(ImageKind kind) override {
    if (kind != ImageKind::kActions) return robots_.begin(kind);
    accepted_bytes_ = written_ = 0;
    begun_ = false;
  }
  Taken write(ImageKind kind, std::size_t offset, const std::uint8_t* from,
              std::size_t count) override {
    if (kind != ImageKind::kActions) return robots_.write(kind, offset, from, count);
    accepted_bytes_ = 0;
    if (!begun_) place_.begin();  // not earlier: reading causes no erase
    begun_ = true;
    if (!place_.ready()) return Taken::kNotYet;
    if (!place_.write(offset, from, count)) return Taken::kNo;
    if (offset + count > written_) written_ = offset + count;
    return Taken::kYes;
  }
  std::uint8_t commit(ImageKind kind, std::uint32_t crc) override {
    if (kind != ImageKind::kActions) return robots_.commit(kind, crc);
    if (written_ == 0 || crc32(place_.bytes(), written_) != crc) return kWrongWindowCrc;
    const action::KeptFault fault = check();
    accepted_bytes_ = fault == action::KeptFault::kNone ? written_ : 0;
    return static_cast<std::uint8_t>(fault);
  }

 private:
  action::KeptFault check() const {
    const action::KeptFault fault = action::check_any_kept(place_.bytes(), written_);
    if (fault != action::KeptFault::kNone) return fault;
    const bool has_robot = check_image(&robot_, sizeof robot_) == ImageFault::kNone;
    return has_robot ? action::check_kept(place_.bytes(), written_, robot_.params)
                     : action::KeptFault::kOtherRobot;
  }

  const ParamsImage& robot_;
  ParamsImages robots_;
  const std::uint8_t* actions_;
  std::size_t actions_bytes_;
  Place& place_;
  std::size_t written_ = 0;
  std::size_t accepted_bytes_ = 0;
  bool begun_ = false;
};

}  // namespace verp::app
