#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/protocol/servo_models.hpp"
#include "host/twin/bus/bus_device.hpp"
#include "host/twin/bus/register_table.hpp"

namespace verp::bus {

/// A Dynamixel device.
class Device : public BusDevice {
 public:
  std::uint8_t id() const override { return byte(dxl::address::kId); }
  std::uint8_t baud_code() const { return byte(dxl::address::kBaudRate); }
  bool runs_at(std::uint32_t baud) const override {
    return baud_code() == dxl::baud_rate_code(baud);
  }
  std::uint16_t model() const {
    return static_cast<std::uint16_t>(table_.get(dxl::address::kModelNumber));
  }
  std::uint8_t firmware_version() const { return byte(dxl::address::kFirmwareVersion); }
  std::uint32_t return_delay_us() const override { return 2u * byte(dxl::address::kReturnDelay); }
  /// Secondary ID: a group is written together and does not reply.
  virtual bool in_group(std::uint8_t) const { return false; }
  virtual std::uint8_t status_level() const { return 2; }
  virtual bool answers_fast_sync_read() const { return true; }
  virtual bool alert() const { return false; }

  /// Updates the registers; the plant is at the time of the reply.
  virtual void refresh(std::uint16_t address, std::uint16_t length) = 0;
  /// Empty past the table's end; valid until the next read.
  std::span<const std::uint8_t> read(std::uint16_t address, std::uint16_t length);

  /// Stores all of a write or nothing; the plant is at the arrival time.
  virtual dxl::Error write(std::uint16_t address, std::span<const std::uint8_t> data);
  /// Keeps a write until action(), or returns the reason for refusing it.
  dxl::Error reg_write(std::uint16_t address, std::span<const std::uint8_t> data);
  dxl::Error action();

  void lose_power() override;
  void reboot() override;
  /// e-Manual, Control Table Backup: stores the table, or restores the EEPROM and restarts.
  virtual dxl::Error backup(std::span<const std::uint8_t>) { return dxl::Error::kInstruction; }
  /// Refused while torque is on. Unless kept, the id becomes 1 and the baud rate 57600.
  dxl::Error factory_reset(dxl::Reset reset);
  /// Removes full turns from Present Position; the twin has no full turns. Refused while moving.
  dxl::Error clear(std::span<const std::uint8_t> parameters);

 protected:
  explicit Device(std::vector<Register> registers,
                  std::span<const dxl::IndirectBlock> indirect = {})
      : table_(std::move(registers)), indirect_(indirect) {}
  virtual dxl::Error check(std::uint16_t address, std::span<const std::uint8_t> data) const {
    return table_.check(address, data, false);
  }
  virtual void written(std::uint16_t address, std::uint16_t length) = 0;
  virtual void restarted() {}
  /// Power is on and the registers are initialised.
  virtual void started() {}
  virtual bool moving() { return false; }
  std::uint8_t byte(std::uint16_t address) const {
    return static_cast<std::uint8_t>(table_.get(address));
  }
  RegisterTable table_;
  std::span<const dxl::IndirectBlock> indirect_;

 private:
  struct Piece {
    std::uint16_t address;
    std::vector<std::uint8_t> data;
  };
  /// The target of Indirect Data, otherwise `address`.
  std::uint16_t meant(std::uint16_t address) const;
  std::vector<Piece> pieces(std::uint16_t address, std::span<const std::uint8_t> data) const;
  dxl::Error check(const std::vector<Piece>& pieces) const;
  dxl::Error store(const std::vector<Piece>& pieces);

  std::vector<Piece> registered_;
  std::vector<std::uint8_t> answer_;
};

}  // namespace verp::bus
