#include "host/author/import/swing.hpp"

#include <fmt/format.h>

#include "host/run/session/servo_speed.hpp"

namespace verp::import {
namespace {

using Sureness = Finding::Sureness;

constexpr double kKept = 0.95;     // of the strides: the planner shortens by a hundredth at a time
constexpr double kCalmDrop = 0.1;  // of the usual
constexpr const char* kAsk = "do its feet clear the floor?";

class SwingChooser {
 public:
  SwingChooser(const Params& params, bool of_damping) : params_(params), of_damping_(of_damping) {}

  SwingChoice choose() {
    speed_ = session::servo_speed(params_);
    if (speed_.lower_lift_m > 0) lift_slowly();
    if (speed_.walk_m_s > 0 && kept() < kKept) swing_calmly();
    say_speed();
    return std::move(out_);
  }

 private:
  GaitTuning& gait() { return params_.tuning.gait; }

  double kept() const {
    Command walk;
    walk.vx_tenth_mm_s = static_cast<std::int16_t>(1e4 * speed_.walk_m_s);
    return session::kept_stride(params_, walk);
  }

  void set(const char* name, float& value, double wanted) {
    value = static_cast<float>(wanted);
    std::erase_if(out_.tuning, [&](const auto& each) { return each.first == name; });
    out_.tuning.emplace_back(name, wanted);
  }

  void lift_slowly() {
    out_.findings.push_back(
        {Sureness::kGuessed, "lift",
         fmt::format("{:.2g} mm instead of {:.2g}, because joint '{}' would need {:.3g} rad/s, and "
                     "its servo turns {:.3g}",
                     1000 * speed_.lower_lift_m, 1000 * gait().lift_m, speed_.fastest.joint,
                     session::needed_rad_s(speed_.fastest), speed_.fastest.limit_rad_s),
         kAsk});
    set("gait.lift_m", gait().lift_m, speed_.lower_lift_m);
    speed_ = session::servo_speed(params_);
  }

  /// Heavy legs that move fast push the ZMP out of the soles, above all where a foot drops the last
  /// millimetres onto the floor; then less lift helps.
  void swing_calmly() {
    const GaitTuning usual = gait();
    const auto lift_m = static_cast<double>(usual.lift_m);
    const double touchdown_m = kCalmDrop * static_cast<double>(usual.touchdown_m);
    gait().touchdown_m = static_cast<float>(touchdown_m);
    double best = -1, best_m = lift_m;
    for (const double share : {1.0, 0.8, 0.6}) {
      gait().lift_m = static_cast<float>(share * lift_m);
      const double keeps = best < kKept ? kept() : 0;
      if (keeps > best) best = keeps, best_m = share * lift_m;
    }
    if (best_m < lift_m) set("gait.lift_m", gait().lift_m, best_m);
    gait().lift_m = static_cast<float>(best_m);
    set("gait.touchdown_m", gait().touchdown_m, touchdown_m);
    out_.findings.push_back(
        {Sureness::kGuessed, "swing",
         fmt::format("feet rise by {:.2g} mm{} and drop by {:.2g} instead of {:.2g}, because their "
                     "swing would push the ZMP out of the soles",
                     1000 * best_m,
                     best_m < lift_m ? fmt::format(" instead of {:.2g}", 1000 * lift_m) : "",
                     1000 * touchdown_m, 1000 * usual.touchdown_m),
         kAsk});
    speed_ = session::servo_speed(params_);
  }

  void say_speed() {
    const bool enough = speed_.most_m_s == speed_.walk_m_s;
    const char* const why =
        of_damping_ ? " Their speed is the file's torque over its damping;" : "";
    out_.findings.push_back(
        {Sureness::kMeasured, "servo speed", session::text_of(speed_),
         enough ? "" : fmt::format("are the motors so slow?{} --servos TYPE takes others", why)});
  }

  Params params_;
  bool of_damping_;
  session::ServoSpeed speed_;
  SwingChoice out_;
};

}  // namespace

SwingChoice choose_swing(Params params, bool of_damping) {
  return SwingChooser(params, of_damping).choose();
}

}  // namespace verp::import
