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

/// The computer on a robot's back, at which its brain runs: between the controller's operator link,
/// the laser, the camera and the radio on one side, and the brain on the other. It is handed what
/// those measured and told, never the twin or its truth.
class Computer {
 public:
  /// Entity and parameters must outlive it. The laser, if there is one, is on the trunk.
  Computer(const model::Entity& entity, const Params& params, brain::About about,
           std::unique_ptr<brain::Brain> (*make)(const brain::About&));

  /// The controller's tick, as its registers and its image of State have it.
  void ticked(const TickRecord& tick, const State& state, const Outputs& outputs);
  /// What the laser measured, from its first angle on.
  void scanned(std::vector<float> range_m, std::uint64_t stamp_ns);
  /// Likewise a picture of the camera: rgb, rows from the top.
  void pictured(int width_px, int height_px, std::string rgb, std::uint64_t stamp_ns);
  void heard(int from, std::string data) { senses_.heard.push_back({from, std::move(data)}); }

  /// A brain thinks this often.
  static constexpr double kThink_s = 0.05;
  bool due() const { return senses_.now_s >= next_s_; }
  /// Has it think, after `spy` has looked at what it is told; the orders are standing from now on.
  const brain::Orders& think(const std::function<void(const brain::Senses&)>& spy = {});
  const brain::Orders& orders() const { return orders_; }
  /// What the operator link says next.
  app::OperatorOrder order(std::uint32_t tick);

  /// As far as the robot knows.
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
