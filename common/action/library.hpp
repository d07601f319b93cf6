#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/model/params.hpp"

/// A constant image: header, actions, key frames. host/author/action makes it from text.
namespace verp::action {

/// Raise when the image's layout or meaning changes.
inline constexpr std::uint32_t kLibraryVersion = 1;
inline constexpr char kLibraryMagic[8] = {'V', 'E', 'R', 'P', 'A', 'C', 'T', '1'};
inline constexpr int kMaxActions = 255;  ///< a number is one byte, 0: no action
inline constexpr int kMaxFrames = 4096;

struct LibraryHeader {
  char magic[8] = {};
  std::uint32_t library_version = 0;
  std::uint32_t size = 0;   ///< of the whole image, header included
  std::uint32_t crc32 = 0;  ///< of all bytes after the header
  std::uint16_t actions = 0;
  std::uint16_t frames = 0;
  VERP_FIELDS(magic, library_version, size, crc32, actions, frames)
};
VERP_PACKED(LibraryHeader);

struct Action {
  char name[kNameLength] = {};
  std::uint16_t first = 0;  ///< its first key frame
  std::uint16_t frames = 0;
  VERP_FIELDS(name, first, frames)
};
VERP_PACKED(Action);

/// The controller starts these actions itself: a pose that bears a fall, getting up from each side,
/// and from the crouch to the floor, where torque may go.
inline constexpr char kFallSafe[kNameLength] = "fall_safe";
inline constexpr char kGetUpFront[kNameLength] = "get_up_front";
inline constexpr char kGetUpBack[kNameLength] = "get_up_back";
inline constexpr char kGetUpLeft[kNameLength] = "get_up_left";
inline constexpr char kGetUpRight[kNameLength] = "get_up_right";
inline constexpr char kLieDown[kNameLength] = "lie_down";

/// As `next`, `otherwise` or `exit` of a frame: back to the stand.
inline constexpr std::uint16_t kToStand = 0xFFFF;

/// Condition for leaving a frame.
enum class Condition : std::uint8_t {
  kNone,
  kUpright,
  kLiesFront,
  kLiesBack,
  kLiesLeft,
  kLiesRight,
  kLeftFoot,  ///< its sensors feel the ground
  kRightFoot,
  kBothFeet,
  kNoFoot,
};
inline constexpr int kConditions = 10;

enum class Stance : std::uint8_t { kLeft = 0, kRight = 1, kBoth = 2, kNone = 3 };

struct Frame {
  std::uint16_t time_ms = 0;   ///< duration of the motion, at least kLeastFrame_ms
  std::uint16_t pause_ms = 0;  ///< then the pose is held
  std::uint16_t wait_ms = 0;   ///< then at most this long for `condition`
  std::uint16_t next = kToStand;
  std::uint16_t otherwise = kToStand;  ///< next frame if `condition` fails
  std::uint16_t exit = kToStand;       ///< next frame on a stop
  std::uint16_t loop_to = kToStand;    ///< next frame for the first `loops` times
  std::uint8_t loops = 0;
  Condition condition = Condition::kNone;
  Stance stance = Stance::kBoth;  ///< feet that carry the robot
  std::uint8_t balance = 1;       ///< 1: legs with feedback and gravity feed-forward
  std::uint16_t reserved = 0;
  std::uint32_t joints = 0;  ///< bit j: joint j has a goal; others stand
  std::uint32_t smooth = 0;  ///< bit j: quintic motion; else cubic
  std::int16_t goal_tenth_mrad[kMaxJoints] = {};
  std::int16_t speed_mrad_s[kMaxJoints] = {};  ///< speed in passing the goal
  std::uint8_t stiffness_percent[kMaxJoints] = {};
  VERP_FIELDS(time_ms, pause_ms, wait_ms, next, otherwise, exit, loop_to, loops, condition, stance,
              balance, reserved, joints, smooth, goal_tenth_mrad, speed_mrad_s, stiffness_percent)
};
VERP_PACKED(Frame);
/// No servo follows shorter frames. Bounds a tick's work.
inline constexpr int kLeastFrame_ms = 20;

enum class LibraryFault : std::uint8_t {
  kNone = 0,
  kTruncated = 1,
  kNotALibrary = 2,
  kOtherLayout = 3,  ///< another kLibraryVersion
  kDamaged = 4,      ///< CRC mismatch
  kOutOfBounds = 5,  ///< a wrong reference or an unknown kind
};
inline constexpr const char* kLibraryFaultNames[] = {
    "none", "truncated", "no action library", "of another version", "damaged", "out of bounds"};

/// View of an image, which must outlive the view. Without an image there are no actions.
class Library {
 public:
  constexpr Library() = default;
  /// `bytes` aligned to 4; no actions on a fault.
  Library(const void* bytes, std::size_t size);

  int count() const { return header_ == nullptr ? 0 : header_->actions; }
  /// `number` is 1 to count().
  const Action& action(int number) const { return actions_[number - 1]; }
  const Frame& frame(int index) const { return frames_[index]; }
  /// Number of the action with this name; 0 if there is none.
  std::uint8_t number_of(const char (&name)[kNameLength]) const;

 private:
  const LibraryHeader* header_ = nullptr;
  const Action* actions_ = nullptr;
  const Frame* frames_ = nullptr;
};

/// `size` may exceed the image (a flash section).
LibraryFault check_library(const void* bytes, std::size_t size);

}  // namespace verp::action
