#include "host/author/mjcf/transmission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace verp::mjcf {
namespace {

class Mover {
 public:
  explicit Mover(Robot& robot) : robot_(robot) {}

  std::vector<std::string> move(const std::vector<Closure>& closures) {
    std::erase_if(robot_.followers, [&](const Follower& each) { return take_gear(each); });
    for (const Closure& each : closures) take_rods(each);
    return std::move(said_);
  }

 private:
  struct Place {
    int body = -1;
    Joint* joint = nullptr;
    bool has_motor() const { return joint->motor.has_actuator; }
  };

  Place place(const std::string& name) {
    for (std::size_t i = 0; i < robot_.bodies.size(); ++i) {
      for (Joint& joint : robot_.bodies[i].joints) {
        if (joint.name == name && !joint.slides) return {static_cast<int>(i), &joint};
      }
    }
    return {};
  }

  int parent_of(int body) const { return robot_.bodies[static_cast<std::size_t>(body)].parent; }

  /// Bodies that hang on this one, itself included.
  std::ptrdiff_t size_of(int body) const {
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < robot_.bodies.size(); ++i) {
      int at = static_cast<int>(i);
      while (at >= 0 && at != body) at = parent_of(at);
      count += at == body ? 1 : 0;
    }
    return count;
  }

  void take(const Place& moved, const Place& motor, double ratio, const char* how) {
    Motor& to = moved.joint->motor;
    Motor& from = motor.joint->motor;
    to.has_actuator = true;
    to.torque_n_m = from.torque_n_m / ratio;
    to.kp_n_m_rad = from.kp_n_m_rad / (ratio * ratio);
    to.no_load_rad_s = from.no_load_rad_s * ratio;
    to.armature_kg_m2 += from.armature_kg_m2 / (ratio * ratio);
    to.damping_n_m_s += from.damping_n_m_s / (ratio * ratio);
    to.friction_n_m += from.friction_n_m / ratio;
    from = {};
    said_.push_back(fmt::format("the motor of joint {} turns joint {} {}", motor.joint->name,
                                moved.joint->name, how));
  }

  /// first = offset + factor * second.
  bool take_gear(const Follower& each) {
    const Place first = place(each.first), second = place(each.second);
    if (first.joint == nullptr || second.joint == nullptr || each.factor == 0) return false;
    if (first.has_motor() == second.has_motor()) return false;
    const double ratio = std::abs(each.factor);
    const Place& motor = first.has_motor() ? first : second;
    const Place& moved = first.has_motor() ? second : first;
    if (size_of(motor.body) > 1 || size_of(moved.body) == 1) return false;
    const double own = first.has_motor() ? 1 / ratio : ratio;
    take(moved, motor, own, fmt::format("by a gear of {:.4g}", own).c_str());
    return true;
  }

  std::vector<int> way_to(int body) const {
    std::vector<int> way;
    for (; body >= 0; body = parent_of(body)) way.insert(way.begin(), body);
    return way;
  }

  std::vector<Place> loop_of(const Closure& closure) {
    std::vector<int> first = way_to(closure.first);
    std::vector<int> second = way_to(closure.second);
    while (!first.empty() && !second.empty() && first.front() == second.front()) {
      first.erase(first.begin());
      second.erase(second.begin());
    }
    std::vector<Place> loop;
    for (const auto* way : {&first, &second}) {
      for (const int body : *way) {
        for (Joint& joint : robot_.bodies[static_cast<std::size_t>(body)].joints) {
          if (joint.slides) return {};  // its motor has a force, no torque
          loop.push_back({body, &joint});
        }
      }
    }
    return loop;
  }

  /// One motor, and the joint without one that carries most.
  void take_rods(const Closure& closure) {
    if (closure.first < 0 || closure.second < 0) return;
    std::vector<Place> loop = loop_of(closure);
    const auto passive = std::partition(loop.begin(), loop.end(),
                                        [](const Place& each) { return each.has_motor(); });
    if (passive - loop.begin() != 1 || passive == loop.end()) return;
    const auto moved = std::max_element(passive, loop.end(), [&](const Place& a, const Place& b) {
      return size_of(a.body) < size_of(b.body);
    });
    if (size_of(moved->body) > size_of(loop.front().body))
      take(*moved, loop.front(), 1, "through rods: 1 to 1 is a guess");
  }

  Robot& robot_;
  std::vector<std::string> said_;
};

}  // namespace

std::vector<std::string> move_motors(Robot& robot, const std::vector<Closure>& closures) {
  return Mover(robot).move(closures);
}

}  // namespace verp::mjcf
