#pragma once
#include <cmath>
#include <cstdint>

#include "common/math/scalar.hpp"
#include "common/model/params.hpp"
#include "hal/contract/imu.hpp"

namespace verp::bus {

/// Imu of an upright, still body, for a robot without one: it then walks without balance and
/// detects no fall.
class AssumedImu {
 public:
  explicit AssumedImu(const ImuParams& imu) {
    if (!(imu.accel_m_s2_per_count > 0)) return;
    for (int axis = 0; axis < 3; ++axis) {  // body z axis in the IMU frame
      const float g = imu.body_imu[6 + axis] * math::kGravityMS2 / imu.accel_m_s2_per_count;
      sample_.accel_count[axis] = static_cast<std::int16_t>(std::lround(g));
    }
  }

  hal::ImuStatus read(hal::ImuSample& sample) {
    ++sample_.time_us;
    sample = sample_;
    return hal::ImuStatus::kAssumed;
  }
  std::uint32_t faults() const { return 0; }

 private:
  hal::ImuSample sample_;
};

static_assert(hal::Imu<AssumedImu>);

}  // namespace verp::bus
