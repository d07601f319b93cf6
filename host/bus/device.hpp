#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "host/bus/register_table.hpp"

namespace verp::bus {

/// What every device on the bus has: an id, a control table, Return Delay Time and a status return
/// level. Time and the wire belong to VirtualBus.
class Device {
 public:
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  std::uint8_t id() const { return byte(dxl::address::kId); }
  std::uint16_t model() const {
    return static_cast<std::uint16_t>(table_.get(dxl::address::kModelNumber));
  }
  std::uint8_t firmware_version() const { return byte(dxl::address::kFirmwareVersion); }
  std::uint32_t return_delay_us() const { return 2u * byte(dxl::address::kReturnDelay); }
  virtual std::uint8_t status_level() const { return 2; }
  virtual bool answers_fast_sync_read() const { return true; }
  virtual bool alert() const { return false; }

  /// Brings the registers in the range up to date; the plant stands at the moment of the reply.
  virtual void refresh(std::uint16_t address, std::uint16_t length) = 0;
  std::span<const std::uint8_t> read(std::uint16_t address, std::uint16_t length) {
    refresh(address, length);
    return table_.bytes(address, length);
  }

  /// Stores a write or says why not; the plant stands at the moment of the write's arrival.
  dxl::Error write(std::uint16_t address, std::span<const std::uint8_t> data) {
    const dxl::Error error = check(address, data);
    if (error == dxl::Error::kNone) {
      table_.store(address, data);
      written(address, static_cast<std::uint16_t>(data.size()));
    }
    return error;
  }

 protected:
  explicit Device(std::vector<Register> registers) : table_(std::move(registers)) {}
  virtual dxl::Error check(std::uint16_t address, std::span<const std::uint8_t> data) const {
    return table_.check(address, data, false);
  }
  /// Follows each stored write.
  virtual void written(std::uint16_t address, std::uint16_t length) = 0;
  std::uint8_t byte(std::uint16_t address) const {
    return static_cast<std::uint8_t>(table_.get(address));
  }
  RegisterTable table_;
};

}  // namespace verp::bus
