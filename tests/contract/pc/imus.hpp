#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "hal/chip/bosch/bno055.hpp"
#include "hal/chip/bosch/bno055_uart.hpp"
#include "hal/chip/invensense/icm42688.hpp"
#include "hal/chip/invensense/motion_sensor.hpp"
#include "hal/chip/invensense/register_spi.hpp"
#include "hal/fake/manual_clock.hpp"
#include "host/os/imu/imu_reader.hpp"
#include "host/twin/imu/bno055_model.hpp"
#include "host/twin/imu/bno055_port.hpp"
#include "tests/support/icm42688_model.hpp"
#include "tests/support/stm32/imu_device.hpp"

namespace verp::test {

/// Registers of a model, as if on I2C.
template <class Model>
class ModelBus final : public hal::RegisterBus {
 public:
  ModelBus(Model& model, hal::ManualClock& clock) : model_(model), clock_(clock) {}
  bool read(std::uint8_t address, std::uint8_t* data, std::size_t size) override {
    return model_.read(address, data, size, clock_.now_us());
  }
  bool write(std::uint8_t address, const std::uint8_t* data, std::size_t size) override {
    return model_.write(address, data, size, clock_.now_us());
  }

 private:
  Model& model_;
  hal::ManualClock& clock_;
};

/// Bytes to and from the model's UART; its answers come at once, its silence takes the time.
class Bno055Wire final : public hal::ByteLink {
 public:
  Bno055Wire(imu::Bno055Model& model, hal::ManualClock& clock) : port(model), clock_(clock) {}
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t) override {
    port.take({data, size}, clock_.now_us(), answer_);
    return size;
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    std::size_t count = 0;
    for (; count < capacity && count < answer_.size(); ++count) buffer[count] = answer_[count];
    answer_.erase(answer_.begin(), answer_.begin() + static_cast<std::ptrdiff_t>(count));
    if (count == 0) clock_.advance(timeout_us);
    return count;
  }
  bool connected() const override { return true; }
  hal::LinkErrors errors() const override { return {}; }

  imu::Bno055Port port;

 private:
  hal::ManualClock& clock_;
  std::vector<std::uint8_t> answer_;
};

/// A PC's Imu without its thread: the test collects.
template <class Model>
class CollectingRig {
 public:
  /// The chip has settled when it has measured for so many turns of 5 ms.
  CollectingRig(int turns, imu::Collect collect) : reader(std::move(collect)), turns_(turns) {}
  void break_chip(bool yes) { model.silent = yes; }
  hal::ImuStatus read(hal::ImuSample& sample) {
    turn();
    return reader.read(sample);
  }
  std::uint32_t faults() const { return reader.faults(); }
  hal::ImuStatus turn(std::uint32_t after_us = 100) {
    clock.advance(after_us);
    return reader.turn();
  }
  /// For two seconds at most.
  void settle() {
    for (int i = 0, measuring = 0; i < 400 && measuring < turns_; ++i) {
      turn(5'000);
      measuring = model.measures() ? measuring + 1 : 0;
    }
  }

  hal::ManualClock clock;
  Model model;
  imu::ImuReader reader;

 private:
  const int turns_;
};

template <bool kUart>
struct Bno055Rig : CollectingRig<imu::Bno055Model> {
  Bno055Rig()
      : CollectingRig(5,
                      [this](auto& mean, auto& time_us) { return chip.collect(mean, time_us); }) {
    settle();
  }
  void measure(std::int16_t gyro_x) {
    model.measure({.gyro_count = {gyro_x, 0, 0}, .accel_count = {0, 0, 981}});
    turn();
  }

  Bno055Wire wire{model, clock};
  hal::bosch::Bno055Uart<hal::ManualClock> uart{wire, clock};
  ModelBus<imu::Bno055Model> i2c{model, clock};
  hal::RegisterBus& bus = kUart ? static_cast<hal::RegisterBus&>(uart) : i2c;
  hal::bosch::Bno055<hal::ManualClock> chip{bus, clock};
};

struct Icm42688Rig : CollectingRig<Icm42688Model> {
  Icm42688Rig()
      : CollectingRig(14,
                      [this](auto& mean, auto& time_us) { return chip.collect(mean, time_us); }) {
    settle();
  }
  void measure(std::int16_t gyro_x) {
    model.measure({gyro_x, 0, 0}, {0, 0, 8192});
    turn();
  }

  ModelBus<Icm42688Model> i2c{model, clock};
  hal::invensense::Icm42688<hal::ManualClock> chip{i2c, clock};
};

/// The model of the chip behind SPI, as if on I2C.
class Mpu6050Model : public hal::stm32::model::ImuDevice {
 public:
  Mpu6050Model() : ImuDevice(hal::stm32::model::ImuKind::kMpu6050) {}
  bool read(std::uint8_t address, std::uint8_t* data, std::size_t size, std::uint64_t now_us) {
    const auto now = hal::stm32::model::us(now_us);
    if (silent) return false;
    select(true, now);
    exchange(static_cast<std::uint8_t>(0x80 | address), now);
    for (std::size_t i = 0; i < size; ++i) data[i] = exchange(0, now);
    select(false, now);
    return true;
  }
  bool write(std::uint8_t address, const std::uint8_t* data, std::size_t size,
             std::uint64_t now_us) {
    const auto now = hal::stm32::model::us(now_us);
    if (silent) return false;
    select(true, now);
    exchange(address, now);
    for (std::size_t i = 0; i < size; ++i) exchange(data[i], now);
    select(false, now);
    i2c_off |= address == 0x6A && (data[0] & 0x10) != 0;
    return true;
  }
  bool i2c_off = false;  ///< a driver on I2C has switched I2C off
};

struct Mpu6050Rig {
  using Spi = hal::invensense::RegisterSpi;
  using Clock = hal::ManualClock;

  Mpu6050Rig() { settle(); }
  ~Mpu6050Rig() {
    EXPECT_EQ(model.violations(), 0u) << "against the chip's data sheet";
    EXPECT_FALSE(model.i2c_off);
  }
  void measure(std::int16_t gyro_x) {
    model.motion({gyro_x, 0, 0}, {0, 0, 8192});
    look();
    model.frozen = false;
    const std::uint32_t taken = model.samples_taken();
    while (model.samples_taken() == taken) look();
    model.frozen = true;
  }
  void break_chip(bool yes) { model.silent = yes; }
  hal::ImuStatus read(hal::ImuSample& sample) {
    clock.advance(100);
    reader.turn();
    return reader.read(sample);
  }
  std::uint32_t faults() const { return reader.faults(); }
  void settle() {
    model.frozen = true;
    for (int tick = 0; tick < 30; ++tick) {
      reader.turn();
      clock.advance(8'000);
    }
  }
  void look() {
    clock.advance(100);
    model.update(hal::stm32::model::us(clock.now_us()));
  }

  Clock clock;
  Mpu6050Model model;
  ModelBus<Mpu6050Model> i2c{model, clock};
  Spi spi{i2c};
  hal::invensense::MotionSensor<Spi, Clock, hal::invensense::I2cKinds> chip{spi, clock};
  imu::ImuReader reader{
      [this](hal::ImuMean& mean, std::uint64_t& time_us) { return chip.collect(mean, time_us); }};
};

using Bno055OnI2c = Bno055Rig<false>;
using Bno055OnUart = Bno055Rig<true>;

}  // namespace verp::test
