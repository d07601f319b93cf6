#pragma once
#include <cstdint>

#include "common/protocol/canopen/bus_load.hpp"
#include "common/protocol/canopen/published_tick.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"

/// What a robot's CAN bus has to carry in one tick, frame by frame, from the same plan that its
/// nodes are set up by (robot_plan.hpp). `verp bus load`, the refusal of a bus that is too slow and
/// the test against the twin's own count of bits all come from here. What is counted is what comes
/// with each tick; not what somebody asks a node for beside it.
namespace verp::canopen::plan {

/// Which frames the nodes use.
struct LoadFormat {
  Stuffing stuffing = Stuffing::kWorst;
  bool fd = false;  ///< FD frames that switch their rate; goals and words of more drives in each
};

/// A tick like most, or one in which all drives get new controlwords and strengths.
enum class TickKind : std::uint8_t { kSteady, kChange };

/// As `kind`, with so many drives to a frame as an FD frame's 64 bytes have room for.
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
    sum += of(sdo::kFrameBytes) * 2;                 // one drive's telemetry, asked for and given
    sum += of(sdo::kFrameBytes) * 2 / kEffortTicks;  // one drive's velocity or torque
    sum += of(1);                                    // the controller's heartbeat
    return sum;
  }
  /// What the controller tells of each tick (published_tick.hpp) comes on top. `own_imu`: the IMU's
  /// counts stand in no other frame.
  constexpr FrameBits published(bool own_imu) const {
    return of(published::kFrameBytes) * (published::kFrames + (own_imu ? published::kImuParts : 0));
  }
  /// And more of a tick with new orders.
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

/// Over this share of the period there is no room for a repetition of anything: such a robot is
/// refused, as on the serial bus.
inline constexpr std::uint32_t kMostLoadPermille = 800;
/// A tick in which all drives change their state has to end before the next one.
inline constexpr std::uint32_t kMostChangePermille = 1000;

/// Whether a bus carries the ticks of all drives in `params`, whose own baud and period do not
/// count.
constexpr bool has_room(const Params& params, bool fd, const BitRates& rates,
                        std::uint32_t period_us) {
  const TickLoad load(params, {.stuffing = Stuffing::kWorst, .fd = fd});
  return load_permille(load.bits(TickKind::kSteady), rates, period_us) <= kMostLoadPermille &&
         load_permille(load.bits(TickKind::kChange), rates, period_us) <= kMostChangePermille;
}
/// How many drives do, in the order of joints: the one behind them is the first that does not fit.
/// `fits` is asked with fewer and fewer of them.
template <class Fits>
int drives_that_fit(Params part, const Fits& fits) {
  part.joint_count = part.servo_count();
  part.followers = 0;
  while (part.joint_count > 0 && !fits(part)) --part.joint_count;
  return part.joint_count;
}

/// Over this share a controller does not tell of its ticks unless it is told to. Orders come when
/// somebody gives them, and are no part of it; but new ones with each tick must find room under
/// kMostLoadPermille, and those that come in a tick in which all drives change their state, too.
/// `own_imu`: see TickLoad::published().
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

/// Time that a steady tick takes on a classic bus with worst stuffing.
constexpr std::uint32_t tick_us(const Params& params) {
  const FrameBits bits = TickLoad(params, {}).bits(TickKind::kSteady);
  return static_cast<std::uint32_t>((wire_time_ns(bits, {params.baud, params.baud}) + 999) / 1000);
}

}  // namespace verp::canopen::plan
