#include "host/apps/demos/brain/column.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "host/apps/demos/brain/packet.hpp"
#include "host/apps/demos/brain/place.hpp"
#include "host/apps/demos/brain/scan.hpp"

namespace verp::brain {
namespace {

constexpr char kGuide = 'G', kFile = 'C';
constexpr double kTell_s = 0.25;
constexpr double kOnItsWay_s = 0.01;  // approximate age of a message on arrival
constexpr double kGetReady_s = 12;
constexpr double kUnit = 1e-3;

struct Told {
  double way_m = 0, speed_m_s = 0;
  Pose at;
  bool over = false;
};

/// The guide's route as reported so far, by distance along it.
struct Way {
  std::vector<Told> points;

  void add(const Told& told) {
    if (points.empty() || told.way_m > points.back().way_m + 0.02) points.push_back(told);
  }
  /// Straight before its beginning and beyond its end.
  Pose at(double way_m) const {
    if (points.empty() || way_m <= 0) return {{way_m, 0}, 0};
    Told before;
    for (const Told& each : points) {
      if (each.way_m >= way_m) {
        const double share = (way_m - before.way_m) / std::fmax(each.way_m - before.way_m, 1e-6);
        return {before.at.at_m + share * (each.at.at_m - before.at.at_m),
                wrapped(before.at.yaw_rad + share * wrapped(each.at.yaw_rad - before.at.yaw_rad))};
      }
      before = each;
    }
    return out_of(before.at, Pose{{way_m - before.way_m, 0}, 0});
  }
  double bent(double way_m) const {
    constexpr double kAround_m = 0.15;
    return wrapped(at(way_m + kAround_m).yaw_rad - at(way_m - kAround_m).yaw_rad) / (2 * kAround_m);
  }
};

class Guide final : public Brain {
 public:
  Guide(const About& about, double speed_m_s)
      : speed_m_s_(speed_m_s), ready_(static_cast<std::size_t>(about.robots)) {
    ready_[0] = true;
  }

  Orders think(const Senses& senses) override {
    Orders orders;
    for (const Message& message : senses.heard) {
      if (!message.data.empty() && message.data[0] == kFile)
        ready_.at(static_cast<std::size_t>(message.from)) = true;
    }
    if (senses.ready && !ready_s_) ready_s_ = senses.now_s;
    const bool all = std::all_of(ready_.begin(), ready_.end(), [](bool each) { return each; });
    if (!walker_ && ready_s_ && (all || senses.now_s > *ready_s_ + kGetReady_s)) {
      began_ = senses.odometry;
      walker_.emplace(columns_way(), speed_m_s_);
    }
    if (!walker_) return orders;
    const Pose at = into(began_, senses.odometry);
    walker_->walk(at, orders);
    orders.done = walker_->over();
    if (senses.now_s < next_s_) return orders;
    next_s_ = senses.now_s + kTell_s;
    // Sends the point on the route, because the trunk sways.
    orders.say.push_back({Packet(kGuide)
                              .put(walker_->way_m(), kUnit)
                              .put(walker_->speed_m_s(), kUnit)
                              .put(walker_->route().at(walker_->way_m()))
                              .put(at)
                              .put(walker_->over() ? 1 : 0, 1)
                              .data()});
    return orders;
  }

 private:
  const double speed_m_s_;
  std::vector<bool> ready_;
  std::optional<double> ready_s_;
  std::optional<Walker> walker_;
  Pose began_;  ///< of the frame that all share
  double next_s_ = 0;
};

struct Other {
  Pose at;
  double speed_m_s = 0, within_m = 0, heard_s = -1e9;
};

class File final : public Brain {
 public:
  explicit File(const About& about)
      : about_(about),
        slot_(column_slot(about.number)),
        estimate_({{-slot_.back_m, slot_.left_m}, 0}, 0.05, 0.06),
        others_(static_cast<std::size_t>(about.number)) {}

  Orders think(const Senses& senses) override {
    Orders orders;
    estimate_.move(senses.odometry);
    for (const Message& message : senses.heard) hear(message, senses.now_s);
    if (senses.scan && senses.ready) look(*senses.scan, senses);
    if (senses.ready && told_) walk(senses, orders);
    orders.done = over_;
    if (senses.ready && senses.now_s >= next_s_) {
      next_s_ = senses.now_s + kTell_s;
      orders.say.push_back({Packet(kFile)
                                .put(estimate_.pose())
                                .put(orders.walk ? orders.vx_m_s : 0, kUnit)
                                .put(estimate_.within_m(), kUnit)
                                .data()});
    }
    return orders;
  }

