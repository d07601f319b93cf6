#include "host/apps/demos/brain/ball.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "host/apps/demos/brain/packet.hpp"
#include "host/apps/demos/brain/route.hpp"

namespace verp::brain {
namespace {

/// The largest orange patch in a picture.
struct Blob {
  double u_px = 0, v_px = 0;  ///< centre
  double wide_px = 0;         ///< diameter of a disc of equal area
  int pixels = 0;
};

constexpr int kFewest = 8;  // pixels

/// Orange, bright or in shade, has much more red than green and more green than blue.
bool is_orange(const unsigned char* pixel) {
  const int red = pixel[0], green = pixel[1], blue = pixel[2];
  return red > 70 && 10 * red > 14 * green && 10 * green > 15 * blue;
}

std::optional<Blob> orange_blob(const Picture& picture) {
  const int width = picture.width_px, height = picture.height_px;
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (size == 0 || picture.rgb.size() < 3 * size) return std::nullopt;
  const auto* pixels = reinterpret_cast<const unsigned char*>(picture.rgb.data());
  std::vector<char> left(size);
  for (std::size_t i = 0; i < size; ++i) left[i] = is_orange(pixels + 3 * i);
  Blob best;
  std::vector<int> open;
  for (int first = 0; first < width * height; ++first) {
    if (left[static_cast<std::size_t>(first)] == 0) continue;
    Blob blob;
    left[static_cast<std::size_t>(first)] = 0;
    open.assign(1, first);
    while (!open.empty()) {  // flood fill
      const int at = open.back();
      open.pop_back();
      const int u = at % width, v = at / width;
      blob.u_px += u;
      blob.v_px += v;
      ++blob.pixels;
      const auto take = [&](int next, bool inside) {
        if (!inside || left[static_cast<std::size_t>(next)] == 0) return;
        left[static_cast<std::size_t>(next)] = 0;
        open.push_back(next);
      };
      take(at - 1, u > 0);
      take(at + 1, u + 1 < width);
      take(at - width, v > 0);
      take(at + width, v + 1 < height);
    }
    if (blob.pixels > best.pixels) best = blob;
  }
  if (best.pixels < kFewest) return std::nullopt;
  best.u_px /= best.pixels;
  best.v_px /= best.pixels;
  best.wide_px = 2 * std::sqrt(best.pixels / std::numbers::pi);
  return best;
}

/// Point on the floor, in the robot's odometry frame, below an object whose centre is `high_m`
/// above the floor and at pixel (u, v). Empty at or above the horizon.
std::optional<Point> on_floor(const About& about, const Picture& picture, double u_px, double v_px,
                              double high_m) {
  const double ray[3] = {1, (about.cx_px - u_px) / about.fx_px, (about.cy_px - v_px) / about.fy_px};
  double level[3] = {};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      level[row] += picture.camera_axes[3 * row + column] * ray[column];
  }
  constexpr double kFlattest = 0.02;  // a nearly level ray gives no distance
  if (level[2] > -kFlattest) return std::nullopt;
  const double far = (picture.camera_m[2] - high_m) / -level[2];
  return out_of(picture.odometry,
                Point{picture.camera_m[0] + far * level[0], picture.camera_m[1] + far * level[1]});
}

constexpr char kPlayer = 'B';
constexpr double kPlayerTells_s = 0.2;
constexpr double kOld_s = 1.5;  // older sightings do not count
constexpr double kMilli = 1e-3;

struct Ball {
  Point at_m;
  double seen_s = -1e9;
};

/// The other robot's report.
struct Mate {
  Pose at;
  Ball ball;
  double effort_m = 0, heard_s = -1e9;
  bool attacks = false, over = false;
};

class Player final : public Brain {
 public:
  explicit Player(const About& about) : about_(about) {}

