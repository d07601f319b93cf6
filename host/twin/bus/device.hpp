#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "host/twin/bus/register_table.hpp"

namespace verp::bus {

/// What every device on the bus has: an id, a control table, Return Delay Time and a status return
/// level. Time and the wire belong to VirtualBus.
class Device {
 public:
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  std::uint8_t id() const { return byte(dxl::address::kId); }
  std::uint8_t baud_code() const { return byte(dxl::address::kBaudRate); }
  std::uint16_t model() const {
    return static_cast<std::uint16_t>(table_.get(dxl::address::kModelNumber));
  }
  std::uint8_t firmware_version() const { return byte(dxl::address::kFirmwareVersion); }
  std::uint32_t return_delay_us() const { return 2u * byte(dxl::address::kReturnDelay); }
  /// Secondary ID: of a group that is written together and does not answer.
  virtual bool in_group(std::uint8_t) const { return false; }
  virtual std::uint8_t status_level() const { return 2; }
  virtual bool answers_fast_sync_read() const { return true; }
  virtual bool alert() const { return false; }
  virtual bool torque_on() const { return false; }

  /// Brings the registers in the range up to date; the plant stands at the moment of the reply.
  virtual void refresh(std::uint16_t address, std::uint16_t length) = 0;
  /// Empty past the table's end. Valid until the next read.
  std::span<const std::uint8_t> read(std::uint16_t address, std::uint16_t length);

  /// Stores a write or says why not; the plant stands at the moment of the write's arrival. Nothing
  /// is stored unless all of it can be.
  virtual dxl::Error write(std::uint16_t address, std::span<const std::uint8_t> data);
  /// Keeps a write until action(), or says why it can't be.
  dxl::Error reg_write(std::uint16_t address, std::span<const std::uint8_t> data);
  dxl::Error action();

  /// An instruction packet, for whomever, was on the wire until `time_us`.
  void heard(std::uint64_t time_us) { heard_us_ = time_us; }
  /// When the device does something by itself if nothing more is heard.
  virtual std::uint64_t deadline_us() const { return kNever_us; }
  /// The plant stands at deadline_us().
  virtual void expire() {}

  /// RAM registers as they begin, a hardware error gone.
  void lose_power();
  /// Power off and on.
  void reboot();
  /// e-Manual, Control Table Backup: keeps what stands there, or puts EEPROM back and begins anew.
  virtual dxl::Error backup(std::span<const std::uint8_t>) { return dxl::Error::kInstruction; }
  /// Not with torque on. Unless kept, the id becomes 1 and the baud rate 57600.
  dxl::Error factory_reset(dxl::Reset reset);
  /// Takes the turns off Present Position, which here never has any; not while moving.
  dxl::Error clear(std::span<const std::uint8_t> parameters);

 protected:
  explicit Device(std::vector<Register> registers) : table_(std::move(registers)) {}
  virtual dxl::Error check(std::uint16_t address, std::span<const std::uint8_t> data) const {
    return table_.check(address, data, false);
  }
  /// Follows each stored write.
  virtual void written(std::uint16_t address, std::uint16_t length) = 0;
  /// Follows a reboot and a reset.
  virtual void restarted() {}
  /// Power is there, and the registers are as they begin.
  virtual void started() {}
  virtual bool moving() { return false; }
  std::uint8_t byte(std::uint16_t address) const {
    return static_cast<std::uint8_t>(table_.get(address));
  }
  static constexpr std::uint64_t kNever_us = ~std::uint64_t{0};
  RegisterTable table_;
  std::uint64_t heard_us_ = 0;

 private:
  struct Piece {  ///< of a write, on consecutive registers
    std::uint16_t address;
    std::vector<std::uint8_t> data;
  };
  /// The byte of the control table that `address` stands for: itself, unless it is Indirect Data.
  std::uint16_t meant(std::uint16_t address) const;
  std::vector<Piece> pieces(std::uint16_t address, std::span<const std::uint8_t> data) const;
  dxl::Error check(const std::vector<Piece>& pieces) const;
  dxl::Error store(const std::vector<Piece>& pieces);

  std::vector<Piece> registered_;
  std::vector<std::uint8_t> answer_;
};

}  // namespace verp::bus
