#include "host/study/identify/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/safety/machine.hpp"
#include "host/trace/record/decisions.hpp"

namespace verp::identify {
namespace {

constexpr double kGravity_m_s2 = 9.80665;
/// A stand gives way; a walking robot turns ten times as fast.
constexpr double kMostTurn_rad_s = 0.15;
/// Share of the weight; above the force sensors' error.
constexpr double kMostBorne = 0.15;

/// True if the servos have full torque and follow the controller's goals.
bool drives(const Outputs& outputs) {
  using safety::Mode;
  const auto mode = static_cast<Mode>(outputs.mode);
  return mode == Mode::kStanding || mode == Mode::kWalking || mode == Mode::kActing;
}

/// How the robot was held, by the other sensors.
class Surroundings {
 public:
  explicit Surroundings(const Params& params) : params_(params) {}

  void see(const Inputs& in) {
    if ((in.flags & kImuFresh) != 0) see_imu(in);
    if ((in.flags & kFeetFresh) != 0) {
      double counts = 0;
      for (const auto& foot : in.foot_count) {
        for (const std::uint16_t cell : foot) counts += cell;
      }
      borne_n_ += counts * static_cast<double>(params_.feet.newton_per_count);
      ++felt_;
    }
    if ((in.flags & kSlowFresh) != 0 && in.slow_voltage_tenth_v != 0) {
      volts_ += 0.1 * in.slow_voltage_tenth_v;
      ++told_;
    }
  }

  double supply_v() const { return told_ > 0 ? volts_ / told_ : 0; }
  Eigen::Vector3d up_body() const {
    return up_.norm() > 0 ? Eigen::Vector3d(up_.normalized()) : Eigen::Vector3d::UnitZ();
  }
  void require_a_stand(const std::filesystem::path& file) const {
    const char* remedy =
        "hang the robot by its trunk, feet in the air (`verp action play --held`), and record anew";
    const double turn_rad_s = turning();
    if (turn_rad_s > kMostTurn_rad_s) {
      throw record::TraceError(file,
                               fmt::format("its trunk turned with {:.0f} degrees/s (rms): that is "
                                           "no robot in a stand",
                                           turn_rad_s * 180 / std::numbers::pi),
                               remedy);
    }
    double weight_n = params_.body_mass_kg * kGravity_m_s2;
    for (int j = 0; j < params_.joint_count; ++j) {
      weight_n += params_.joint[j].mass_kg * kGravity_m_s2;
    }
    const double borne_n = felt_ > 0 ? borne_n_ / felt_ : 0;
    if (borne_n > kMostBorne * weight_n) {
      throw record::TraceError(
          file, fmt::format("its feet bore {:.0f} % of its weight", 100 * borne_n / weight_n),
          remedy);
    }
  }

 private:
  void see_imu(const Inputs& in) {
    const float* turn = params_.imu.body_imu;
    for (int row = 0; row < 3; ++row) {
      double g = 0;
      for (int column = 0; column < 3; ++column) {
        g += static_cast<double>(turn[3 * row + column]) * in.accel_count[column];
      }
      up_[row] += g;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double rate =
          in.gyro_count[axis] * static_cast<double>(params_.imu.gyro_rad_s_per_count);
      rate_[axis] += rate;
      squares_ += rate * rate;
    }
    ++turned_;
  }
  /// Spread about the mean, which is the gyro's bias.
  double turning() const {
    if (turned_ == 0) return 0;
    const double mean = (rate_ / turned_).squaredNorm();
    return std::sqrt(std::max(0.0, squares_ / turned_ - mean));
  }

  const Params& params_;
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero(), rate_ = Eigen::Vector3d::Zero();
  double squares_ = 0, borne_n_ = 0, volts_ = 0;
  int turned_ = 0, felt_ = 0, told_ = 0;
};

}  // namespace

Recording recording_of(const record::Trace& trace) {
  if (trace.ticks.empty()) {
    throw record::TraceError(trace.file, "holds no tick", "record a run that begins");
  }
  Recording recording;
  recording.params = trace.params;
  record::Decisions decisions(trace);
  Surroundings around(trace.params);
  std::uint32_t first = 0;
  for (const TickRecord& record : trace.ticks) {
    const Inputs& in = record.inputs;
    const Outputs* out = decisions.at(record);
    if (out == nullptr && recording.ticks.empty()) {
      throw record::TraceError(
          trace.file,
          fmt::format("at tick {} this program decides otherwise than the one that recorded it, so "
                      "nobody knows what the servos were told",
                      in.tick),
          "use the VERP that recorded it, or record anew");
    }
    if (out == nullptr || !drives(*out)) {
      if (!recording.ticks.empty()) break;
      continue;
    }
    if (recording.ticks.empty()) first = in.tick;
    Recording::Tick& tick = recording.ticks.emplace_back();
    tick.slot = in.tick - first;
    tick.fresh = in.fresh;
    tick.goal.assign(out->goal_count, out->goal_count + trace.params.joint_count);
    tick.position.assign(in.position_count, in.position_count + trace.params.joint_count);
    around.see(in);
  }
  if (recording.ticks.empty()) {
    throw record::TraceError(trace.file, "the robot never stood with all of its strength",
                             "let it stand up first, and move then");
  }
  around.require_a_stand(trace.file);
  recording.supply_v = around.supply_v();
  recording.up_body = around.up_body();
  return recording;
}

}  // namespace verp::identify
