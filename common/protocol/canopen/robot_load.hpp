#pragma once
#include <cstdint>

#include "common/protocol/canopen/bus_load.hpp"
#include "common/protocol/canopen/published_tick.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"

/// Load of a robot's CAN bus in one tick, from the plan that configures its nodes (robot_plan.hpp).
/// Other requests to nodes are not counted.
namespace verp::canopen::plan {

struct LoadFormat {
  Stuffing stuffing = Stuffing::kWorst;
  bool fd = false;  ///< FD frames with more drives each
};

/// A usual tick, or one with new controlwords and strengths for all drives.
enum class TickKind : std::uint8_t { kSteady, kChange };

/// `kind` with as many drives as an FD frame's 64 bytes hold.
constexpr Shared widened(Shared kind) {
  kind.width = static_cast<std::uint8_t>(kMaxCanFdData / kind.bytes_each());
  return kind;
}

class TickLoad {
 public:
  constexpr TickLoad(const Params& params, LoadFormat format) : params_(params), format_(format) {}

  constexpr FrameBits bits(TickKind kind) const {
    FrameBits sum = of(1) * sync_groups(params_);
    sum += of(kDriveAnswerBytes) * params_.servo_count();
    if (params_.imu.device_id != 0) sum += of(kImuAnswerBytes) * 2;
    for (const std::uint8_t id : params_.feet.device_id) {
      if (id != 0) sum += of(kFootAnswerBytes);
    }
    sum += all(kGoals);
    const bool change = kind == TickKind::kChange;
    sum += change ? all(kWords) : one(kWords);
    if (change) sum += all(kStrengths);
    sum += of(sdo::kFrameBytes) * 2;                 // one drive's telemetry
    sum += of(sdo::kFrameBytes) * 2 / kEffortTicks;  // one drive's velocity or torque
    sum += of(1);                                    // controller's heartbeat
    return sum;
  }
  /// Additional bits of a published tick (published_tick.hpp). `own_imu`: no other frame holds the
  /// IMU's counts.
  constexpr FrameBits published(bool own_imu) const {
    return of(published::kFrameBytes) * (published::kFrames + (own_imu ? published::kImuParts : 0));
  }
  /// Additional bits of a tick with new orders.
  constexpr FrameBits published_order() const {
    return of(published::kFrameBytes) * published::kOrderParts;
  }

 private:
  constexpr FrameBits of(std::size_t bytes) const {
    if (format_.fd) return fd_bits(bytes, format_.stuffing, true);
    return classic_bits(static_cast<std::uint8_t>(bytes), format_.stuffing);
  }
  constexpr FrameBits frame(const Shared& kind, int which) const {
    return of(static_cast<std::size_t>(members_of(kind, params_, which)) * kind.bytes_each());
  }
  constexpr FrameBits all(Shared kind) const {
    if (format_.fd) kind = widened(kind);
    FrameBits sum;
    for (int f = 0; f < shared_frames(kind, params_); ++f) sum += frame(kind, f);
    return sum;
  }
  constexpr FrameBits one(Shared kind) const {
    if (format_.fd) kind = widened(kind);
    return params_.servo_count() > 0 ? frame(kind, 0) : FrameBits{};
  }

  const Params& params_;
  LoadFormat format_;
};

/// Most load of a steady tick. Above it nothing can be repeated, so the robot is refused.
inline constexpr std::uint32_t kMostLoadPermille = 800;
/// A tick in which all drives change state must end before the next.
inline constexpr std::uint32_t kMostChangePermille = 1000;

/// True if a bus carries the ticks of all drives; ignores baud and period of `params`.
constexpr bool has_room(const Params& params, bool fd, const BitRates& rates,
                        std::uint32_t period_us) {
  const TickLoad load(params, {.stuffing = Stuffing::kWorst, .fd = fd});
  return load_permille(load.bits(TickKind::kSteady), rates, period_us) <= kMostLoadPermille &&
         load_permille(load.bits(TickKind::kChange), rates, period_us) <= kMostChangePermille;
}
/// Drives that fit, in joint order. Calls `fits` with fewer and fewer.
template <class Fits>
int drives_that_fit(Params part, const Fits& fits) {
  part.joint_count = part.servo_count();
  part.followers = 0;
  while (part.joint_count > 0 && !fits(part)) --part.joint_count;
  return part.joint_count;
}

/// Most load for publishing by default. Ticks with orders must stay under kMostLoadPermille, with
/// all drives changing state under kMostChangePermille. `own_imu`: see TickLoad::published().
inline constexpr std::uint32_t kMostToPublishPermille = 700;
constexpr bool has_room_to_publish(const Params& params, bool own_imu) {
  if (params.baud == 0 || params.period_us == 0) return false;
  const TickLoad load(params, {});
  const auto share = [&](TickKind kind, bool ordered) {
    FrameBits bits = load.bits(kind);
    bits += load.published(own_imu);
    if (ordered) bits += load.published_order();
    return load_permille(bits, {params.baud, params.baud}, params.period_us);
  };
  return share(TickKind::kSteady, false) <= kMostToPublishPermille &&
         share(TickKind::kSteady, true) <= kMostLoadPermille &&
         share(TickKind::kChange, true) <= kMostChangePermille;
}

/// Duration of a steady tick on a classic bus, with the worst stuffing.
constexpr std::uint32_t tick_us(const Params& params) {
  const FrameBits bits = TickLoad(params, {}).bits(TickKind::kSteady);
  return static_cast<std::uint32_t>((wire_time_ns(bits, {params.baud, params.baud}) + 999) / 1000);
}

}  // namespace verp::canopen::plan
