#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/protocol/canopen/frame.hpp"
#include "firmware/app/answer_watch.hpp"

namespace verp::app {

/// Counts of IMU and feet in a tick, until put into its Inputs.
class SensedCounts {
 public:
  void begin() { sensed_ = 0; }

  /// Takes an answer of the IMU (either source) or of a foot. False: the answer differs from this
  /// tick's earlier one, and neither counts.
  bool take(const CanFrame& frame, int source, Answer worth) {
    if (worth == Answer::kOld) return true;
    const bool imu = source == kImuNode || source == AnswerWatch::kImuSecond;
    std::uint16_t* kept = source == kImuNode ? gyro_ : imu ? accel_ : feet_[source - kFootNode];
    bool same = true;
    for (int i = 0; i < (imu ? kAxes : kFootSensors); ++i) {
      const auto now = static_cast<std::uint16_t>(canopen::get_le(frame.data + 2 * i, 2));
      same = same && kept[i] == now;
      if (worth == Answer::kFresh) kept[i] = now;
    }
    if (worth == Answer::kFresh) sensed_ |= node_bit(source);
    if (worth == Answer::kFresh || same) return true;
    sensed_ &= ~node_bit(source);
    return false;
  }

  /// `imu`: IMU counts are wanted. `present`: the robot's nodes.
  void put(Inputs& inputs, bool imu, NodeMask present) const {
    constexpr NodeMask kImu = node_bit(kImuNode) | node_bit(AnswerWatch::kImuSecond);
    if (imu && (sensed_ & kImu) == kImu) {
      for (int axis = 0; axis < kAxes; ++axis) {
        inputs.gyro_count[axis] = static_cast<std::int16_t>(gyro_[axis]);
        inputs.accel_count[axis] = static_cast<std::int16_t>(accel_[axis]);
      }
      inputs.flags |= kImuFresh;
    }
    bool all = (present >> kFootNode) != 0;
    for (int foot = 0; foot < kFeet; ++foot) {
      const NodeMask bit = node_bit(kFootNode + foot);
      if ((present & bit) == 0) continue;
      if ((sensed_ & bit) == 0) all = false;
      if ((sensed_ & bit) == 0) continue;
      for (int i = 0; i < kFootSensors; ++i) inputs.foot_count[foot][i] = feet_[foot][i];
    }
    if (all) inputs.flags |= kFeetFresh;
  }

 private:
  static constexpr int kAxes = 3;
  NodeMask sensed_ = 0;
  std::uint16_t gyro_[kAxes] = {};  ///< as received
  std::uint16_t accel_[kAxes] = {};
  std::uint16_t feet_[kFeet][kFootSensors] = {};
};

}  // namespace verp::app
