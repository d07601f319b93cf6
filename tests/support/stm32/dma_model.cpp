#include "tests/support/stm32/dma_model.hpp"

#include <algorithm>
#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/registers/dma_requests.hpp"
#include "tests/support/stm32/registers/dma_table.hpp"

namespace verp::hal::stm32::model {

using namespace dma;

namespace {

constexpr std::uint32_t kInterruptEnables = kCrDmeie | kCrTeie | kCrHtie | kCrTcie;

unsigned width(std::uint32_t cr, std::uint32_t mask, unsigned shift) {
  return 1u << ((cr & mask) >> shift);
}

}  // namespace

DmaModel::DmaModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate)
    : Bank(machine, "DMA" + std::to_string(number), base, dma::kTable, gate), number_(number) {
  for (unsigned stream = 0; stream < kStreams; ++stream) {
    add_registers(dma::kStreamTable, stream * kStreamStep);
  }
}

void DmaModel::reset() {
  Bank::reset();
  for (Stream& stream : streams_) stream = {};
}

void DmaModel::flag(unsigned stream, std::uint32_t flags) {
  set(status_offset(stream), flags << flag_shift(stream));
  machine().touch();
}

void DmaModel::stop(unsigned stream) {
  if (!script[stream].enable_stuck) clear(at(kCr, stream), kCrEn);
  streams_[stream].off_at = kNever;
  streams_[stream].ending = script[stream].enable_stuck;
}

Time DmaModel::next() const {
  Time when = kNever;
  for (const Stream& stream : streams_) when = std::min(when, stream.off_at);
  return when;
}

void DmaModel::run() {
  for (unsigned stream = 0; stream < kStreams; ++stream) {
    if (streams_[stream].off_at > machine().now()) continue;
    stop(stream);
    // RM0090 10.3.14: TCIF shows the end of a suspended transfer.
    flag(stream, kFlagTc);
  }
}

bool DmaModel::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (offset < kCr) return true;
  const unsigned stream = (offset - kCr) / kStreamStep;
  const std::uint32_t which = offset - stream * kStreamStep;
  if (!has(at(kCr, stream), kCrEn)) return true;
  const std::uint32_t changes = raw ^ peek(offset);
  const std::uint32_t free = which == kCr ? kCrEn | kInterruptEnables | kCrCt : 0;
  if ((changes & ~free) == 0) return true;
  violate("stream " + std::to_string(stream) + " changed while EN is set");
  return false;
}

void DmaModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == kLifcr || offset == kHifcr) {
    clear(offset - kLifcr + kLisr, raw);
    return;
  }
  if (offset < kCr) return;
  const unsigned stream = (offset - kCr) / kStreamStep;
  if (offset == at(kCr, stream)) control_written(stream, old);
}

void DmaModel::control_written(unsigned stream, std::uint32_t old) {
  const bool was = (old & kCrEn) != 0;
  const bool now = has(at(kCr, stream), kCrEn);
  if (!was && now) start(stream);
  if (!was || now || streams_[stream].ending) {
    if (was && !now) set(at(kCr, stream), kCrEn);
    return;
  }
  set(at(kCr, stream), kCrEn);  // until the hardware follows
  streams_[stream].ending = true;
  if (!script[stream].enable_stuck) {
    streams_[stream].off_at = machine().now() + script[stream].disable_time;
  }
}

void DmaModel::start(unsigned stream) {
  const std::uint32_t cr = reg(at(kCr, stream));
  const std::string who = "stream " + std::to_string(stream);
  if (((reg(status_offset(stream)) >> flag_shift(stream)) & kFlagAll) != 0) {
    violate(who + " enabled before its flags were cleared");
  }
  if ((cr & kCrDbm) != 0 || (cr & kCrDir) == kCrDir || (cr & kCrDir) == bit(7)) {
    violate(who + ": double buffer and memory to memory are not modelled");
  }
  if ((cr & kCrPsize) != (cr & kCrMsize) && !has(at(kFcr, stream), kFcrDmdis)) {
    violate(who + ": different PSIZE and MSIZE need the FIFO");
  }
  streams_[stream].loaded = reg(at(kNdtr, stream));
  streams_[stream].ending = false;
  if (streams_[stream].loaded == 0) {
    violate(who + " enabled with NDTR 0");
    stop(stream);
  }
}

