#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// A driver is a template over Io and holds one by value (`[[no_unique_address]] Io io_;`). On
/// silicon Io is the empty MemoryIo; in tests a handle to a model of the chip
/// (tests/support/stm32).
///
/// An Io promises, for addresses of the chip's memory map:
///  - read8/16/32(address), write8/16/32(address, value): one bus access of that width, in program
///    order. USART and SPI data and flash memory may have 8 or 16 bits.
///  - bus_address(data, size): the DMA controller's address. The memory stays there until the next
///    bus_address() of the same data.
///  - barrier(): completes earlier memory accesses before later ones begin (DSB).
///  - mask_interrupts(): true if they were enabled before. A matching unmask_interrupts() enables
///    them again.
///  - wait_for_interrupt(): returns when an enabled interrupt is pending; may return early.
namespace verp::hal::stm32 {

template <class Access>
concept Io = std::copyable<Access> &&
    requires(Access& io, std::uint32_t address, std::uint8_t byte, std::uint16_t half,
             std::uint32_t word, void* data, std::size_t size) {
  { io.read8(address) } -> std::same_as<std::uint8_t>;
  { io.read16(address) } -> std::same_as<std::uint16_t>;
  { io.read32(address) } -> std::same_as<std::uint32_t>;
  { io.write8(address, byte) } -> std::same_as<void>;
  { io.write16(address, half) } -> std::same_as<void>;
  { io.write32(address, word) } -> std::same_as<void>;
  { io.bus_address(data, size) } -> std::same_as<std::uint32_t>;
  { io.barrier() } -> std::same_as<void>;
  { io.mask_interrupts() } -> std::same_as<bool>;
  { io.unmask_interrupts() } -> std::same_as<void>;
  { io.wait_for_interrupt() } -> std::same_as<void>;
};

/// One read and one write. Not for registers whose flags are cleared by writing back what was read.
template <Io Access>
void modify32(Access& io, std::uint32_t address, std::uint32_t clear, std::uint32_t set) {
  io.write32(address, (io.read32(address) & ~clear) | set);
}

}  // namespace verp::hal::stm32
