#include "host/apps/demos/computer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace verp::demos {
namespace {

constexpr double kRemembers_s = 0.6;       // history; measurements are at most this old
constexpr std::uint32_t kOrderTicks = 10;  // as in session::WalkOperator: inside command_hold_s
constexpr double kApart_s = 0.01;          // between power-on of two robots
constexpr double kTenth_mm = 1e4, kMilli = 1e3;

std::int16_t in_steps(double value, double steps) {
  return static_cast<std::int16_t>(std::lround(brain::within(value * steps, 32'767)));
}

brain::About with_sensors(const model::Entity& entity, brain::About about) {
  if (!entity.lasers.empty()) {
    const model::LaserSensor& laser = entity.lasers.front();
    about.laser_first_rad = laser.first_rad;
    about.laser_step_rad = laser.step_rad();
    about.laser_max_m = laser.max_m;
    about.laser_m = {laser.pose.translation().x(), laser.pose.translation().y()};
  }
  if (!entity.cameras.empty()) {
    const model::CameraSensor& camera = entity.cameras.front();
    about.fx_px = camera.fx_px;
    about.fy_px = camera.fy_px;
    about.cx_px = camera.cx_px;
    about.cy_px = camera.cy_px;
  }
  return about;
}

math::Pose single(const model::Transform& pose) {
  return {pose.linear().cast<float>(), pose.translation().cast<float>()};
}

}  // namespace

Computer::Computer(const model::Entity& entity, const Params& params, brain::About about,
                   std::unique_ptr<brain::Brain> (*make)(const brain::About&))
    : entity_(entity),
      params_(params),
      about_(with_sensors(entity, about)),
      brain_(make(about_)),
      odometry_(params),
      next_s_(kApart_s * about.number) {}

void Computer::ticked(const TickRecord& tick, const State& state, const Outputs& outputs) {
  using safety::Mode;
  const auto mode = static_cast<Mode>(outputs.mode);
  const bool calibrated = state.attitude.still_s >= balance::kCalibrated_s;
  senses_.now_s = 1e-6 * params_.period_us * tick.inputs.tick;
  senses_.walking = mode == Mode::kWalking;
  senses_.ready = senses_.walking || (mode == Mode::kStanding && calibrated);
  senses_.down = mode == Mode::kFallen || mode == Mode::kFalling || mode == Mode::kGettingUp;
  odometry_.update(tick.inputs, state);
  senses_.odometry = odometry_.pose();
  Past past{.time_s = senses_.now_s,
            .odometry = odometry_.pose(),
            .roll_rad = odometry_.roll_rad(),
            .pitch_rad = odometry_.pitch_rad(),
            .laser = {},
            .camera = {}};
  if (!entity_.lasers.empty())
    past.laser = odometry_.above_floor(0) * single(entity_.lasers.front().pose);
  if (!entity_.cameras.empty()) {
    const model::CameraSensor& camera = entity_.cameras.front();
    past.camera = odometry_.above_floor(camera.node) * single(camera.pose);
  }
  past_.push_back(past);
  while (past_.front().time_s < senses_.now_s - kRemembers_s) past_.pop_front();
}

void Computer::scanned(std::vector<float> range_m, std::uint64_t stamp_ns) {
  senses_.scan.emplace();
  senses_.scan->time_s = 1e-9 * static_cast<double>(stamp_ns);
  senses_.scan->range_m = std::move(range_m);
}

void Computer::pictured(int width_px, int height_px, std::string rgb, std::uint64_t stamp_ns) {
  senses_.picture.emplace();
  senses_.picture->time_s = 1e-9 * static_cast<double>(stamp_ns);
  senses_.picture->width_px = width_px;
  senses_.picture->height_px = height_px;
  senses_.picture->rgb = std::move(rgb);
}

/// The last tick at or before that time, or the oldest one kept.
const Computer::Past& Computer::at(double time_s) const {
  constexpr double kRounding_s = 1e-9;
  const auto later = std::find_if(past_.begin(), past_.end(), [&](const Past& each) {
    return each.time_s > time_s + kRounding_s;
  });
  return later == past_.begin() ? past_.front() : *(later - 1);
}

void Computer::place_scan(brain::Scan& scan) const {
  const Past& then = at(scan.time_s);
  scan.odometry = then.odometry;
  scan.roll_rad = then.roll_rad;
  scan.pitch_rad = then.pitch_rad;
  scan.high_m = then.laser.position_m.z();
}

void Computer::place_picture(brain::Picture& picture) const {
  const Past& then = at(picture.time_s);
  picture.odometry = then.odometry;
  for (int row = 0; row < 3; ++row) {
    picture.camera_m[row] = then.camera.position_m[row];
    for (int column = 0; column < 3; ++column)
      picture.camera_axes[3 * row + column] = then.camera.rotation(row, column);
  }
}

const brain::Orders& Computer::think(const std::function<void(const brain::Senses&)>& spy) {
  next_s_ = senses_.now_s + kThink_s;
  if (senses_.scan) place_scan(*senses_.scan);
  if (senses_.picture) place_picture(*senses_.picture);
  if (spy) spy(senses_);
  orders_ = brain_->think(senses_);
  senses_.scan.reset();
  senses_.picture.reset();
  senses_.heard.clear();
  return orders_;
}

app::OperatorOrder Computer::order(std::uint32_t tick) {
  Command wanted;
  wanted.request = orders_.walk ? Request::kWalk : Request::kStand;
  if (orders_.walk) {
    wanted.vx_tenth_mm_s = in_steps(orders_.vx_m_s, kTenth_mm);
    wanted.vy_tenth_mm_s = in_steps(orders_.vy_m_s, kTenth_mm);
    wanted.wz_mrad_s = in_steps(orders_.wz_rad_s, kMilli);
  }
  wanted.head_pan_mrad = in_steps(orders_.head_pan_rad, kMilli);
  wanted.head_tilt_mrad = in_steps(orders_.head_tilt_rad, kMilli);
  wanted.sequence = command_.sequence;
  const bool changed = std::memcmp(&wanted, &command_, sizeof wanted) != 0;  // it has no padding
  const bool fresh = changed || tick % kOrderTicks == 0;
  if (fresh) ++wanted.sequence;
  command_ = wanted;
  return {.command = command_, .flags = static_cast<std::uint16_t>(fresh ? kCommandFresh : 0)};
}

}  // namespace verp::demos
