#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/crc32.hpp"
#include "common/math/convert.hpp"
#include "common/math/linear.hpp"
#include "common/math/scalar.hpp"
#include "common/model/params.hpp"
#include "common/protocol/controller_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "hal/contract/imu.hpp"

/// Errors of one IMU on one board: gyroscope bias and mounting, measured at rest and removed from
/// the counts before they become Inputs. So a trace holds what the controller saw, and one robot's
/// Params fit every board.
namespace verp::app {

struct ImuCalibration {
  static constexpr std::int32_t kOne = 1 << 14;

  std::int16_t gyro_bias_count[3] = {};
  /// Rotates the chip's vectors to the mounting in Params; row-major, in 1/kOne.
  std::int16_t turn[9] = {kOne, 0, 0, 0, kOne, 0, 0, 0, kOne};

  hal::ImuSample corrected(const hal::ImuSample& raw) const {
    std::int32_t gyro[3], accel[3];
    for (int axis = 0; axis < 3; ++axis) {
      gyro[axis] = raw.gyro_count[axis] - gyro_bias_count[axis];
      accel[axis] = raw.accel_count[axis];
    }
    hal::ImuSample sample = raw;
    for (int row = 0; row < 3; ++row) {
      sample.gyro_count[row] = turned(row, gyro);
      sample.accel_count[row] = turned(row, accel);
    }
    return sample;
  }

  static constexpr std::size_t kBytes = 1 + 2 * (3 + 9) + 4;
  static constexpr std::uint8_t kVersion = 2;  ///< 1 stored no basis
  void encode(std::uint8_t (&to)[kBytes], std::uint32_t basis) const {
    to[0] = kVersion;
    dxl::put_u32(to + kBytes - 4, basis);
    for (std::size_t i = 0; i < 12; ++i) {
      const std::int16_t value = i < 3 ? gyro_bias_count[i] : turn[i - 3];
      dxl::put_u16(to + 1 + 2 * i, static_cast<std::uint16_t>(value));
    }
  }
  /// False, with nothing changed: another version or basis wrote it.
  bool decode(const std::uint8_t (&from)[kBytes], std::uint32_t basis) {
    if (from[0] != kVersion || dxl::get_u32(from + kBytes - 4) != basis) return false;
    for (std::size_t i = 0; i < 12; ++i) {
      const auto value = static_cast<std::int16_t>(dxl::get_u16(from + 1 + 2 * i));
      (i < 3 ? gyro_bias_count[i] : turn[i - 3]) = value;
    }
    return true;
  }

 private:
  // Sums of three products of up to 2^16 * 2^14 exceed 32 bits.
  std::int16_t turned(int row, const std::int32_t (&vector)[3]) const {
    std::int64_t sum = kOne / 2;
    for (int i = 0; i < 3; ++i) sum += std::int64_t{turn[3 * row + i]} * vector[i];
    const std::int64_t count = sum >> 14;
    return static_cast<std::int16_t>(count < -32768 ? -32768 : count > 32767 ? 32767 : count);
  }
};

/// A calibration's basis, CRC-32 of scale and mounting: its bias is in counts of that scale, its
/// rotation refers to that mounting.
inline std::uint32_t basis_of(const ImuParams& imu) {
  const float scales[2] = {imu.gyro_rad_s_per_count, imu.accel_m_s2_per_count};
  return crc32(imu.body_imu, sizeof imu.body_imu, crc32(scales, sizeof scales));
}

/// Measures while the robot stands upright and still for kSamples samples.
class ImuCalibrator {
 public:
  using State = dxl::controller::ImuCalibrationState;
  static constexpr int kSamples = 512;

  explicit ImuCalibrator(const ImuParams& imu) : imu_(&imu) {}

