#pragma once
#include <cstdint>
#include <optional>

#include "host/twin/can/profile_objects.hpp"

/// CiA 402's controlword and statusword in modes 1 and 6. Positions are the
/// application's (6064h), in increments.
namespace verp::can {

// Bits of the controlword.
inline constexpr std::uint16_t kBitStart = 1 << 4;     ///< new set-point; start homing
inline constexpr std::uint16_t kBitAtOnce = 1 << 5;    ///< change set immediately
inline constexpr std::uint16_t kBitRelative = 1 << 6;  ///< to the set-point before it
inline constexpr std::uint16_t kBitHalt = 1 << 8;

// Bits of the statusword.
inline constexpr std::uint16_t kTargetReached = 1 << 10;
inline constexpr std::uint16_t kSetPointTaken = 1 << 12;
inline constexpr std::uint16_t kHomingAttained = 1 << 12;
inline constexpr std::uint16_t kHomingError = 1 << 13;

struct Controlword {
  std::uint16_t now = 0;
  std::uint16_t before = 0;

  bool has(std::uint16_t bit) const { return (now & bit) != 0; }
  bool rises(std::uint16_t bit) const { return (now & ~before & bit) != 0; }
};

/// A set-point with the ramp that counts when it is given.
struct SetPoint {
  double target = 0;
  double velocity = 0;
  double acceleration = 1;
  double deceleration = 1;
};

/// The goal on its way: a trapezoid of speed.
class Ramp {
 public:
  void stand(double count) {
    count_ = count;
    speed_count_s_ = 0;
  }
  /// With `halt` it brakes and stands.
  void advance(const SetPoint& to, bool halt, double step_s);
  double count() const { return count_; }
  double count_s() const { return speed_count_s_; }

 private:
  double count_ = 0;
  double speed_count_s_ = 0;
};

/// Mode 1: one set-point is under way, and one may wait for it.
class ProfilePosition {
 public:
  /// Drops the set-points; the goal is there.
  void stand(double count);
  /// Call for each controlword.
  void control(const Controlword& word);
  /// Call once a millisecond. Takes a set-point only now, when all objects of its frame are
  /// written, and cuts it at 607Dh.
  void advance(const canopen::cia402::DriveObjects& drive, const ProfileObjects& profile,
               std::uint64_t now_us);

  double goal() const { return ramp_.count(); }
  /// 607Dh cut the set-point.
  bool limited() const { return limited_; }
  std::uint16_t status() const;

 private:
  void take(std::uint16_t word, const canopen::cia402::DriveObjects& drive,
            const ProfileObjects& profile);
  bool within(double actual, const ProfileObjects& profile, std::uint64_t now_us);

  Ramp ramp_;
  SetPoint active_;
  std::optional<SetPoint> next_;
  std::optional<std::uint16_t> asked_;  ///< controlword of a set-point to take
  double last_target_ = 0;              ///< base of a relative set-point
  std::uint16_t word_ = 0;              ///< controlword
  bool taken_ = false;                  ///< until bit 4 falls
  bool done_ = true;                    ///< the active one was reached
  bool reached_ = true;                 ///< and is now
  bool limited_ = false;
  std::optional<std::uint64_t> inside_since_us_;
};

/// Mode 6.
class Homing {
 public:
  /// Call for each controlword. True: home is here.
  bool control(const Controlword& word, std::int8_t method);
  std::uint16_t status() const;

 private:
  enum class Result { kNone, kAttained, kError };
  Result result_ = Result::kNone;
  bool started_ = false;  ///< and held back by halt
};

}  // namespace verp::can
