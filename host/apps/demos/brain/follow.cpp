#include "host/apps/demos/brain/follow.hpp"

#include <utility>

#include "host/apps/demos/brain/packet.hpp"
#include "host/apps/demos/brain/scan.hpp"

namespace verp::brain {
namespace {

constexpr char kPace = 'F';
constexpr double kSay_s = 0.25;     // interval between reports
constexpr double kPatience_s = 12;  // wait for the others to get ready
constexpr double kSpeedStep_m_s = 1e-3;

struct Pace {
  double speed_m_s = 0;
  bool ready = false, over = false;
};

std::string said(const Pace& pace) {
  return Packet(kPace)
      .put(pace.speed_m_s, kSpeedStep_m_s)
      .put(pace.ready ? 1 : 0, 1)
      .put(pace.over ? 1 : 0, 1)
      .data();
}

std::optional<Pace> heard(const Message& message) {
  Unpacked data(message.data);
  const double speed_m_s = data.get(kSpeedStep_m_s);
  const Pace pace{speed_m_s, data.get(1) != 0, data.get(1) != 0};
  if (data.kind() != kPace || !data.good()) return std::nullopt;
  return pace;
}

class Talker {
 public:
  void talk(double now_s, const Pace& pace, Orders& orders) {
    if (now_s < next_s_) return;
    next_s_ = now_s + kSay_s;
    orders.say.push_back({said(pace)});
  }

 private:
  double next_s_ = 0;
};

class Leader final : public Brain {
 public:
  Leader(const About& about, double speed_m_s)
      : about_(about), speed_m_s_(speed_m_s), ready_(static_cast<std::size_t>(about.robots)) {}

  Orders think(const Senses& senses) override {
    Orders orders;
    for (const Message& message : senses.heard) {
      const auto pace = heard(message);
      if (pace && pace->ready) ready_.at(static_cast<std::size_t>(message.from)) = true;
    }
    if (senses.ready && !ready_s_) ready_s_ = senses.now_s;
    if (!walker_ && ready_s_ && (all_ready() || senses.now_s > *ready_s_ + kPatience_s)) {
      const Route way = leaders_way();
      walker_.emplace(way.from(senses.odometry), speed_m_s_);
    }
    if (walker_) walker_->walk(senses.odometry, orders);
    orders.done = walker_ && walker_->over();
    talker_.talk(senses.now_s, {walker_ ? walker_->speed_m_s() : 0, senses.ready, orders.done},
                 orders);
    return orders;
  }

 private:
  bool all_ready() const {
    for (std::size_t i = 0; i < ready_.size(); ++i) {
      if (static_cast<int>(i) != about_.number && !ready_[i]) return false;
    }
    return true;
  }

  const About about_;
  const double speed_m_s_;
  std::vector<bool> ready_;
  std::optional<double> ready_s_;
  std::optional<Walker> walker_;
  Talker talker_;
};

/// Successive sightings of the robot ahead, in this robot's odometry frame.
class Trail {
 public:
  bool begun() const { return !crumbs_.empty(); }
  /// Starts with points from this robot to the robot ahead.
  void begin(Point here, Point there) {
    const int count = static_cast<int>(distance(here, there) / kCrumb_m);
    for (int i = 0; i <= count; ++i)
      crumbs_.push_back(here + static_cast<double>(i) / (count + 1) * (there - here));
    crumbs_.push_back(there);
    seen_ = there;
  }
  /// Uses a moving average, because a walker's sway between two scans is as large as its progress.
  void add(Point there) {
    constexpr double kShare = 0.25;
    seen_ = seen_ + kShare * (there - seen_);
    if (distance(crumbs_.back(), seen_) > kCrumb_m) crumbs_.push_back(seen_);
  }
  /// Drops points behind the robot.
  void pass(Point here) {
    while (crumbs_.size() > 2 && distance(crumbs_[1], here) <= distance(crumbs_[0], here))
      crumbs_.pop_front();
  }
  double long_m(Point here) const {
    double sum_m = distance(here, crumbs_.front());
    for (std::size_t i = 1; i < crumbs_.size(); ++i) sum_m += distance(crumbs_[i - 1], crumbs_[i]);
    return sum_m + distance(crumbs_.back(), seen_);
  }
  Point ahead(Point here, double by_m) const {
    Point at = here;
    for (const Point& crumb : crumbs_) {
      const double step_m = distance(at, crumb);
      if (step_m >= by_m) return at + by_m / step_m * (crumb - at);
      by_m -= step_m;
      at = crumb;
    }
    return crumbs_.back();
  }
  Point seen() const { return seen_; }

