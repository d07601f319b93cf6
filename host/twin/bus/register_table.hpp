#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/protocol/dynamixel2.hpp"

/// A control table with access rules. A write is checked before any byte changes.
namespace verp::bus {

struct Register {
  std::uint16_t address = 0;
  std::uint8_t size = 1;  ///< 1, 2 or 4 bytes
  bool writable = false;
  std::int64_t initial = 0;
  std::int64_t minimum = 0;  ///< of written values; negative: signed register
  std::int64_t maximum = 0xFFFFFFFF;
};

class RegisterTable {
 public:
  /// Sorted by address, without overlap; the table ends after the last one.
  explicit RegisterTable(std::vector<Register> registers);

  std::int64_t get(std::uint16_t address) const;
  void set(std::uint16_t address, std::int64_t value);
  const Register* find(std::uint16_t address) const;
  void restore_initial(std::uint16_t first, std::uint16_t end);
  /// Copies from a table with the same registers.
  void copy(const RegisterTable& other, std::uint16_t first, std::uint16_t end);

  /// Empty past the table's end; gaps read as zero, as in real servos.
  std::span<const std::uint8_t> bytes(std::uint16_t address, std::uint16_t length) const;

  /// kNone: `data` covers whole, writable, unlocked registers with values in range.
  dxl::Error check(std::uint16_t address, std::span<const std::uint8_t> data,
                   bool eeprom_locked) const;
  /// Value of `reg` in a write of `data` at `address`, which must cover `reg`.
  static std::int64_t value_in(const Register& reg, std::uint16_t address,
                               std::span<const std::uint8_t> data);
  void store(std::uint16_t address, std::span<const std::uint8_t> data);

 private:
  std::vector<Register> registers_;
  std::vector<std::int16_t> index_;  ///< by address; -1: none begins there
  std::vector<std::uint8_t> image_;
};

}  // namespace verp::bus
