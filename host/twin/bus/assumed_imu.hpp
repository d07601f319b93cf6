#pragma once
#include <cmath>
#include <cstdint>

#include "common/math/scalar.hpp"
#include "common/model/params.hpp"
#include "hal/contract/imu.hpp"

namespace verp::bus {

/// The Imu of a robot that has none: it says in every read that the body is upright and still. With
/// it a robot walks without balance, and nobody notices that it falls. Its gyro trembles by a count
/// about zero, for the core takes an IMU that repeats itself for a dead one.
class AssumedImu {
 public:
  /// Speaks in the counts and the mounting of `imu`.
  explicit AssumedImu(const ImuParams& imu) {
    if (!(imu.accel_m_s2_per_count > 0)) return;
    for (int axis = 0; axis < 3; ++axis) {  // the body's z axis, seen from the IMU
      const float g = imu.body_imu[6 + axis] * math::kGravityMS2 / imu.accel_m_s2_per_count;
      sample_.accel_count[axis] = static_cast<std::int16_t>(std::lround(g));
    }
  }

  hal::ImuStatus read(hal::ImuSample& sample) {
    ++sample_.time_us;
    sample_.gyro_count[2] = sample_.time_us % 2 == 0 ? 1 : -1;
    sample = sample_;
    return hal::ImuStatus::kFresh;
  }
  std::uint32_t faults() const { return 0; }

 private:
  hal::ImuSample sample_;
};

static_assert(hal::Imu<AssumedImu>);

}  // namespace verp::bus
