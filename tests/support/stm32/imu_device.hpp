#pragma once
#include <cstdint>
#include <deque>
#include <functional>

#include "tests/support/stm32/spi_model.hpp"

/// An MPU-9250 (RM-MPU-9250A-00), an MPU-6050 (RM-MPU-6000A-00) or an ICM-20648 (DS-000179). All
/// counts of a sample are of one instant. The FIFO holds 512 bytes of what FIFO_EN selects. When
/// full it loses single bytes, the oldest or newest by its mode, and is out of step. Unknown
/// registers are stored.
namespace verp::hal::stm32::model {

enum class ImuKind : std::uint8_t { kMpu9250, kIcm20648, kMpu6050 };

class ImuDevice : public SpiDevice {
 public:
  explicit ImuDevice(ImuKind kind);

  // Script.
  bool silent = false;  ///< answers all ones
  bool frozen = false;
  std::size_t torn = 0;  ///< bytes of each sample that come one exchange late
  std::function<void()> before_sample = [] {};
  int who_am_i = -1;          ///< replaces the identity
  Time reset_time = ms(100);  ///< after DEVICE_RESET
  /// In the sensor's axes.
  void motion(const std::int16_t (&gyro)[3], const std::int16_t (&accel)[3]);
  /// As after a dip of its supply.
  void forget() { power_on(); }
  /// Loses FIFO bytes, as after a clock edge too many.
  void slip(std::size_t bytes);
  void update(Time now);

  std::uint8_t reg(unsigned bank, std::uint8_t address) const { return registers_[bank][address]; }
  std::uint32_t samples_taken() const { return samples_; }
  std::size_t fifo_size() const { return fifo_.size(); }
  std::uint32_t violations() const { return violations_; }

  void select(bool selected, Time now) override;
  std::uint8_t exchange(std::uint8_t out, Time now) override;
  bool takes_mode(unsigned mode) const override { return mode == 0 || mode == 3; }
  std::uint32_t max_hz() const override;

 private:
  static constexpr std::size_t kFifoSize = 512;
  struct Map;
  const Map& map() const;
  void power_on();
  void sample();
  void put_in_fifo();
  void let_in(std::size_t but);
  void push(std::uint8_t byte);
  bool fifo_is_on() const;
  std::uint8_t read_fifo(std::uint8_t address);
  void reset_fifo_if_told(std::uint8_t address, std::uint8_t value);
  std::uint8_t read(std::uint8_t address, Time now);
  void write(std::uint8_t address, std::uint8_t value, Time now);
  unsigned bank() const;
  bool asleep() const;
  Time period() const;
  bool mpu() const { return kind_ != ImuKind::kIcm20648; }

  ImuKind kind_;
  std::uint8_t registers_[4][128] = {};
  std::int16_t gyro_[3] = {}, accel_[3] = {};
  std::deque<std::uint8_t> fifo_;
  std::deque<std::uint8_t> on_the_way_;  ///< not yet in the FIFO
  std::uint8_t fifo_byte_ = 0;
  std::uint8_t fifo_size_low_ = 0;  ///< frozen by the high byte's read
  bool addressed_ = false;
  bool reading_ = false;
  std::uint8_t pointer_ = 0;
  Time ready_at_ = 0;
  Time sample_at_ = 0;
  std::uint32_t samples_ = 0, violations_ = 0;
};

}  // namespace verp::hal::stm32::model
