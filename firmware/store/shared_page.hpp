#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/base/crc32.hpp"
#include "common/base/fields.hpp"
#include "firmware/store/program_bytes.hpp"
#include "firmware/store/record.hpp"
#include "hal/contract/flash_pages.hpp"

/// Two images in one flash page, robot and actions, which can only be erased together. New contents
/// are first written to another page; a note in front of them completes the request. From then on
/// the copy home finishes despite power cuts, now or at the next start. Before that, home is
/// untouched.
namespace verp::store {

/// memory(page) is the page's address for the processor.
template <class Flash>
concept MappedPages = hal::FlashPages<Flash> && requires(const Flash& flash, std::size_t page) {
  { flash.memory(page) } -> std::same_as<const std::uint8_t*>;
};

/// The bytes of a page that count.
struct Layout {
  std::uint32_t first_bytes = 0;
  std::uint32_t second = 0;  ///< offset of the second image
  std::uint32_t second_bytes = 0;
  VERP_FIELDS(first_bytes, second, second_bytes)

  bool fits(std::size_t page_bytes) const {
    return first_bytes <= second && second <= page_bytes && second_bytes <= page_bytes - second;
  }
};

/// A note in front of the waiting contents, behind a log header (record.hpp).
struct WaitingNote {
  std::uint32_t magic = kMagic;
  Layout layout;
  std::uint32_t crc32 = 0;  ///< of magic and layout
  std::uint32_t crc32_inverse = 0;
  VERP_FIELDS(magic, layout, crc32, crc32_inverse)
  static constexpr std::uint32_t kMagic = 0x57505256;  ///< "VRPW"
};
VERP_PACKED(WaitingNote);

inline constexpr std::size_t kNoteAt = sizeof(PageHeader);
inline constexpr std::size_t kBehindNote = 64;
static_assert(kNoteAt + sizeof(WaitingNote) <= kBehindNote);

inline WaitingNote waiting_note(const Layout& layout) {
  WaitingNote note{.layout = layout};
  note.crc32 = crc32(&note, offsetof(WaitingNote, crc32));
  note.crc32_inverse = ~note.crc32;
  return note;
}

template <hal::FlashPages Flash, class Idle>
bool write_note(Flash& flash, std::size_t page, const WaitingNote& note, Idle&& idle) {
  return program_bytes(flash, page, kNoteAt, reinterpret_cast<const std::uint8_t*>(&note),
                       sizeof note, idle);
}

template <hal::FlashPages Flash>
bool read_note(const Flash& flash, std::size_t page, WaitingNote& note) {
  flash.read(page, kNoteAt, reinterpret_cast<std::uint8_t*>(&note), sizeof note);
  const WaitingNote right = waiting_note(note.layout);
  return __builtin_memcmp(&note, &right, sizeof note) == 0 &&
         note.layout.fits(flash.page_bytes(page) - kBehindNote);
}

/// Copies waiting contents from a page of `other` to page 0 of `home`. Takes seconds, in which the
/// processor may stall. True if anything waited: home has changed. The reader's CRC detects a
/// memory failure.
template <hal::FlashPages Home, MappedPages Other, class Idle>
bool finish_waiting(Home& home, Other& other, Idle&& idle) {
  for (std::size_t page = 0; page < 2; ++page) {
    WaitingNote note;
    if (!read_note(other, page, note)) continue;
    write_note(other, page, note, idle);  // a cut may have left it unsure
    const Layout& layout = note.layout;
    const std::uint8_t* from = other.memory(page) + kBehindNote;
    if (home.erase(0) && program_bytes(home, 0, 0, from, layout.first_bytes, idle)) {
      program_bytes(home, 0, layout.second, from + layout.second, layout.second_bytes, idle);
    }
    constexpr std::uint8_t kVoid[sizeof note] = {};
    program_bytes(other, page, kNoteAt, kVoid, sizeof kVoid, idle);
    return true;
  }
  return false;
}

/// New images wait in the page that FlashStore does not use. If the log needs it, they are lost.
template <MappedPages Home, MappedPages Other, class Log>
class WaitingRoom {
 public:
  /// The second image is at `second` in page 0 of `home`.
  WaitingRoom(Home& home, std::size_t second, std::size_t second_room, Other& other, Log& log)
      : home_(home), other_(other), log_(log), second_(second), second_room_(second_room) {}

  // The place of a new second image (app::ActionPlace).
  std::size_t room() const {
    const std::size_t most = other_.page_bytes(page_) - kBehindNote - second_;
    return second_room_ < most ? second_room_ : most;
  }
  const std::uint8_t* bytes() const { return other_.memory(page_) + kBehindNote + second_; }
  /// Makes room for a new image. Does not trust an erase before this start: power may have failed.
  void begin() {
    if (!log_.lent()) {
      page_ = log_.lend_spare();
      page_state_ = PageState::kUsed;
    }
    wanted_ = page_state_ == PageState::kUsed;
  }
  bool ready() const { return !wanted_; }
  /// Writes a block within the room, in any order, repeats allowed. False: the memory failed, or
  /// the log took the page.
  bool write(std::size_t offset, const std::uint8_t* from, std::size_t count) {
    const bool erased = page_state_ != PageState::kBad;
    page_state_ = PageState::kUsed;
    return erased && log_.lent() &&
           program_bytes(other_, page_, kBehindNote + second_ + offset, from, count, [] {});
  }
  /// Call regularly. Performs a wanted erase when torque is off, because it stops the processor.
  void work(bool may_erase) {
    if (!wanted_ || !may_erase) return;
    wanted_ = false;
    if (log_.lent()) erase();
  }

  /// Replaces the first image by `first`, unless nullptr, and the second by `taken` bytes of the
  /// one written here, unless 0; else `kept` bytes of it stay. Reset next: nothing else may run.
  /// False: home is unchanged.
  template <class Idle>
  bool replace(const std::uint8_t* first, std::size_t first_bytes, std::size_t taken,
               std::size_t kept, Idle&& idle) {
    const std::size_t second_bytes = taken > 0 ? taken : kept;
    const std::uint8_t* old = home_.memory(0);
    if (taken == 0 && !(begin(), page_state_ == PageState::kBlank || erase())) return false;
    page_state_ = PageState::kUsed;
    const auto put = [&](std::size_t at, const std::uint8_t* from, std::size_t size) {
      return program_bytes(other_, page_, kBehindNote + at, from, size, idle);
    };
    if (!log_.lent() || !put(0, first != nullptr ? first : old, first_bytes)) return false;
    if (taken == 0 && !put(second_, old + second_, second_bytes)) return false;
    const Layout layout{static_cast<std::uint32_t>(first_bytes),
                        static_cast<std::uint32_t>(second_),
                        static_cast<std::uint32_t>(second_bytes)};
    return write_note(other_, page_, waiting_note(layout), idle) &&
           finish_waiting(home_, other_, idle);
  }

 private:
  enum class PageState : std::uint8_t {
    kUsed,
    kBlank,  ///< erased and verified, not written
    kBad,    ///< erase failed
  };
  bool erase() {
    const bool good = Page<Other>(other_, page_).erase();
    page_state_ = good ? PageState::kBlank : PageState::kBad;
    return good;
  }

  Home& home_;
  Other& other_;
  Log& log_;
  std::size_t second_, second_room_;
  std::size_t page_ = 0;
  PageState page_state_ = PageState::kUsed;
  bool wanted_ = false;
};

}  // namespace verp::store
