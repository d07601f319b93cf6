#pragma once
#include <cstdint>
#include <vector>

#include "hal/chip/bosch/bno055.hpp"
#include "hal/chip/bosch/bno055_uart.hpp"
#include "hal/fake/manual_clock.hpp"
#include "host/os/imu/imu_reader.hpp"
#include "host/twin/imu/bno055_model.hpp"
#include "host/twin/imu/bno055_port.hpp"

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
template <bool kUart>
struct Bno055Rig {
  using Clock = hal::ManualClock;

  Bno055Rig() { settle(); }
  void measure(std::int16_t gyro_x) {
    model.measure({.gyro_count = {gyro_x, 0, 0}, .accel_count = {0, 0, 981}});
    turn();
  }
  void break_chip(bool yes) { model.silent = yes; }
  hal::ImuStatus read(hal::ImuSample& sample) {
    turn();
    return reader.read(sample);
  }
  std::uint32_t faults() const { return reader.faults(); }
  /// Until the chip measures, or for two seconds.
  void settle() {
    for (int i = 0, measuring = 0; i < 400 && measuring < 5; ++i) {
      turn(5'000);
      measuring = model.measures() ? measuring + 1 : 0;
    }
  }
  hal::ImuStatus turn(std::uint32_t after_us = 100) {
    clock.advance(after_us);
    return reader.turn();
  }

  Clock clock;
  imu::Bno055Model model;
  Bno055Wire wire{model, clock};
  hal::bosch::Bno055Uart<Clock> uart{wire, clock};
  ModelBus<imu::Bno055Model> i2c{model, clock};
  hal::RegisterBus& bus = kUart ? static_cast<hal::RegisterBus&>(uart) : i2c;
  hal::bosch::Bno055<Clock> chip{bus, clock};
  imu::ImuReader reader{
      [this](hal::ImuMean& mean, std::uint64_t& time_us) { return chip.collect(mean, time_us); }};
};

using Bno055OnI2c = Bno055Rig<false>;
using Bno055OnUart = Bno055Rig<true>;

}  // namespace verp::test