  Orders think(const Senses& senses) override {
    Orders orders;
    me_ = out_of(about_.placed, senses.odometry);
    // Averages, because the trunk sways by the width of a foot.
    constexpr double kShare = 0.2;
    steady_m_ = begun_ ? steady_m_ + kShare * (me_.at_m - steady_m_) : me_.at_m;
    begun_ = true;
    for (const Message& message : senses.heard) hear(message, senses.now_s);
    if (senses.picture) look(*senses.picture);
    const std::optional<Point> ball = known_ball(senses.now_s);
    if (ball) effort_m_ = effort_to(*ball);
    decide(senses.now_s, ball.has_value());
    if (ball && (ball->x > kGoalMiddle.x + kSurely_m || std::abs(ball->y) > kSideLine_m))
      over_ = true;
    if (mate_.over) over_ = true;
    orders.done = over_;
    aim(senses, ball, orders);
    if (senses.ready && !over_) {
      if (ball) {
        attacks_ ? attack(*ball, orders) : support(*ball, orders);
      } else {
        search(senses.now_s, orders);
      }
    }
    talk(senses.now_s, orders);
    return orders;
  }

 private:
  void hear(const Message& message, double now_s) {
    Unpacked data(message.data);
    if (data.kind() != kPlayer) return;
    Mate mate;
    mate.at = data.pose();
    mate.ball.at_m.x = data.get(kMilli);
    mate.ball.at_m.y = data.get(kMilli);
    mate.ball.seen_s = now_s - data.get(kMilli);
    mate.effort_m = data.get(kMilli);
    mate.attacks = data.get(1) != 0;
    mate.over = data.get(1) != 0;
    mate.heard_s = now_s;
    if (data.good()) mate_ = mate;
  }

  void look(const Picture& picture) {
    const auto blob = orange_blob(picture);
    if (!blob) return;
    const auto seen = on_floor(about_, picture, blob->u_px, blob->v_px, kBallRadius_m);
    if (seen) ball_ = {out_of(about_.placed, *seen), picture.time_s};
  }

  std::optional<Point> known_ball(double now_s) const {
    if (now_s - ball_.seen_s < kOld_s) return ball_.at_m;
    if (now_s - mate_.heard_s < kOld_s && now_s - mate_.ball.seen_s < kOld_s)
      return mate_.ball.at_m;
    return std::nullopt;
  }

  static Point to_goal(Point ball) {
    const Point way = kGoalMiddle - ball;
    return 1 / std::fmax(length(way), 0.01) * way;
  }
  static Point behind(Point ball, double by_m) { return ball - by_m * to_goal(ball); }

  double effort_to(Point ball) const {
    constexpr double kOfTurn_m_rad = 0.2;
    const Point spot = behind(ball, kBehind_m);
    return distance(me_.at_m, spot) +
           kOfTurn_m_rad * std::abs(wrapped(direction_rad(to_goal(ball)) - me_.yaw_rad));
  }

  /// The attacker keeps attacking unless it is much worse.
  void decide(double now_s, bool knows) {
    constexpr double kKeep_m = 0.4;
    const bool alone = now_s - mate_.heard_s > 2 * kOld_s;
    if (alone) {
      attacks_ = true;
      return;
    }
    if (!knows) return;
    const double mine_m = effort_m_ - (attacks_ ? kKeep_m : 0);
    const double others_m = mate_.effort_m - (mate_.attacks ? kKeep_m : 0);
    attacks_ = mine_m < others_m || (mine_m == others_m && about_.number == 0);
  }

  /// Turns towards `there` and walks; sidesteps when near.
  void go(Point there, double look_rad, Orders& orders) const {
    constexpr double kNear_m = 0.25, kSpeed_m_s = 0.15, kTurn_1_s = 0.55, kMost_rad_s = 0.4;
    const double far_m = distance(me_.at_m, there);
    if (far_m < kNear_m) return steer({steady_m_, me_.yaw_rad}, {there, look_rad}, 0, 0, orders);
    const double off_rad = direction_rad(into(me_, there));
    const double share = std::fmax(0, std::cos(off_rad));
    orders.walk = true;
    orders.wz_rad_s = within(kTurn_1_s * off_rad, kMost_rad_s);
    orders.vx_m_s = std::abs(off_rad) < 0.8 ? kSpeed_m_s * share * share : 0;
  }

