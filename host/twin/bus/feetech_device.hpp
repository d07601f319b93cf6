#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/protocol/feetech_table.hpp"
#include "host/twin/bus/bus_device.hpp"
#include "host/twin/bus/feetech_registers.hpp"
#include "host/twin/bus/register_table.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::bus {

/// A device with a Feetech memory table. A write stores each whole register that is writable and
/// whose value is in range, and ignores the rest: what a servo does with others is published
/// nowhere. While Lock (55) is 1, EEPROM writes last until power is lost.
class FeetechDevice : public BusDevice {
 public:
  std::uint8_t id() const override { return byte(feetech::address::kId); }
  bool runs_at(std::uint32_t baud) const override {
    return byte(feetech::address::kBaudRate) == feetech::baud_rate_code(baud);
  }
  std::uint32_t return_delay_us() const override {
    return 2u * byte(feetech::address::kReturnDelay);
  }
  bool answers_all() const { return byte(feetech::address::kStatusLevel) != 0; }
  virtual std::uint8_t status() { return 0; }

  /// Zeros past the table's end. The plant is at the time of the reply.
  std::vector<std::uint8_t> read(std::uint8_t address, std::uint8_t length);
  /// The plant is at the arrival time.
  void write(std::uint8_t address, std::span<const std::uint8_t> data);
  /// Keeps a write until action().
  void reg_write(std::uint8_t address, std::span<const std::uint8_t> data);
  void action();

  void lose_power() override;
  void reboot() override { lose_power(); }

 protected:
  explicit FeetechDevice(std::vector<Register> registers)
      : table_(std::move(registers)), kept_(table_) {}
  virtual void refresh() = 0;
  virtual void written() {}
  std::uint8_t byte(std::uint8_t address) const {
    return static_cast<std::uint8_t>(table_.get(address));
  }
  std::uint16_t word(std::uint8_t address) const {
    return static_cast<std::uint16_t>(table_.get(address));
  }
  RegisterTable table_;

 private:
  RegisterTable kept_;  ///< EEPROM after the next power loss
  std::uint8_t registered_at_ = 0;
  std::vector<std::uint8_t> registered_;
};

/// An STS servo for one joint of a plant, in position mode. In its other modes it is limp.
class FeetechServo final : public FeetechDevice {
 public:
  FeetechServo(const feetech_bus::Identity& identity, sim::Plant& plant, int joint);
  bool torque_on() const override { return byte(feetech::address::kTorqueEnable) == 1; }
  std::uint8_t status() override;

 private:
  void refresh() override;
  void written() override;
  void apply();
  std::int32_t offset() const;
  std::uint16_t shown(std::int32_t count) const;
  void make_middle();
  /// Above Overload Torque for Protection Time only Protective Torque is left, until torque is
  /// switched off.
  void watch_load(const sim::ServoMeasurement& measured);
  void watch_limits(const sim::ServoMeasurement& measured);

  sim::Plant& plant_;
  int joint_;
  std::uint8_t torque_before_ = 0;
  std::uint64_t loaded_since_us_ = kNever_us;
  bool overloaded_ = false;
};

class FeetechSensor : public FeetechDevice {
 protected:
  FeetechSensor(const feetech_bus::Identity& identity, sim::Plant& plant)
      : FeetechDevice(feetech_bus::sensor_registers(identity)), plant_(plant) {}
  void put(unsigned word, std::uint16_t value);
  /// Call after put(): the block's CRC.
  void seal();
  sim::Plant& plant_;
};

class FeetechImu final : public FeetechSensor {
 public:
  using FeetechSensor::FeetechSensor;
  FeetechImu(std::uint8_t id, std::uint32_t baud, sim::Plant& plant)
      : FeetechSensor({id, feetech::kModelImu, baud}, plant) {}

 private:
  void refresh() override;
};

class FeetechFoot final : public FeetechSensor {
 public:
  FeetechFoot(std::uint8_t id, std::uint32_t baud, sim::Plant& plant, int foot)
      : FeetechSensor({id, feetech::kModelFoot, baud}, plant), foot_(foot) {}

 private:
  void refresh() override;
  int foot_;
};

}  // namespace verp::bus
