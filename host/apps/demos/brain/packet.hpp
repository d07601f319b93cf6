#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "host/apps/demos/brain/pose.hpp"

namespace verp::brain {

/// Encodes numbers as 16-bit steps, little-endian, because radio messages are short.
class Packet {
 public:
  explicit Packet(char kind) : data_(1, kind) {}
  Packet& put(double value, double step) {
    const double steps = within(std::round(value / step), 32'767);
    const auto bits = static_cast<std::uint16_t>(static_cast<std::int16_t>(steps));
    data_ += static_cast<char>(bits & 0xFF);
    data_ += static_cast<char>(bits >> 8);
    return *this;
  }
  Packet& put(const Pose& pose) {
    return put(pose.at_m.x, 1e-3).put(pose.at_m.y, 1e-3).put(pose.yaw_rad, 1e-3);
  }
  const std::string& data() const { return data_; }

 private:
  std::string data_;
};

/// Decodes in the same order. A missing value reads as 0 and clears good().
class Unpacked {
 public:
  explicit Unpacked(std::string_view data) : data_(data) {}
  char kind() const { return data_.empty() ? '\0' : data_[0]; }
  double get(double step) {
    if (at_ + 2 > data_.size()) {
      good_ = false;
      return 0;
    }
    const auto low = static_cast<unsigned char>(data_[at_]);
    const auto high = static_cast<unsigned char>(data_[at_ + 1]);
    at_ += 2;
    return step * static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8));
  }
  Pose pose() {
    Pose pose;
    pose.at_m.x = get(1e-3);
    pose.at_m.y = get(1e-3);
    pose.yaw_rad = get(1e-3);
    return pose;
  }
  /// The data held exactly the values that were read.
  bool good() const { return good_ && at_ == data_.size(); }

 private:
  std::string_view data_;
  std::size_t at_ = 1;
  bool good_ = true;
};

}  // namespace verp::brain