bool DmaModel::serve() {
  bool any = false;
  for (unsigned stream = 0; stream < kStreams; ++stream) any = serve(stream) || any;
  return any;
}

bool DmaModel::serve(unsigned stream) {
  if (!active(stream)) return false;
  const std::uint32_t cr = reg(at(kCr, stream));
  const bool transmit = (cr & kCrDir) == kCrDirToPeripheral;
  for (const Request& request : kRequests) {
    if (request.controller != number_ || request.stream != stream ||
        request.channel != (cr & kCrChsel) >> kCrChselShift || request.transmit != transmit) {
      continue;
    }
    for (const auto& bank : machine().banks()) {
      if (bank->base() != request.peripheral || !bank->dma_request(transmit)) continue;
      transfer(stream);
      return true;
    }
  }
  return false;
}

void DmaModel::transfer(unsigned stream) {
  Stream& state = streams_[stream];
  const std::uint32_t cr = reg(at(kCr, stream));
  const unsigned size = width(cr, kCrPsize, 11);
  const std::uint32_t index = state.loaded - reg(at(kNdtr, stream));
  const std::uint32_t memory_address =
      reg(at(kM0ar, stream)) + ((cr & kCrMinc) != 0 ? index * size : 0);
  const std::uint32_t port = reg(at(kPar, stream)) + ((cr & kCrPinc) != 0 ? index * size : 0);
  std::uint8_t* memory = machine().memory(memory_address, size);
  if (memory == nullptr || script[stream].fail_after == 0) {
    if (memory == nullptr) violate("stream " + std::to_string(stream) + ": no memory there");
    script[stream].fail_after = ~0u;
    stop(stream);
    return flag(stream, kFlagTe);
  }
  if (script[stream].fail_after != ~0u) --script[stream].fail_after;
  if ((cr & kCrDir) == kCrDirToPeripheral) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < size; ++i) value |= static_cast<std::uint32_t>(memory[i]) << (8 * i);
    machine().bus_write(port, value, size);
  } else {
    const std::uint32_t value = machine().bus_read(port, size);
    for (unsigned i = 0; i < size; ++i) memory[i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
  ++state.transfers;
  count_down(stream);
}

void DmaModel::count_down(unsigned stream) {
  Stream& state = streams_[stream];
  std::uint32_t& left = reg(at(kNdtr, stream));
  --left;
  if (left == state.loaded - state.loaded / 2 && state.loaded > 1) flag(stream, kFlagHt);
  if (left > 0) return;
  flag(stream, kFlagTc);
  if (has(at(kCr, stream), kCrCirc)) {
    left = state.loaded;
  } else {
    stop(stream);
  }
}

bool DmaModel::interrupt(unsigned irq) const {
  for (unsigned stream = 0; stream < kStreams; ++stream) {
    if (irq != (number_ == 1 ? irq::dma1(stream) : irq::dma2(stream))) continue;
    const std::uint32_t flags = reg(status_offset(stream)) >> flag_shift(stream);
    const std::uint32_t cr = reg(at(kCr, stream));
    return ((cr & kCrTcie) != 0 && (flags & kFlagTc) != 0) ||
           ((cr & kCrHtie) != 0 && (flags & kFlagHt) != 0) ||
           ((cr & kCrTeie) != 0 && (flags & kFlagTe) != 0) ||
           ((cr & kCrDmeie) != 0 && (flags & kFlagDme) != 0) ||
           (has(at(kFcr, stream), kFcrFeie) && (flags & kFlagFe) != 0);
  }
  return false;
}

}  // namespace verp::hal::stm32::model
