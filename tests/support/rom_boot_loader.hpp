#pragma once
#include <cstdint>
#include <set>
#include <vector>

/// The USART boot loader in an STM32's ROM, and its flash. Written from AN3155, not from any flash
/// tool.
namespace verp::test {

class RomBootLoader {
 public:
  static constexpr std::uint8_t kSync = 0x7F, kAck = 0x79, kNack = 0x1F;
  static constexpr std::uint32_t kFlashBegin = 0x08000000;

  struct Chip {
    std::uint16_t device_id = 0x413;               ///< STM32F405 (AN2606)
    std::vector<std::uint32_t> sector_bytes = {};  ///< empty: STM32F405RG
    bool readout_protected = false;                ///< level 1
    std::set<std::uint32_t> refused = {};          ///< writes over these get NACK
    std::set<std::uint32_t> stuck = {};            ///< bytes that stay 0
  };

  explicit RomBootLoader(Chip chip);

  void take(std::uint8_t byte, std::vector<std::uint8_t>& reply);
  /// Reset with BOOT0 high; the flash keeps its content.
  void reset() { state_ = State::kAsleep; }

  std::vector<std::uint8_t> flash;
  std::uint32_t writes = 0, erased_sectors = 0;
  bool started = false;  ///< by Go

 private:
  enum class State : std::uint8_t {
    kAsleep,
    kCommand,
    kComplement,
    kAddress,
    kReadLength,
    kWriteData,
    kErase,
    kProtect,
    kRunning
  };
  using Reply = std::vector<std::uint8_t>;

  void command(Reply& reply);
  void address(Reply& reply);
  void read(Reply& reply);
  void write(Reply& reply);
  void erase(Reply& reply);
  void expect(State next, Reply& reply);
  void refuse(Reply& reply);
  bool in_flash(std::uint32_t address, std::size_t bytes) const;
  bool checksum_is_good(std::uint8_t seed) const;
  void erase_sector(std::size_t sector);
  void erase_all();

  Chip chip_;
  State state_ = State::kAsleep;
  std::uint8_t command_ = 0;
  std::uint32_t address_ = 0;
  std::vector<std::uint8_t> got_;
};

}  // namespace verp::test
