#include "host/twin/can/positioning.hpp"

#include <algorithm>
#include <cmath>

namespace verp::can {
namespace {

constexpr double kWork_s = 1e-3;
constexpr double kThere = 1e-3;  ///< increments

}  // namespace

// Limits the speed so that whole steps can still brake: v step / 2 + v^2 / 2d is left.
void Ramp::advance(const SetPoint& to, bool halt, double step_s) {
  const double left = to.target - count_;
  const double brake = to.deceleration * step_s;
  const double brakes =
      std::sqrt(brake * brake / 4 + 2 * to.deceleration * std::abs(left)) - brake / 2;
  const double wanted = halt ? 0 : std::copysign(std::min(to.velocity, brakes), left);
  const bool faster = wanted * speed_count_s_ >= 0 && std::abs(wanted) > std::abs(speed_count_s_);
  const double most = faster ? to.acceleration * step_s : brake;
  const double before = speed_count_s_;
  speed_count_s_ += std::clamp(wanted - before, -most, most);
  if (before * speed_count_s_ < 0) speed_count_s_ = 0;
  const double move = speed_count_s_ * step_s;
  const bool slow = std::abs(speed_count_s_) <= 2 * brake;
  if (!halt && slow && std::abs(left) <= std::max(std::abs(move), kThere)) return stand(to.target);
  count_ += move;
}

void ProfilePosition::stand(double count) {
  *this = ProfilePosition();
  ramp_.stand(count);
  active_.target = last_target_ = count;
}

void ProfilePosition::control(const Controlword& word) {
  word_ = word.now;
  if (word.rises(kBitStart)) asked_ = word.now;
}

void ProfilePosition::take(std::uint16_t word, const canopen::cia402::DriveObjects& drive,
                           const ProfileObjects& profile) {
  const bool at_once = (word & kBitAtOnce) != 0, relative = (word & kBitRelative) != 0;
  if (next_ && !at_once) return;
  const double wanted = drive.target_position + (relative ? last_target_ : 0);
  const SetPoint point{
      .target = std::min(std::max<double>(wanted, drive.min_position),
                         static_cast<double>(drive.max_position)),
      .velocity = static_cast<double>(std::min(profile.velocity, profile.max_velocity)),
      .acceleration = static_cast<double>(profile.acceleration),
      .deceleration = static_cast<double>(profile.deceleration)};
  limited_ = point.target != wanted;
  last_target_ = point.target;
  taken_ = true;
  reached_ = false;
  inside_since_us_.reset();
  if (!done_ && !at_once) {
    next_ = point;
    return;
  }
  active_ = point;
  next_.reset();
  done_ = false;
}

void ProfilePosition::advance(const canopen::cia402::DriveObjects& drive,
                              const ProfileObjects& profile, std::uint64_t now_us) {
  if ((word_ & kBitStart) == 0) taken_ = false;
  if (asked_) take(*asked_, drive, profile);
  asked_.reset();
  ramp_.advance(active_, (word_ & kBitHalt) != 0, kWork_s);
  reached_ = within(drive.actual_position, profile, now_us);
  done_ = done_ || reached_;
  if (!done_ || !next_) return;
  active_ = *next_;
  next_.reset();
  done_ = reached_ = false;
  inside_since_us_.reset();
}

bool ProfilePosition::within(double actual, const ProfileObjects& profile, std::uint64_t now_us) {
  const bool watched = profile.position_window != UINT32_MAX;
  const bool inside = ramp_.count() == active_.target &&
                      (!watched || std::abs(active_.target - actual) <= profile.position_window);
  if (!inside) {
    inside_since_us_.reset();
    return false;
  }
  if (!inside_since_us_) inside_since_us_ = now_us;
  return !watched ||
         now_us >= *inside_since_us_ + std::uint64_t{profile.position_window_time_ms} * 1000;
}

std::uint16_t ProfilePosition::status() const {
  const bool reached = (word_ & kBitHalt) != 0 ? ramp_.count_s() == 0 : reached_;
  const bool taken = taken_ || next_.has_value();
  return static_cast<std::uint16_t>((reached ? kTargetReached : 0) | (taken ? kSetPointTaken : 0));
}

bool Homing::control(const Controlword& word, std::int8_t method) {
  if (word.rises(kBitStart)) {
    started_ = true;
    result_ = Result::kNone;
  }
  if (!word.has(kBitStart)) started_ = false;
  if (!started_ || word.has(kBitHalt)) return false;
  started_ = false;
  result_ = homes_in_place(method) ? Result::kAttained : Result::kError;
  return result_ == Result::kAttained;
}

// Bit 10: nothing moves.
std::uint16_t Homing::status() const {
  if (result_ == Result::kError) return kTargetReached | kHomingError;
  return result_ == Result::kAttained ? kTargetReached | kHomingAttained : kTargetReached;
}

}  // namespace verp::can
