#include "tests/support/stm32/machine.hpp"

#include <algorithm>
#include <cstdio>

#include "tests/support/stm32/core_model.hpp"
#include "tests/support/stm32/dma_model.hpp"
#include "tests/support/stm32/flash_model.hpp"
#include "tests/support/stm32/iwdg_model.hpp"
#include "tests/support/stm32/rcc_model.hpp"

namespace verp::hal::stm32::model {
namespace {

/// More events at one moment mean a handler that does not clear its cause, or an unsatisfied
/// request.
constexpr unsigned kStorm = 1000;

/// Sets a flag for a scope, even if a handler throws.
class During {
 public:
  explicit During(bool& flag) : flag_(flag) { flag = true; }
  ~During() { flag_ = false; }
  During(const During&) = delete;
  During& operator=(const During&) = delete;

 private:
  bool& flag_;
};

}  // namespace

std::uint8_t ModelIo::read8(std::uint32_t address) {
  return static_cast<std::uint8_t>(machine_->bus_read(address, 1));
}
std::uint16_t ModelIo::read16(std::uint32_t address) {
  return static_cast<std::uint16_t>(machine_->bus_read(address, 2));
}
std::uint32_t ModelIo::read32(std::uint32_t address) {
  return machine_->bus_read(address, 4);
}
void ModelIo::write8(std::uint32_t address, std::uint8_t value) {
  machine_->bus_write(address, value, 1);
}
void ModelIo::write16(std::uint32_t address, std::uint16_t value) {
  machine_->bus_write(address, value, 2);
}
void ModelIo::write32(std::uint32_t address, std::uint32_t value) {
  machine_->bus_write(address, value, 4);
}
std::uint32_t ModelIo::bus_address(const void* data, std::size_t size) {
  return machine_->map(data, size);
}
void ModelIo::barrier() {
  machine_->barrier();
}
bool ModelIo::mask_interrupts() {
  return machine_->mask_interrupts();
}
void ModelIo::unmask_interrupts() {
  machine_->unmask_interrupts();
}
void ModelIo::wait_for_interrupt() {
  machine_->wait_for_interrupt();
}

std::string Machine::violations_text() const {
  std::string text;
  for (const std::string& violation : violations_) text += violation + "\n";
  return text;
}

void Machine::violate(const std::string& what) {
  if (violations_.size() < kStorm) violations_.push_back(what);
}

bool Machine::clocked(const Bank& bank, const std::string& what) {
  const Gate& gate = bank.gate();
  if (gate.enable_offset == 0) return true;
  if (!rcc_->enabled(gate)) {
    violate(bank.name() + ": " + what + " while its clock is off in RCC");
    return false;
  }
  if (rcc_->settling(gate)) {
    violate(bank.name() + ": " + what +
            " right after its clock was switched on: read RCC back first");
  }
  return true;
}

std::uint64_t Machine::core_cycles() const {
  return cycles_before_ + periods(now_ - cycles_from_, rcc_->hclk_hz());
}

void Machine::clocks_change() {
  cycles_before_ = core_cycles();
  cycles_from_ = now_;
  for (const auto& bank : banks_) bank->rebase();
}

Bank* Machine::bank_at(std::uint32_t address) {
  if (last_bank_ != nullptr && last_bank_->holds(address)) return last_bank_;
  for (const auto& bank : banks_) {
    if (bank->holds(address)) return last_bank_ = bank.get();
  }
  return nullptr;
}

void Machine::access_begins() {
  advance(duration(options_.access_cycles, rcc_->hclk_hz()));
}

std::uint32_t Machine::bus_read(std::uint32_t address, unsigned width) {
  if (!settling_) access_begins();  // DMA costs the core no time
  if (dark_) return 0;
  std::uint32_t value = 0;
  if (core_->holds(address)) {
    value = core_->read(address);
  } else if (flash_->has_memory(address)) {
    value = flash_->memory_read(address, width);
  } else if (Bank* bank = bank_at(address); bank != nullptr) {
    value = bank->bus_read(address, width);
  } else if (const std::uint8_t* data = memory(address, width); data != nullptr) {
    for (unsigned i = 0; i < width; ++i) value |= static_cast<std::uint32_t>(data[i]) << (8 * i);
  } else {
    violate("read of nothing at " + std::to_string(address));
  }
  rcc_->clocks_settled();
  settle();
  return value;
}

void Machine::bus_write(std::uint32_t address, std::uint32_t value, unsigned width) {
  if (!settling_) access_begins();  // DMA costs the core no time
  if (dark_) return;
  if (!rcc_->holds(address) && bank_at(address) == nullptr) rcc_->clocks_settled();
  if (core_->holds(address)) {
    core_->write(address, value);
  } else if (flash_->has_memory(address)) {
    flash_->memory_write(address, value, width);
  } else if (Bank* bank = bank_at(address); bank != nullptr) {
    bank->bus_write(address, value, width);
    if (bank != rcc_) rcc_->clocks_settled();
  } else if (std::uint8_t* data = memory(address, width); data != nullptr) {
    for (unsigned i = 0; i < width; ++i) data[i] = static_cast<std::uint8_t>(value >> (8 * i));
  } else {
    violate("write to nothing at " + std::to_string(address));
  }
  touch();
  settle();
}

void Machine::at(Time when, std::function<void()> what) {
  script_.emplace(when, std::move(what));
  touch();
}

Time Machine::next_event() const {
  Time when = script_.empty() ? kNever : script_.begin()->first;
  if (dark_) return when;
  for (const auto& bank : banks_) when = std::min(when, bank->next());
  return when;
}

void Machine::run_due() {
  while (!script_.empty() && script_.begin()->first <= now_) {
    const auto what = script_.begin()->second;
    script_.erase(script_.begin());
    what();
  }
  if (dark_) return;
  for (const auto& bank : banks_) bank->run();
}

void Machine::advance_to(Time when) {
  settle();
  while (next_ <= when) {
    now_ = std::max(now_, next_);
    run_due();
    touch();
    settle();
  }
  now_ = std::max(now_, when);  // a handler may take longer
}

bool Machine::serve_dma() {
  bool any = false;
  for (const auto& [number, dma] : dma_) any = dma->serve() || any;
  return any;
}

bool Machine::deliver(unsigned irq) {
  bool up = core_->pended(irq);
  for (const auto& bank : banks_) up = up || bank->interrupt(irq);
  if (!up || !core_->enabled(irq)) return false;
  core_->unpend(irq);
  const During handling(in_handler_);
  handlers_.at(irq)();
  return true;
}

void Machine::dispatch_interrupts() {
  if (in_handler_ || masked_ || dark_) return;
  for (unsigned round = 0; round < kStorm; ++round) {
    bool any = false;
    for (const auto& [irq, handler] : handlers_) {
      any = deliver(irq);
      if (any) break;
    }
    if (!any) return;
  }
  violate("interrupt storm: a handler doesn't clear its cause");
}

void Machine::settle() {
  if (!dirty_ || settling_) return;
  {
    const During settling(settling_);
    unsigned round = 0;
    while (dirty_) {
      dirty_ = false;
      if (!dark_) {
        while (serve_dma() && round < kStorm) ++round;
      }
      if (round >= kStorm) {
        violate("DMA serves a request for ever: PAR is not the data register it asks for");
        break;
      }
    }
    next_ = next_event();
  }
  dispatch_interrupts();
}

void Machine::attach(unsigned irq, std::function<void()> handler) {
  handlers_[irq] = std::move(handler);
  touch();
}

bool Machine::mask_interrupts() {
  const bool before = !masked_;
  masked_ = true;
  return before;
}
void Machine::unmask_interrupts() {
  masked_ = false;
  touch();
  settle();
}
void Machine::barrier() {
  rcc_->clocks_settled();
  access_begins();
}
void Machine::wait_for_interrupt() {
  settle();
  const Time limit = now_ + ms(1);  // the caller may wait for something else
  advance_to(std::min(limit, std::max(now_, next_)));
}

std::uint32_t Machine::map(const void* data, std::size_t size) {
  auto* bytes = static_cast<std::uint8_t*>(const_cast<void*>(data));
  for (Region& region : regions_) {
    if (bytes >= region.data && bytes + size <= region.data + region.size) {
      return region.address + static_cast<std::uint32_t>(bytes - region.data);
    }
  }
  // Keeps the alignment up to a cache line.
  const auto phase = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(bytes) % 32);
  const std::uint32_t address = next_region_ + phase;
  regions_.push_back({address, bytes, size});
  next_region_ = (address + static_cast<std::uint32_t>(size) + 63) & ~31u;
  return address;
}

std::uint8_t* Machine::memory(std::uint32_t address, unsigned width) {
  for (const Region& region : regions_) {
    if (address >= region.address && address - region.address + width <= region.size) {
      return region.data + (address - region.address);
    }
  }
  return nullptr;
}

void Machine::reset_banks(std::uint32_t reset_offset, std::uint32_t bits) {
  for (const auto& bank : banks_) {
    const Gate& gate = bank->gate();
    if (gate.enable_offset == reset_offset + 0x20 && (gate.reset_bit & bits) != 0) bank->reset();
  }
}

void Machine::reset(ResetCause cause) {
  clocks_change();
  for (const auto& bank : banks_) bank->reset();
  core_->reset();
  rcc_->flag_reset(cause);
  cycles_before_ = core_cycles();
  cycles_from_ = now_;
  masked_ = false;
  ++resets_;
  touch();
  if (reset_handler_) reset_handler_(cause);
}

void Machine::power_off() {
  dark_ = true;
}

void Machine::power_on() {
  dark_ = false;
  flash_->power_on();
  reset(ResetCause::kPowerOn);
}

}  // namespace verp::hal::stm32::model