 private:
  void hear(const Message& message, double now_s) {
    Unpacked data(message.data);
    if (data.kind() == kGuide && message.from == 0) {
      Told told;
      told.way_m = data.get(kUnit);
      told.speed_m_s = data.get(kUnit);
      told.at = data.pose();
      const Pose body = data.pose();
      told.over = data.get(1) != 0;
      if (!data.good()) return;
      way_.add(told);
      told_ = told;
      told_s_ = now_s - kOnItsWay_s;
      others_[0] = {body, told.speed_m_s, 0, told_s_};
    }
    if (data.kind() == kFile && message.from > 0 && message.from < about_.number) {
      Other other{data.pose(), 0, 0, now_s - kOnItsWay_s};
      other.speed_m_s = data.get(kUnit);
      other.within_m = data.get(kUnit);
      if (data.good()) others_[static_cast<std::size_t>(message.from)] = other;
    }
  }

  /// Each robot ahead reported its pose: a thing near one of those poses is that robot.
  void look(const Scan& scan, const Senses& senses) {
    constexpr double kFresh_s = 1, kSeen_m = 0.05, kNear_m = 0.3;
    for (const Thing& thing : things(about_, scan)) {
      const Point now = into(senses.odometry, out_of(scan.odometry, middle_of(about_, thing)));
      const Point there = out_of(estimate_.pose(), now);
      const Other* nearest = nullptr;
      double nearest_m = kNear_m;
      for (const Other& each : others_) {
        if (senses.now_s - each.heard_s > kFresh_s) continue;
        const double off_m = distance(where(each, scan.time_s), there);
        if (off_m < nearest_m) {
          nearest_m = off_m;
          nearest = &each;
        }
      }
      if (nearest != nullptr)
        estimate_.see(now, where(*nearest, scan.time_s), std::hypot(kSeen_m, nearest->within_m));
    }
  }
  static Point where(const Other& other, double time_s) {
    return out_of(other.at, Point{other.speed_m_s * (time_s - other.heard_s), 0});
  }

  void walk(const Senses& senses, Orders& orders) {
    constexpr double kLost_s = 2, kThere_m = 0.06;
    const double age_s = senses.now_s - told_s_;
    const bool lost = age_s > kLost_s;
    if (lost && !told_->over) return steer_on_the_spot(orders);
    const double guide_m = told_->way_m + (lost ? 0 : told_->speed_m_s * age_s);
    const double mine_m = guide_m - slot_.back_m;
    const Pose slot = out_of(way_.at(mine_m), Pose{{0, slot_.left_m}, 0});
    const double bent = way_.bent(mine_m);
    const double share = 1 - bent * slot_.left_m;
    if (told_->over && distance(slot.at_m, estimate_.pose().at_m) < kThere_m) over_ = true;
    if (over_) return;
    steer(estimate_.pose(), slot, told_->speed_m_s * share, told_->speed_m_s * bent, orders);
  }
  static void steer_on_the_spot(Orders& orders) { orders.walk = true; }

  const About about_;
  const Slot slot_;
  Estimate estimate_;
  std::vector<Other> others_;  ///< only smaller numbers: no estimate feeds back into itself
  Way way_;
  std::optional<Told> told_;
  double told_s_ = 0, next_s_ = 0;
  bool over_ = false;
};

}  // namespace

Slot column_slot(int number) {
  constexpr double kRank_m = 0.9, kFile_m = 0.8, kStagger_m = 0.3;
  const int rank = number / 2, file = number % 2;
  return {rank * kRank_m + file * kStagger_m, -file * kFile_m};
}

std::unique_ptr<Brain> make_guide(const About& about, double speed_m_s) {
  return std::make_unique<Guide>(about, speed_m_s);
}

std::unique_ptr<Brain> make_file(const About& about) {
  return std::make_unique<File>(about);
}

Route columns_way() {
  constexpr double kBent_1_m = 1 / 1.2;  // of the inner file
  return {{}, {{0.9, 0}, {0.5 * std::numbers::pi / kBent_1_m, kBent_1_m}, {0.9, 0}}};
}

}  // namespace verp::brain
