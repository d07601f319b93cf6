#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/twin/imu/bno055_model.hpp"

namespace verp::imu {

/// The UART of a BNO055 (BST-BNO055-DS000, section 4.7).
class Bno055Port {
 public:
  explicit Bno055Port(Bno055Model& model) : model_(model) {}

  /// Script: so many requests are refused with BUS_OVER_RUN.
  int overruns = 0;

  /// Takes bytes and appends what the chip answers.
  void take(std::span<const std::uint8_t> bytes, std::uint64_t now_us,
            std::vector<std::uint8_t>& answer);

 private:
  bool serve(std::uint64_t now_us, std::vector<std::uint8_t>& answer);

  Bno055Model& model_;
  std::vector<std::uint8_t> inbox_;
  std::uint64_t heard_us_ = 0;
};

}  // namespace verp::imu