 private:
  static constexpr double kCrumb_m = 0.1;
  std::deque<Point> crumbs_;
  Point seen_;
};

class Follower final : public Brain {
 public:
  explicit Follower(const About& about) : about_(about) {}

  Orders think(const Senses& senses) override {
    Orders orders;
    for (const Message& message : senses.heard) {
      if (message.from != about_.number - 1) continue;
      if (const auto pace = heard(message)) {
        ahead_ = *pace;
        heard_s_ = senses.now_s;
      }
    }
    if (senses.scan && senses.ready) look(*senses.scan);
    if (senses.ready && trail_.begun() && ahead_.ready) follow(senses, orders);
    orders.done = over_;
    talker_.talk(senses.now_s,
                 {orders.walk ? orders.vx_m_s : 0, senses.ready && trail_.begun(), over_}, orders);
    return orders;
  }

 private:
  /// Finds the robot ahead where it is expected: at first straight ahead, then near its last place.
  void look(const Scan& scan) {
    constexpr double kNear_m = 0.3;
    const Point expected = trail_.begun() ? trail_.seen() : out_of(scan.odometry, Point{kGap_m, 0});
    std::optional<Point> nearest;
    for (const Thing& thing : things(about_, scan)) {
      const Point at = out_of(scan.odometry, middle_of(about_, thing));
      if (distance(at, expected) > kNear_m) continue;
      if (!nearest || distance(at, expected) < distance(*nearest, expected)) nearest = at;
    }
    if (!nearest) return;
    if (!trail_.begun()) trail_.begin(scan.odometry.at_m, *nearest);
    trail_.add(*nearest);
    seen_s_ = scan.time_s;
  }

  void follow(const Senses& senses, Orders& orders) {
    constexpr double kLost_s = 2;  // older sightings and reports do not count
    constexpr double kLook_m = 0.4, kNear_m = 0.45, kAlong_1_s = 0.5, kLeast_m_s = 0.06;
    constexpr double kMost_m_s = 0.24, kMostTurn_rad_s = 0.5, kThere_m = 0.04;
    const Point here = senses.odometry.at_m;
    trail_.pass(here);
    const double gap_m = trail_.long_m(here);
    const bool told = senses.now_s - heard_s_ < kLost_s;
    const double pace_m_s = told ? ahead_.speed_m_s : 0;
    double v_m_s = pace_m_s + kAlong_1_s * (gap_m - kGap_m);
    if (senses.now_s - seen_s_ > kLost_s || gap_m < kNear_m) v_m_s = 0;
    if (told && ahead_.over && gap_m < kGap_m + kThere_m) over_ = true;
    if (over_) return;
    // The gait starts when there is a way to go, and then continues on the spot.
    started_ = started_ || gap_m > kGap_m + kThere_m || pace_m_s > 0;
    if (!started_) return;
    orders.walk = true;
    orders.vx_m_s = std::fmax(0, std::fmin(kMost_m_s, v_m_s));
    const Point ahead = into(senses.odometry, trail_.ahead(here, kLook_m));
    // Pure pursuit: the circle through the robot, along its heading, and the point ahead.
    const double turn_1_s = 2 * std::fmax(orders.vx_m_s, kLeast_m_s) / kLook_m;
    if (orders.vx_m_s > 0)
      orders.wz_rad_s = within(turn_1_s * std::sin(direction_rad(ahead)), kMostTurn_rad_s);
  }

  const About about_;
  Trail trail_;
  Pace ahead_;
  double heard_s_ = -1e9, seen_s_ = -1e9;
  bool over_ = false, started_ = false;
  Talker talker_;
};

}  // namespace

std::unique_ptr<Brain> make_leader(const About& about, double speed_m_s) {
  return std::make_unique<Leader>(about, speed_m_s);
}

std::unique_ptr<Brain> make_follower(const About& about) {
  return std::make_unique<Follower>(about);
}

Route leaders_way() {
  return {{}, {{0.5, 0}, {1.2, 0.9}, {0.3, 0}, {1.4, -0.9}, {0.4, 0}}};
}

}  // namespace verp::brain
