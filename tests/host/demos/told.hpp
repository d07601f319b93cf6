#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "host/apps/demos/run.hpp"

namespace verp::demos::test {

/// One hash per input.
class Told {
 public:
  explicit Told(Options& options) {
    options.spy = [this](int robot, const brain::Senses& senses) { add(robot, senses); };
  }
  const std::vector<std::uint64_t>& all() const { return all_; }
  std::size_t scans() const { return scans_; }
  std::size_t messages() const { return messages_; }

 private:
  void add(int robot, const brain::Senses& s) {
    hash_ = 14695981039346656037ULL;
    put(static_cast<std::uint64_t>(robot));
    put(s.now_s);
    put(std::uint64_t{s.ready} | std::uint64_t{s.walking} << 1 | std::uint64_t{s.down} << 2);
    put(s.odometry);
    if (s.scan) {
      ++scans_;
      put(s.scan->time_s);
      put(s.scan->odometry);
      put(s.scan->roll_rad);
      put(s.scan->pitch_rad);
      put(s.scan->high_m);
      for (const float range_m : s.scan->range_m) put(static_cast<double>(range_m));
    }
    if (s.picture) {
      put(s.picture->time_s);
      put(s.picture->odometry);
      for (const double each : s.picture->camera_m) put(each);
      for (const double each : s.picture->camera_axes) put(each);
      put(s.picture->rgb);
    }
    for (const brain::Message& message : s.heard) {
      ++messages_;
      put(static_cast<std::uint64_t>(message.from));
      put(message.data);
    }
    all_.push_back(hash_);
  }
  void put(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) {
      hash_ = (hash_ ^ (bits & 0xFF)) * 1099511628211ULL;
      bits >>= 8;
    }
  }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
  void put(const brain::Pose& pose) {
    put(pose.at_m.x);
    put(pose.at_m.y);
    put(pose.yaw_rad);
  }
  void put(const std::string& text) {
    for (const char c : text) put(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }

  std::vector<std::uint64_t> all_;
  std::size_t scans_ = 0, messages_ = 0;
  std::uint64_t hash_ = 0;
};

}  // namespace verp::demos::test
