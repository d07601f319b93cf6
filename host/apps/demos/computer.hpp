#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/record/tick_record.hpp"
#include "firmware/app/contracts.hpp"
#include "host/apps/demos/brain/brain.hpp"
#include "host/apps/demos/brain/odometry.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::demos {

/// The computer on a robot's back: it connects the brain with the operator link, laser, camera and
/// radio, never with the twin's ground truth.
class Computer {
 public:
  /// The caller keeps `entity` and `params` alive. A laser must be on the trunk.
  Computer(const model::Entity& entity, const Params& params, brain::About about,
           std::unique_ptr<brain::Brain> (*make)(const brain::About&));

  /// A controller tick, from its registers and its State image.
  void ticked(const TickRecord& tick, const State& state, const Outputs& outputs);
  /// Laser ranges from the first angle on.
  void scanned(std::vector<float> range_m, std::uint64_t stamp_ns);
  /// A camera picture: rgb, rows from the top.
  void pictured(int width_px, int height_px, std::string rgb, std::uint64_t stamp_ns);
  void heard(int from, std::string data) { senses_.heard.push_back({from, std::move(data)}); }

  /// The brain's period.
  static constexpr double kThink_s = 0.05;
  bool due() const { return senses_.now_s >= next_s_; }
  /// Runs the brain; `spy` sees its inputs first. The new orders stand until the next call.
  const brain::Orders& think(const std::function<void(const brain::Senses&)>& spy = {});
  const brain::Orders& orders() const { return orders_; }
  app::OperatorOrder order(std::uint32_t tick);

  /// As the robot estimates it.
  const brain::Pose& odometry() const { return odometry_.pose(); }
  const brain::Brain& brain() const { return *brain_; }

 private:
  struct Past {
    double time_s = 0;
    brain::Pose odometry;
    double roll_rad = 0, pitch_rad = 0;
    math::Pose laser, camera;  ///< above the floor
  };
  const Past& at(double time_s) const;
  void place_scan(brain::Scan& scan) const;
  void place_picture(brain::Picture& picture) const;

  const model::Entity& entity_;
  const Params& params_;
  brain::About about_;
  std::unique_ptr<brain::Brain> brain_;
  brain::Odometry odometry_;
  std::deque<Past> past_;
  brain::Senses senses_;
  brain::Orders orders_;
  Command command_;
  double next_s_ = 0;
};

}  // namespace verp::demos
