#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/io/io.hpp"
#include "host/twin/sim/robot.hpp"

/// Scores a walk from the controller's Outputs and the twin's truth.
namespace verp::sim {

/// A motor's |torque| / stall torque over control ticks.
struct TorqueUse {
  double mean = 0, peak = 0;
};

/// Physics results of `verp walk --json`; unmeasured numbers have no value.
struct WalkMetrics {
  double duration_s = 0;  ///< from the first tick
  double walk_s = 0;      ///< all three phases
  /// Path of the soles' midpoint from cycle to cycle. Curves and sideways steps count; sway and a
  /// single step do not.
  double distance_m = 0;
  std::optional<double> speed_mean_m_s;  ///< distance_m / walk_s
  /// Transition phase without its first and last two cycles.
  std::optional<double> speed_steady_m_s;
  /// Part of it due to the carrying sole's slip.
  std::optional<double> slip_steady_m_s;
  double ahead_m = 0;          ///< along the first heading; backward is negative
  double lateral_drift_m = 0;  ///< to the left of that heading
  double yaw_drift_deg = 0;    ///< of the body, turns counted
  bool fallen = false;
  /// Distance from the measured ZMP (mean of a control tick) to the centroid of the supporting
  /// sole; in double support, of the next carrying sole.
  std::optional<double> zmp_bias_mean_mm;
  std::array<std::optional<double>, 16> zmp_bias_by_state_mm{};
  /// Share of (joint, physics step) pairs with duty at its limit; and the worst joint's share.
  std::optional<double> servo_saturation;
  std::optional<double> servo_saturation_worst;
  int servo_saturation_worst_joint = 0;
  /// Torque use per joint; empty: it did not walk.
  std::vector<TorqueUse> torque_use;
  /// While walking: energy from the supply, and work on the joints, of the servos alone.
  double supply_energy_j = 0, joint_work_j = 0;
  /// Energy per weight and distance_m. No value for a short path.
  std::optional<double> cost_of_transport, cost_of_transport_mechanical;
  /// Control ticks with self-contact while walking, and the last two links.
  std::uint64_t self_contact_ticks = 0;
  std::array<std::string, 2> self_contact_links;
};

struct SeriesRow {
  double t_s = 0;
  std::uint8_t phase = 0, state = 0, stance = 0;  ///< Outputs
  std::vector<double> goal_rad;
  std::vector<double> joint_rad;  ///< angles reached so far
  std::vector<double> torque_use;
  Vec3 body_world_m = Vec3::Zero();
  Vec3 body_rpy_rad = Vec3::Zero();
  Vec3 com_world_m = Vec3::Zero();
  std::array<Vec3, 2> sole_world_m{Vec3::Zero(), Vec3::Zero()};
  std::array<Vec3, 2> sole_rpy_rad{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> foot_force_n{};
  bool zmp_valid = false;
  Vec2 zmp_world_m = Vec2::Zero();  ///< mean of the past tick
  bool zmp_planned_valid = false;
  Vec2 zmp_planned_world_m = Vec2::Zero();
  std::vector<Vec2> support_world_m;
};

struct Observation {
  Truth truth;
  FootLoads loads;                               ///< since the last observation
  std::uint64_t steps = 0;                       ///< since the start
  std::vector<std::uint64_t> saturated_steps;    ///< since the start
  std::uint64_t self_contact_steps = 0;          ///< since the start
  std::array<int, 2> self_contact_nodes{};       ///< last such step
  double supply_energy_j = 0, joint_work_j = 0;  ///< since the start
  double weight_n = 0;
};

/// Takes the foot loads, so a robot can have only one observer.
Observation observe(TwinRobot& robot);

class WalkMeter {
 public:
  explicit WalkMeter(const model::Entity& entity, bool keep_series = true);

  /// Call once per control tick after the controller's step, with the world it acted on and its new
  /// outputs.
  void tick(const Observation& seen, const Outputs& outputs,
            const std::optional<Vec2>& zmp_planned_world_m = {});

  WalkMetrics result() const;
  const std::vector<SeriesRow>& series() const { return series_; }

 private:
  struct Mark {  ///< start of a cycle
    double t_s;
    double path_m;
    double slip_m;
    int phase;
  };
  struct Pending {  ///< double support: next carrying foot unknown
    int state;
    std::array<double, 2> distance_mm;
  };

  void score_past_tick(const Observation& seen);
  void add_slip(const Truth& truth);
  void add_torque_use(const Truth& truth);
  void score_transport(WalkMetrics& out) const;
  void begin_walk(const Truth& truth);
  void end_walk();
  void follow_path(const Truth& truth, const Outputs& outputs);
  void score_zmp(const Truth& truth, const FootLoads& loads);
  void add_bias(int state, double distance_mm);
  void keep(const Observation& seen, const Outputs& outputs,
            const std::optional<Vec2>& zmp_planned_world_m);
  void score_steady(WalkMetrics& out) const;

  std::vector<model::Joint> joints_;
  std::vector<std::string> link_names_;
  bool keep_series_;
  std::vector<SeriesRow> series_;

  bool started_ = false;
  double first_s_ = 0;
  Observation last_;
  Outputs previous_;  ///< during the past tick
  bool walking_ = false;
  bool ever_walked_ = false;
  double walk_s_ = 0;
  Vec2 line_origin_m_ = Vec2::Zero();
  double line_heading_rad_ = 0;
  double ahead_m_ = 0;
  double lateral_m_ = 0;
  double yaw_turned_rad_ = 0;
  Vec2 last_mark_m_ = Vec2::Zero();
  Vec2 here_m_ = Vec2::Zero();
  double path_m_ = 0, slip_m_ = 0;  ///< up to last_mark_m_
  Vec2 slid_m_ = Vec2::Zero();      ///< slip of the carrying sole
  std::vector<Mark> marks_;
  std::vector<Pending> pending_;
  std::array<double, 16> bias_sum_mm_{};
  std::array<std::uint64_t, 16> bias_count_{};
  std::uint64_t walk_steps_ = 0;  ///< physics steps
  std::vector<std::uint64_t> walk_saturated_;
  std::uint64_t self_contact_ticks_ = 0;
  std::array<int, 2> self_contact_nodes_{};
  std::vector<double> torque_use_sum_, torque_use_peak_;
  std::uint64_t walk_ticks_ = 0;
  double supply_energy_j_ = 0, joint_work_j_ = 0;
};

}  // namespace verp::sim
