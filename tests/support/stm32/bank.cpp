#include "tests/support/stm32/bank.hpp"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "tests/support/stm32/machine.hpp"

namespace verp::hal::stm32::model {
namespace {

std::string hex(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08X", static_cast<unsigned>(value));
  return text;
}

}  // namespace

void broken(const std::string& why) {
  std::fprintf(stderr, "STM32 model: %s\n", why.c_str());
  std::abort();
}

Bank::Bank(Machine& machine, std::string name, std::uint32_t base, const Table& table, Gate gate)
    : machine_(machine), name_(std::move(name)), base_(base), gate_(gate) {
  add_registers(table, 0);
}

void Bank::add_registers(const Table& table, std::uint32_t shift) {
  for (Register rule : table) {
    rule.offset += shift;
    const std::size_t word = rule.offset / 4;
    if (index_.size() <= word) index_.resize(word + 1, -1);
    index_[word] = static_cast<int>(slots_.size());
    slots_.push_back({rule, rule.reset, rule.reset});
    if (window_ < rule.offset + 4) window_ = rule.offset + 4;
  }
}

Bank::Slot* Bank::find(std::uint32_t offset) {
  const std::size_t word = offset / 4;
  if (word >= index_.size() || index_[word] < 0) return nullptr;
  return &slots_[static_cast<std::size_t>(index_[word])];
}

Bank::Slot& Bank::slot(std::uint32_t offset) {
  Slot* found = find(offset);
  if (found == nullptr) broken(name_ + " has no register at " + hex(offset));
  return *found;
}
const Bank::Slot& Bank::slot(std::uint32_t offset) const {
  return const_cast<Bank*>(this)->slot(offset);
}

void Bank::violate(const std::string& what) const {
  machine_.violate(name_ + ": " + what);
}

void Bank::reset() {
  for (Slot& slot : slots_) slot.value = slot.last_read = slot.rule.reset;
}

std::uint32_t Bank::bus_read(std::uint32_t address, unsigned width) {
  const std::uint32_t offset = fold((address - base_) & ~3u);
  const unsigned lane = 8 * (address & 3u);
  Slot* found = find(offset);
  if (found == nullptr) {
    violate("read of no register at " + hex(address));
    return 0;
  }
  const std::string what = std::string("read of ") + found->rule.name;
  if (!machine_.clocked(*this, what)) return 0;
  if (width != 4 && !narrow_ok(offset, width))
    violate(what + " with " + std::to_string(8 * width) + " bits");
  if (found->rule.defined() == found->rule.w) violate(what + ", which can only be written");
  width_ = width;
  before_read(offset);
  const std::uint32_t value = found->value & ~found->rule.w;
  found->last_read = value;
  found->value &= ~found->rule.rc_r;
  after_read(offset);
  return value >> lane;
}

bool Bank::check_write(const Slot& slot, std::uint32_t raw) const {
  const Register& rule = slot.rule;
  const std::string what = std::string("write of ") + hex(raw) + " to " + rule.name;
  if (rule.defined() == (rule.r | rule.rc_r)) {
    violate(what + ", which can only be read");
    return false;
  }
  const std::uint32_t reserved = (raw ^ rule.reset) & ~rule.defined();
  if (reserved != 0) violate(what + " changes reserved bits " + hex(reserved));
  // Where writing 0 has no effect, one bit may be written alone.
  if ((rule.rc_w0 | rule.rc_w1 | rule.rs) == 0) {
    // Writing back a value that changed since the driver's read is no violation.
    const std::uint32_t forced = (raw ^ slot.value) & (raw ^ slot.last_read) & rule.r;
    if (forced != 0) violate(what + " means to change read-only bits " + hex(forced));
  }
  return true;
}

void Bank::bus_write(std::uint32_t address, std::uint32_t value, unsigned width) {
  const std::uint32_t offset = fold((address - base_) & ~3u);
  Slot* found = find(offset);
  if (found == nullptr) {
    violate("write to no register at " + hex(address));
    return;
  }
  const Register rule = found->rule;
  const std::string what = std::string("write to ") + rule.name;
  if (!machine_.clocked(*this, what)) return;
  if (width != 4 && !narrow_ok(offset, width))
    violate(what + " with " + std::to_string(8 * width) + " bits");
  if (!check_write(*found, value)) return;
  width_ = width;
  before_read(offset);
  if (!may_write(offset, value)) return;
  const std::uint32_t old = found->value;
  std::uint32_t now = (old & ~rule.rw) | (value & rule.rw);
  now |= value & rule.rs;
  now &= value | ~rule.rc_w0;
  now &= ~(value & rule.rc_w1);
  found->value = now;
  on_write(offset, value, old);
  machine_.touch();
}

}  // namespace verp::hal::stm32::model