  void attack(Point ball, Orders& orders) {
    constexpr double kBeside_m = 0.4, kLine_m = 0.03, kAligned_rad = 0.12, kPush_m_s = 0.16;
    constexpr double kFoot_m = 0.036;  // a foot's middle is this far beside the trunk's
    const Point u = to_goal(ball);
    const double look_rad = direction_rad(u);
    // x: ahead of the ball; y: offset from the line on which the nearer foot meets the ball. Hit by
    // the inner edges of both feet, the ball may go anywhere.
    Point me = into({ball, look_rad}, steady_m_);
    const double foot_m = me.y < 0 ? -kFoot_m : kFoot_m;
    me.y -= foot_m;
    const double off_rad = wrapped(look_rad - me_.yaw_rad);
    const double line_m = pushes_ ? 2 * kLine_m : kLine_m;
    pushes_ = me.x < -0.05 && me.x > -2 * kBehind_m && std::abs(me.y) < line_m &&
              std::abs(off_rad) < (pushes_ ? 2 : 1) * kAligned_rad;
    const auto on_line = [&](double x_m) {
      return out_of(Pose{ball, look_rad}, Point{x_m, foot_m});
    };
    if (pushes_)
      return steer({steady_m_, me_.yaw_rad}, {on_line(me.x), look_rad}, kPush_m_s, 0, orders);
    // Beside or in front of the ball, the robot first walks round it on its own side.
    if (me.x > -0.6 * kBehind_m && std::abs(me.y) < kBeside_m) {
      const double side = me.y < 0 ? -1 : 1;
      return go(out_of({ball, look_rad}, Point{-kBehind_m, side * kBeside_m}), look_rad, orders);
    }
    go(on_line(-kBehind_m), look_rad, orders);
  }

  void support(Point ball, Orders& orders) const {
    constexpr double kBack_m = 0.9, kAside_m = 0.7, kThere_m = 0.3;
    const double look_rad = direction_rad(to_goal(ball));
    const double side =
        into({ball, look_rad}, mate_.at.at_m).y < into({ball, look_rad}, me_.at_m).y ? 1 : -1;
    const Point spot = out_of({ball, look_rad}, Point{-kBack_m, side * kAside_m});
    if (distance(me_.at_m, spot) > kThere_m) go(spot, look_rad, orders);
  }

  void search(double now_s, Orders& orders) {
    constexpr double kTurn_rad_s = 0.3, kWait_s = 6;
    if (now_s - std::fmax(ball_.seen_s, 0) < kWait_s) return;  // at first only the head searches
    orders.walk = true;
    orders.wz_rad_s = kTurn_rad_s;
  }

  void aim(const Senses& senses, const std::optional<Point>& ball, Orders& orders) const {
    constexpr double kMostPan_rad = 1.1, kMostTilt_rad = 0.75, kEyes_m = 0.42;
    if (!ball) {
      constexpr double kPan_rad = 0.9, kTilt_rad = 0.35, kPeriod_s = 4;
      orders.head_pan_rad = kPan_rad * std::sin(2 * std::numbers::pi * senses.now_s / kPeriod_s);
      orders.head_tilt_rad = kTilt_rad;
      return;
    }
    const Point at = into(me_, *ball);
    orders.head_pan_rad = within(direction_rad(at), kMostPan_rad);
    orders.head_tilt_rad =
        std::clamp(std::atan2(kEyes_m, std::fmax(length(at), 0.05)), 0.0, kMostTilt_rad);
  }

  void talk(double now_s, Orders& orders) {
    if (now_s < next_s_) return;
    next_s_ = now_s + kPlayerTells_s;
    orders.say.push_back({Packet(kPlayer)
                              .put(me_)
                              .put(ball_.at_m.x, kMilli)
                              .put(ball_.at_m.y, kMilli)
                              .put(now_s - ball_.seen_s, kMilli)
                              .put(effort_m_, kMilli)
                              .put(attacks_ ? 1 : 0, 1)
                              .put(over_ ? 1 : 0, 1)
                              .data()});
  }

  static constexpr double kBehind_m = 0.3;
  static constexpr double kSideLine_m = 2;  // beyond it a ball is out
  static constexpr double kSurely_m = 0.4;  // beyond the line: distances of far balls are inexact

  const About about_;
  Pose me_;
  Point steady_m_;
  Ball ball_;
  Mate mate_;
  double effort_m_ = 30, next_s_ = 0;
  bool attacks_ = false, pushes_ = false, over_ = false, begun_ = false;
};

}  // namespace

std::unique_ptr<Brain> make_player(const About& about) {
  return std::make_unique<Player>(about);
}

}  // namespace verp::brain
