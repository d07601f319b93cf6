#pragma once
#include <cstdint>
#include <map>

#include "hal/chip/stm32/registers/flash.hpp"
#include "tests/support/stm32/bank.hpp"
#include "tests/support/stm32/machine.hpp"

/// Programming clears bits. Power may fail in any write; the changing bits are then unsure until
/// power-on. A read of busy memory waits; polling BSY does not (as from RAM).
namespace verp::hal::stm32::model {

class FlashModel : public Bank {
 public:
  explicit FlashModel(Machine& machine);

  // DS8626, DS10693, DS10916: a write takes up to 100 us. Erasing at PSIZE 8 takes up to 800 ms for
  // 16 KB and 4 s for 128 KB; at 16 half, at 32 a quarter.
  Time program_time = us(16);
  Time erase_time_per_kb = ms(8);
  bool busy_stuck = false;              ///< BSY never falls once set
  std::uint32_t fail_next = 0;          ///< operations that end half done with OPERR
  std::uint32_t protected_sectors = 0;  ///< bit s: sector s
  /// What a write of option bytes meets: OPTCR that does not change (readout protection of level
  /// 2), an error at its end, or cells that have the old value after the next reset.
  enum class Options { kTake, kFrozen, kFail, kForget } options = Options::kTake;

  void seed(std::uint32_t seed) { random_ = seed * 2654435761u | 1u; }
  /// The power fails in the middle of the operation after `operations` more.
  void cut_power_after(std::uint32_t operations) {
    cut_planned_ = true;
    until_cut_ = operations;
  }
  void power_on();
  std::uint32_t programs() const { return programs_; }
  std::uint32_t erases() const { return erases_; }

  std::uint32_t wait_states() const;
  bool has_memory(std::uint32_t address) const {
    return address - kFlashBase < limits(machine().family()).flash_bytes;
  }
  std::uint32_t memory_read(std::uint32_t address, unsigned width);
  void memory_write(std::uint32_t address, std::uint32_t value, unsigned width);
  /// Without a bus access.
  std::uint8_t& byte(std::uint32_t address) {
    return chunks_[address / kChunkBytes].bytes[address % kChunkBytes];
  }

  void reset() override;
  void run() override;
  Time next() const override { return busy_stuck ? kNever : done_at_; }
  bool interrupt(unsigned irq) const override;

 protected:
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  void key_written(std::uint32_t key);
  void option_key_written(std::uint32_t key);
  void option_written(std::uint32_t raw, std::uint32_t old);
  void start_erase();
  void begin(Time takes);
  void fail(std::uint32_t flag, const char* why);
  int sector_of(std::uint32_t address) const;
  /// True if the power failed; `changing`: bits that were to change in each byte.
  bool power_goes();
  std::uint32_t random();

  // Stores only what was written: a microcontroller has no room for a flash.
  static constexpr std::uint32_t kChunkBytes = 1024;
  struct Chunk {
    Chunk() { __builtin_memset(bytes, 0xFF, sizeof bytes); }
    std::uint8_t bytes[kChunkBytes];
  };

  std::map<std::uint32_t, Chunk> chunks_;
  std::map<std::uint32_t, std::uint8_t> unsure_;  ///< bits, by address
  Time done_at_ = kNever;
  unsigned keys_ = 0, option_keys_ = 0;
  bool key_locked_ = false;
  bool error_pending_ = false;
  std::uint32_t option_bytes_;  ///< OPTCR after a reset
  bool cut_planned_ = false;
  std::uint32_t until_cut_ = 0;
  std::uint32_t programs_ = 0, erases_ = 0;
  std::uint32_t random_ = 0x2545F491;
};

}  // namespace verp::hal::stm32::model