  void begin() {
    *this = ImuCalibrator(*imu_);
    state_ = State::kMeasuring;
  }
  void stop() { state_ = State::kNone; }
  /// Takes a raw sample. True: it was the last one; see state() and result().
  bool take(const hal::ImuSample& raw) {
    if (state_ != State::kMeasuring) return false;
    for (int axis = 0; axis < 3; ++axis) {
      note(gyro_[axis], raw.gyro_count[axis]);
      note(accel_[axis], raw.accel_count[axis]);
    }
    if (++count_ < kSamples) return false;
    state_ = judge();
    return true;
  }
  State state() const { return state_; }
  const ImuCalibration& result() const { return result_; }

 private:
  struct Channel {
    std::int32_t sum = 0;
    std::int32_t least = 32767, most = -32768;
  };
  /// At rest a chip's noise is under 0.01 rad/s and 0.1 m/s^2. A hand on the robot moves it by more
  /// than these limits.
  static constexpr float kGyroSpread_rad_s = 0.05F, kAccelSpread_m_s2 = 0.8F;
  /// MPU-9250, ICM-20648 data sheets: bias of 5 deg/s at 25 C; twice that is a rotation.
  static constexpr float kMostBias_rad_s = 0.17F;
  static constexpr float kGravity_m_s2 = 9.80665F, kMostOff_m_s2 = 1.0F;
  /// More than 20 degrees: another mounting or a leaning robot.
  static constexpr float kLeastUpright = 0.93969262F;

  static void note(Channel& channel, std::int16_t count) {
    channel.sum += count;
    if (count < channel.least) channel.least = count;
    if (count > channel.most) channel.most = count;
  }
  static float mean(const Channel& channel) {
    return math::to_float(channel.sum) / static_cast<float>(kSamples);
  }
  static bool is_still(const Channel& channel, float per_count, float most) {
    return math::to_float(channel.most - channel.least) * per_count <= most;
  }

  State judge() {
    for (int axis = 0; axis < 3; ++axis) {
      const float bias = mean(gyro_[axis]) * imu_->gyro_rad_s_per_count;
      if (!is_still(gyro_[axis], imu_->gyro_rad_s_per_count, kGyroSpread_rad_s) ||
          !is_still(accel_[axis], imu_->accel_m_s2_per_count, kAccelSpread_m_s2) ||
          !(bias <= kMostBias_rad_s && bias >= -kMostBias_rad_s)) {
        return State::kMoved;
      }
      result_.gyro_bias_count[axis] = math::to_int16(mean(gyro_[axis]));
    }
    const Vec3 force_m_s2 =
        imu_->accel_m_s2_per_count * Vec3{mean(accel_[0]), mean(accel_[1]), mean(accel_[2])};
    return find_turn(force_m_s2) ? State::kDone : State::kNotUpright;
  }

  // The smallest rotation from the measured upward axis to that of Params, row 2 of body_imu
  // (Rodrigues). Gravity shows no rotation about that axis.
  bool find_turn(const Vec3& force_m_s2) {
    const float length = math::norm(force_m_s2);
    const float off_m_s2 = length - kGravity_m_s2;
    if (!(off_m_s2 < kMostOff_m_s2 && off_m_s2 > -kMostOff_m_s2)) return false;
    const Vec3 up = (1.0F / length) * force_m_s2;
    const Vec3 wanted{imu_->body_imu[6], imu_->body_imu[7], imu_->body_imu[8]};
    const float cosine = up.dot(wanted);
    if (!(cosine >= kLeastUpright)) return false;
    const Mat3 skew = math::skew(math::cross(up, wanted));
    const Mat3 turn = Mat3::Identity() + skew + (1.0F / (1.0F + cosine)) * (skew * skew);
    for (int i = 0; i < 9; ++i) {
      result_.turn[i] =
          math::to_int16(turn(i / 3, i % 3) * static_cast<float>(ImuCalibration::kOne));
    }
    return true;
  }

  const ImuParams* imu_;
  Channel gyro_[3], accel_[3];
  int count_ = 0;
  State state_ = State::kNone;
  ImuCalibration result_;
};

}  // namespace verp::app
