#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/crc32.hpp"
#include "common/base/fields.hpp"
#include "hal/contract/flash_pages.hpp"

/// Page layout in slots of kSlot bytes: two slots of PageHeader, then records: RecordHeader and the
/// value, padded with 0xFF. A zero slot is void. Little-endian.
namespace verp::store {

inline constexpr std::size_t kSlot = 8;  ///< largest programming unit, bytes

/// A page with a correct header is valid; of two, the higher sequence wins.
struct PageHeader {
  std::uint32_t magic = kMagic;
  std::uint32_t sequence = 0;  ///< increases by one with each new page
  std::uint32_t crc32 = 0;     ///< of magic and sequence
  std::uint32_t crc32_inverse = 0;
  VERP_FIELDS(magic, sequence, crc32, crc32_inverse)
  static constexpr std::uint32_t kMagic = 0x53505256;  ///< "VRPS"
};
VERP_PACKED(PageHeader);

inline PageHeader page_header(std::uint32_t sequence) {
  PageHeader header{.sequence = sequence};
  header.crc32 = crc32(&header, offsetof(PageHeader, crc32));
  header.crc32_inverse = ~header.crc32;
  return header;
}

inline bool is_valid(const PageHeader& header) {
  const PageHeader right = page_header(header.sequence);
  return header.magic == right.magic && header.crc32 == right.crc32 &&
         header.crc32_inverse == right.crc32_inverse;
}

struct RecordHeader {
  std::uint16_t key = 0;
  std::uint16_t size = 0;   ///< bytes; 0 removes the key
  std::uint32_t crc32 = 0;  ///< of key, size and value
  VERP_FIELDS(key, size, crc32)
};
VERP_PACKED(RecordHeader);
static_assert(sizeof(RecordHeader) == kSlot && sizeof(PageHeader) == 2 * kSlot);

constexpr std::size_t slots_bytes(std::size_t bytes) {
  return (bytes + kSlot - 1) / kSlot * kSlot;
}
/// Page bytes of a value, with header and padding.
constexpr std::size_t record_bytes(std::size_t size) {
  return sizeof(RecordHeader) + slots_bytes(size);
}
inline std::uint32_t begin_crc(const RecordHeader& header) {
  return crc32(&header, offsetof(RecordHeader, crc32));
}

inline bool is_all(const std::uint8_t* slot, std::uint8_t byte) {
  for (std::size_t i = 0; i < kSlot; ++i) {
    if (slot[i] != byte) return false;
  }
  return true;
}

template <hal::FlashPages Flash>
class Page {
 public:
  Page(Flash& flash, std::size_t number) : flash_(&flash), number_(number) {}
  std::size_t number() const { return number_; }
  std::size_t bytes() const { return flash_->page_bytes(number_); }

  void read(std::size_t offset, void* to, std::size_t size) const {
    flash_->read(number_, offset, static_cast<std::uint8_t*>(to), size);
  }
  bool slot_is(std::size_t offset, std::uint8_t byte) const {
    std::uint8_t slot[kSlot] = {};
    read(offset, slot, kSlot);
    return is_all(slot, byte);
  }
  /// Skips erased units. False: the flash failed.
  bool program(std::size_t offset, const std::uint8_t* slot) const {
    for (std::size_t i = 0; i < kSlot; i += Flash::kUnit) {
      bool blank = true;
      for (std::size_t k = 0; k < Flash::kUnit; ++k) blank = blank && slot[i + k] == 0xFF;
      if (!blank && !flash_->program(number_, offset + i, slot + i)) return false;
    }
    return true;
  }
  bool make_void(std::size_t offset) const {
    constexpr std::uint8_t kZeros[kSlot] = {};
    return program(offset, kZeros);
  }
  /// Goes backwards, so that a cut leaves no header of a half-erased record.
  void make_void(std::size_t from, std::size_t to) const {
    while (to > from) make_void(to -= kSlot);
  }
  /// Programs the contents again: a cut slot keeps what it reads now.
  bool make_firm(std::size_t offset) const {
    std::uint8_t slot[kSlot] = {};
    read(offset, slot, kSlot);
    return program(offset, slot);
  }
  bool erase() const {
    if (!flash_->erase(number_)) return false;
    for (std::size_t at = 0; at < bytes(); at += kSlot) {
      if (!slot_is(at, 0xFF)) return false;
    }
    return true;
  }

  PageHeader header() const {
    PageHeader header;
    read(0, &header, sizeof header);
    return header;
  }
  bool program_header(std::uint32_t sequence) const {
    const PageHeader header = page_header(sequence);
    std::uint8_t slots[sizeof header];
    __builtin_memcpy(slots, &header, sizeof header);
    return program(0, slots) && program(kSlot, slots + kSlot);
  }
  /// Invalidates the header, also where it reads as erased.
  void spoil_header() const {
    make_void(kSlot);
    make_void(0);
  }

  /// True if a complete record of at most `max_value` bytes begins at `offset`.
  bool record_at(std::size_t offset, std::size_t max_value, RecordHeader& header) const {
    read(offset, &header, sizeof header);
    if (header.key == 0 || header.size > max_value ||
        offset + record_bytes(header.size) > bytes()) {
      return false;
    }
    std::uint32_t crc = begin_crc(header);
    std::uint8_t slot[kSlot] = {};
    for (std::size_t done = 0; done < header.size; done += kSlot) {
      const std::size_t part = header.size - done < kSlot ? header.size - done : kSlot;
      read(offset + sizeof header + done, slot, part);
      crc = crc32(slot, part, crc);
    }
    return crc == header.crc32;
  }

 private:
  Flash* flash_;
  std::size_t number_;
};

}  // namespace verp::store
