#pragma once
#include <cstdint>

#include "tests/support/stm32/spi_model.hpp"

/// A 6-axis motion sensor behind SPI: an MPU-9250 (registers: RM-MPU-9250A-00) or an
/// ICM-20648 (DS-000179). It samples at the rate its registers ask for; all counts of a sample are
/// of one instant. Registers that the models don't know are remembered as written.
namespace verp::hal::stm32::model {

enum class ImuKind : std::uint8_t { kMpu9250, kIcm20648 };

class ImuDevice : public SpiDevice {
 public:
  explicit ImuDevice(ImuKind kind);

  // Script.
  bool silent = false;        ///< answers nothing: all ones
  bool frozen = false;        ///< takes no further samples
  int who_am_i = -1;          ///< another identity than the kind's
  Time reset_time = ms(100);  ///< after DEVICE_RESET
  /// What the next samples show, in the sensor's axes.
  void motion(const std::int16_t (&gyro)[3], const std::int16_t (&accel)[3]);
  /// It loses its settings, as by a dip of its supply.
  void forget() { power_on(); }

  std::uint8_t reg(unsigned bank, std::uint8_t address) const { return registers_[bank][address]; }
  std::uint32_t samples_taken() const { return samples_; }
  std::uint32_t violations() const {
    return violations_;
  }  ///< accesses that the data sheet forbids

  void select(bool selected, Time now) override;
  std::uint8_t exchange(std::uint8_t out, Time now) override;
  bool takes_mode(unsigned mode) const override { return mode == 0 || mode == 3; }
  std::uint32_t max_hz() const override;

 private:
  void power_on();
  void update(Time now);
  void sample();
  std::uint8_t read(std::uint8_t address, Time now);
  void write(std::uint8_t address, std::uint8_t value, Time now);
  unsigned bank() const;
  bool asleep() const;
  Time period() const;
  bool mpu() const { return kind_ == ImuKind::kMpu9250; }

  ImuKind kind_;
  std::uint8_t registers_[4][128] = {};
  std::int16_t gyro_[3] = {}, accel_[3] = {};
  bool addressed_ = false;  ///< the register address of this transfer has come
  bool reading_ = false;
  std::uint8_t pointer_ = 0;
  Time ready_at_ = 0;
  Time sample_at_ = 0;
  std::uint32_t samples_ = 0, violations_ = 0;
};

}  // namespace verp::hal::stm32::model
