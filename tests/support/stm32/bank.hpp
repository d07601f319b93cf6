#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/stm32/registers/table.hpp"
#include "tests/support/stm32/time.hpp"

/// Registers that behave as their table says, and a record of each forbidden access.
namespace verp::hal::stm32::model {

class Machine;

/// Ends the program: the test or model is impossible.
[[noreturn]] void broken(const std::string& why);

/// The RCC bit that clocks a peripheral.
struct Gate {
  std::uint32_t enable_offset = 0;  ///< 0: always on
  std::uint32_t enable_bit = 0;
  std::uint32_t reset_bit = 0;  ///< in the reset register, 0x20 below
};

class Bank {
 public:
  Bank(Machine& machine, std::string name, std::uint32_t base, const Table& table, Gate gate);
  virtual ~Bank() = default;
  Bank(const Bank&) = delete;
  Bank& operator=(const Bank&) = delete;

  const std::string& name() const { return name_; }
  std::uint32_t base() const { return base_; }
  const Gate& gate() const { return gate_; }
  bool holds(std::uint32_t address) const { return address - base_ < window_; }

  std::uint32_t bus_read(std::uint32_t address, unsigned width);
  void bus_write(std::uint32_t address, std::uint32_t value, unsigned width);

  /// Without the effects of a read.
  std::uint32_t peek(std::uint32_t offset) const { return slot(offset).value; }

  virtual void reset();
  /// Does what is due at machine.now().
  virtual void run() {}
  /// The bus clocks will change: counts up to now.
  virtual void rebase() {}
  virtual Time next() const { return kNever; }
  virtual bool dma_request(bool /*transmit*/) const { return false; }
  virtual bool interrupt(unsigned) const { return false; }

 protected:
  /// Updates the value before a read, applies the read's effects after it.
  virtual void before_read(std::uint32_t /*offset*/) {}
  virtual void after_read(std::uint32_t /*offset*/) {}
  /// If false, it calls violate() with the reason.
  virtual bool may_write(std::uint32_t /*offset*/, std::uint32_t /*raw*/) { return true; }
  /// `raw` is the written value, `old` the previous one.
  virtual void on_write(std::uint32_t /*offset*/, std::uint32_t /*raw*/, std::uint32_t /*old*/) {}
  /// For registers with several addresses.
  virtual std::uint32_t fold(std::uint32_t offset) const { return offset; }
  /// True if accesses under 32 bits are allowed.
  virtual bool narrow_ok(std::uint32_t /*offset*/, unsigned /*width*/) const { return false; }

  void add_registers(const Table& table, std::uint32_t shift);
  std::uint32_t& reg(std::uint32_t offset) { return slot(offset).value; }
  std::uint32_t reg(std::uint32_t offset) const { return slot(offset).value; }
  bool has(std::uint32_t offset, std::uint32_t mask) const { return (reg(offset) & mask) != 0; }
  void set(std::uint32_t offset, std::uint32_t mask) { reg(offset) |= mask; }
  void clear(std::uint32_t offset, std::uint32_t mask) { reg(offset) &= ~mask; }
  void violate(const std::string& what) const;
  Machine& machine() const { return machine_; }
  unsigned access_width() const { return width_; }
  void widen(std::uint32_t window) { window_ = window; }

 private:
  struct Slot {
    Register rule;
    std::uint32_t value = 0;
    std::uint32_t last_read = 0;
  };
  Slot* find(std::uint32_t offset);
  Slot& slot(std::uint32_t offset);
  const Slot& slot(std::uint32_t offset) const;
  /// False if the write has no effect.
  bool check_write(const Slot& slot, std::uint32_t raw) const;

  Machine& machine_;
  std::string name_;
  std::uint32_t base_;
  std::uint32_t window_ = 0;
  Gate gate_;
  std::vector<Slot> slots_;
  std::vector<int> index_;  ///< word offset -> slot, or -1
  unsigned width_ = 4;
};

}  // namespace verp::hal::stm32::model
