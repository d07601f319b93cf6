#pragma once
#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/imu_rig.hpp"
#include "tests/support/stm32/spi_model.hpp"

namespace verp::hal::stm32::test {

using model::ImuKind;

struct Which {
  Family family;
  ImuKind kind;
};

class MotionSensorDriver : public ::testing::TestWithParam<Which> {
 protected:
  MotionSensorDriver() { board.device.motion({1, -2, 32767}, {-32768, 5, 6}); }
  /// Each sample is twice its number, so a mean is the sum of the first and last numbers.
  void number_samples() {
    board.device.before_sample = [this] {
      const auto number = static_cast<std::int16_t>(2 * ++newest);
      board.device.motion({number, 0, 0}, {0, 0, number});
    };
  }
  ImuStatus read_alone() {
    board.device.frozen = true;
    const ImuStatus status = board.read();
    board.device.frozen = false;
    return status;
  }
  void pause(std::uint64_t time_us) {
    board.rig.machine.advance(us(time_us));
    board.device.update(board.rig.machine.now());
  }
  /// The numbers after the last reported one, up to `last`.
  void expect_up_to(int last, const ImuSample& sample) {
    EXPECT_EQ(sample.gyro_count[0], told + 1 + last);
    EXPECT_EQ(sample.accel_count[2], told + 1 + last);
    told = last;
  }
  int newest = 0, told = 0;  ///< sample numbers
  ImuRig board{GetParam().family, GetParam().kind};
};

}  // namespace verp::hal::stm32::test
