#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/kinematics/look_at.hpp"
#include "common/math/convert.hpp"
#include "common/model/params.hpp"
#include "firmware/app/register_image.hpp"

namespace verp::app {

/// The order in registers request to emergency_stop, and whether it still counts. The core gets up
/// on a level, not on an edge. So this class keeps a repeated or stale order from raising a robot
/// that nobody watches.
class StandingOrder {
 public:
  StandingOrder(const Params& params, RegisterImage& image) : params_(params), image_(image) {}

  /// After each start, also by the watchdog, the first request must be to relax.
  bool takes(Request request) const { return relaxed_once_ || request == Request::kRelax; }
  /// A request that takes() accepted was written.
  void requested() {
    relaxed_once_ = true;
    relax_asked_ = relax_asked_ || image_.get<Request>(reg("request")) == Request::kRelax;
  }
  /// A request to relax was written, even if it was one before; returned once.
  bool take_relax() {
    const bool asked = relax_asked_;
    relax_asked_ = false;
    return asked;
  }
  /// A register was written: the operator is present.
  void given() { fresh_ = true; }

  /// True if the loop stopped before this tick for longer than an order lasts, as in a flash erase.
  /// Once a tick.
  bool slept_until(std::uint32_t tick, float order_lasts_s) {
    const std::uint32_t ticks = ticking_ && tick > tick_ ? tick - tick_ : 0;
    tick_ = tick;
    ticking_ = true;
    const float gap_s = 1e-6F * static_cast<float>(params_.period_us) * static_cast<float>(ticks);
    return gap_s > order_lasts_s;
  }
  /// Cancels the standing order; the operator may have disconnected. A robot with torque keeps it
  /// and waits for the next as the core decides.
  void withdraw(bool armed) {
    fresh_ = false;
    if (!armed) image_.set(reg("request"), Request::kRelax);
  }

  /// The order for the next tick. It is fresh only once.
  Command take(std::uint16_t& flags) {
    Command command;
    command.request = image_.get<Request>(reg("request"));
    command.sequence = image_.get<std::uint8_t>(reg("command_sequence"));
    command.vx_tenth_mm_s = word(reg("walk_vx"));
    command.vy_tenth_mm_s = word(reg("walk_vy"));
    command.wz_mrad_s = word(reg("walk_wz"));
    point_head(command);
    if (fresh_) flags |= kCommandFresh;
    if (image_.get<std::uint8_t>(reg("emergency_stop")) != 0) flags |= kEmergencyStop;
    fresh_ = false;
    return command;
  }

 private:
  std::int16_t word(std::uint16_t address) const { return image_.get<std::int16_t>(address); }

  void point_head(Command& command) const {
    command.head_pan_mrad = word(reg("head_pan"));
    command.head_tilt_mrad = word(reg("head_tilt"));
    if (image_.get<table::HeadMode>(reg("head_mode")) != table::HeadMode::kLookAt) return;
    const Vec3 point_body_mm{math::to_float(std::int32_t{word(reg("look_x"))}),
                             math::to_float(std::int32_t{word(reg("look_y"))}),
                             math::to_float(std::int32_t{word(reg("look_z"))})};
    const kinematics::HeadAngles angles = kinematics::look_at(params_, 1e-3F * point_body_mm);
    command.head_pan_mrad = static_cast<std::int16_t>(math::to_int32(1e3F * angles.pan_rad));
    command.head_tilt_mrad = static_cast<std::int16_t>(math::to_int32(1e3F * angles.tilt_rad));
  }

  const Params& params_;
  RegisterImage& image_;
  std::uint32_t tick_ = 0;
  bool ticking_ = false;
  bool relaxed_once_ = false;
  bool relax_asked_ = false;
  bool fresh_ = false;
};

}  // namespace verp::app
