#pragma once
#include <cstddef>
#include <cstdint>

#include "firmware/store/record.hpp"
#include "hal/contract/flash_pages.hpp"
#include "hal/contract/store.hpp"

/// A board's Store: a log in one of two flash pages. When it is full, the live values move to the
/// other page; its header, written last, completes the change.
///
/// Power cuts: only the last unit written can be unsure. open() settles it before any read: a
/// complete last record is programmed again, which makes it firm; an incomplete one is zeroed from
/// its end. The slot behind the log may only look erased, so the first append skips it. An invalid
/// page's header is spoilt until the page is erased.
namespace verp::store {

/// One work() programs at most kSlotsPerWork * kSlot bytes, plus four slots at a page change, or
/// one record after a failed write. Capacity: kMaxKeys values of up to kMaxValue bytes; together,
/// the smaller page less two records.
template <hal::FlashPages Flash, std::size_t kMaxKeys = 32, std::size_t kMaxValue = 256,
          std::size_t kSlotsPerWork = 4>
class FlashStore {
 public:
  explicit FlashStore(Flash& flash) : page_{Page<Flash>(flash, 0), Page<Flash>(flash, 1)} {}

  /// Call first, once. Settles a power cut, which may program a record; erases nothing. Pages
  /// without a log are an empty store.
  void open() {
    const PageHeader header[2] = {page_[0].header(), page_[1].header()};
    const bool valid[2] = {is_valid(header[0]), is_valid(header[1])};
    if (!valid[0] && !valid[1]) return;
    active_ = valid[1] && (!valid[0] || header[1].sequence > header[0].sequence) ? 1 : 0;
    sequence_ = header[active_].sequence;
    page_[active_].make_firm(0);
    page_[active_].make_firm(kSlot);
    page_[1 - active_].spoil_header();
    scan();
    tail_unsure_ = true;
    // A slot that reads erased now may read as a value later.
    if (Flash::kUnit == kSlot && tail_ < page_[active_].bytes()) give_tail_slot_up();
  }

  // Store
  std::size_t get(std::uint16_t key, std::uint8_t* to, std::size_t capacity) const {
    const std::size_t i = find(key);
    if (i == count_) return 0;
    const Entry& entry = entry_[i];
    const std::size_t size = entry.size < capacity ? entry.size : capacity;
    page_[active_].read(entry.offset + sizeof(RecordHeader), to, size);
    return entry.size;
  }

  hal::PutResult put(std::uint16_t key, const std::uint8_t* from, std::size_t size) {
    if (key == 0 || key == hal::kNoKey) return hal::PutResult::kBadKey;
    if (pending_) return hal::PutResult::kBusy;
    if (size > kMaxValue || !has_room(key, size)) return hal::PutResult::kNoRoom;
    if (is_there(key, from, size)) return hal::PutResult::kAccepted;
    RecordHeader header{.key = key, .size = static_cast<std::uint16_t>(size)};
    header.crc32 = crc32(from, size, begin_crc(header));
    __builtin_memset(image_, 0xFF, sizeof image_);
    __builtin_memcpy(image_, &header, sizeof header);
    if (size > 0) __builtin_memcpy(image_ + sizeof header, from, size);
    pending_ = true;
    failures_ = 0;
    written_ = 0;
    return hal::PutResult::kAccepted;
  }

  hal::WorkState work(bool may_erase) {
    if (moving_) return move();
    if (!pending_) {
      return may_erase && worth_moving() ? begin_move(true) : hal::WorkState::kIdle;
    }
    return written_ > 0 || fits() ? append() : begin_move(may_erase);
  }

  /// Lends the page without the log while lent() is true; work() takes it back when the log needs
  /// it.
  std::size_t lend_spare() {
    while (moving_) move();
    other_erased_ = false;
    lent_ = true;
    return other();
  }
  bool lent() const { return lent_; }
  /// Damaged records that open() found: the flash lost bits. Their keys have older values or none.
  std::uint32_t damaged() const { return damaged_; }
  /// Bytes left before the next erase.
  std::size_t free_bytes() const { return active_ == kNone ? 0 : page_[active_].bytes() - tail_; }

 private:
  static constexpr std::size_t kNone = 2;
  static constexpr std::size_t kFirst = sizeof(PageHeader);  ///< offset of the first record
  static constexpr int kMostFailures = 3;
  struct Entry {
    std::uint16_t key;
    std::uint16_t size;
    std::uint32_t offset;
  };

  static std::size_t record_size(const Entry& entry) { return record_bytes(entry.size); }
  std::size_t find(std::uint16_t key) const {
    std::size_t i = 0;
    while (i < count_ && entry_[i].key != key) ++i;
    return i;
  }
  std::size_t live_bytes() const {
    std::size_t bytes = kFirst;
    for (std::size_t i = 0; i < count_; ++i) bytes += record_size(entry_[i]);
    return bytes;
  }
  /// Old and new value must fit one page; removing a key always fits.
  bool has_room(std::uint16_t key, std::size_t size) const {
    if (size == 0) return true;
    if (find(key) == kMaxKeys) return false;
    const std::size_t least = page_[0].bytes() < page_[1].bytes() ? 0 : 1;
    return live_bytes() + record_bytes(size) + record_bytes(0) <= page_[least].bytes();
  }
  bool is_there(std::uint16_t key, const std::uint8_t* value, std::size_t size) const {
    const std::size_t i = find(key);
    if (i == count_) return size == 0;
    if (entry_[i].size != size) return false;
    for (std::size_t at = 0; at < size; ++at) {
      std::uint8_t byte = 0;
      page_[active_].read(entry_[i].offset + sizeof(RecordHeader) + at, &byte, 1);
      if (byte != value[at]) return false;
    }
    return true;
  }
  /// Makes the record at `offset` the value of its key.
  void note(const RecordHeader& header, std::size_t offset) {
    const std::size_t i = find(header.key);
    if (header.size == 0) {
      if (i < count_) entry_[i] = entry_[--count_];
    } else if (i == kMaxKeys) {
      ++damaged_;
    } else {
      entry_[i] = {header.key, header.size, static_cast<std::uint32_t>(offset)};
      if (i == count_) ++count_;
    }
  }

  void scan() {
    const Page<Flash>& page = page_[active_];
    tail_ = page.bytes();
    while (tail_ > kFirst && page.slot_is(tail_ - kSlot, 0xFF)) tail_ -= kSlot;
    std::size_t at = kFirst;
    std::size_t garbage = 0;  // begin of invalid data; 0: none
    std::size_t last = kFirst;
    std::size_t last_end = kFirst;
    while (at < tail_) {
      RecordHeader header;
      if (page.slot_is(at, 0)) {
        at += kSlot;
      } else if (page.record_at(at, kMaxValue, header)) {
        if (garbage != 0) ++damaged_;
        garbage = 0;
        note(header, at);
        last = at;
        at += record_bytes(header.size);
        last_end = at;
      } else {
        if (garbage == 0) garbage = at;
        at += kSlot;
      }
    }
    if (garbage != 0) {
      page.make_void(garbage, tail_);
      return;
    }
    tail_ = at;
    if (last_end < tail_) last = tail_ - kSlot;  // a void slot ends the log
    for (; last < tail_; last += kSlot) page.make_firm(last);
  }
  void give_tail_slot_up() {
    page_[active_].make_void(tail_);
    tail_ += kSlot;
    tail_unsure_ = false;
  }

  RecordHeader pending_header() const {
    RecordHeader header;
    __builtin_memcpy(&header, image_, sizeof header);
    return header;
  }
  bool fits() const {
    return active_ != kNone &&
           tail_ + (tail_unsure_ ? kSlot : 0) + record_bytes(pending_header().size) <=
               page_[active_].bytes();
  }

  hal::WorkState append() {
    const Page<Flash>& page = page_[active_];
    std::size_t budget = kSlotsPerWork;
    if (tail_unsure_) {
      give_tail_slot_up();
      --budget;
    }
    RecordHeader header = pending_header();
    const std::size_t size = record_bytes(header.size);
    bool good = true;
    for (; good && budget > 0 && written_ < size; --budget, written_ += kSlot) {
      good = page.program(tail_ + written_, image_ + written_);
    }
    if (good && written_ < size) return hal::WorkState::kWorking;
    if (good && page.record_at(tail_, kMaxValue, header)) {
      note(header, tail_);
      tail_ += size;
      pending_ = false;
      return hal::WorkState::kIdle;
    }
    page.make_void(tail_, tail_ + size);
    tail_ += size;
    written_ = 0;
    return failed();
  }

  /// Counts a failure; after kMostFailures it drops the new value.
  hal::WorkState failed() {
    if (++failures_ < kMostFailures) return hal::WorkState::kWorking;
    pending_ = false;
    return hal::WorkState::kFailed;
  }

  // When idle with torque off: moves a nearly full page, so that an update while walking finds
  // room.
  bool worth_moving() const {
    if (active_ == kNone || failures_ >= kMostFailures) return false;
    const std::size_t quarter = page_[active_].bytes() / 4;
    return free_bytes() < quarter && tail_ - live_bytes() >= quarter;
  }

  std::size_t other() const { return active_ == 0 ? 1 : 0; }

  hal::WorkState begin_move(bool may_erase) {
    if (!other_erased_) {
      if (!may_erase) return hal::WorkState::kNeedsErase;
      lent_ = false;
      other_erased_ = page_[other()].erase();
      return other_erased_ ? hal::WorkState::kWorking : failed();
    }
    other_erased_ = false;
    moving_ = true;
    moved_ = 0;
    copied_ = 0;
    move_tail_ = kFirst;
    return hal::WorkState::kWorking;
  }

  hal::WorkState move() {
    const Page<Flash>& to = page_[other()];
    for (std::size_t budget = kSlotsPerWork; budget > 0 && moved_ < count_; --budget) {
      std::uint8_t slot[kSlot] = {};
      page_[active_].read(entry_[moved_].offset + copied_, slot, kSlot);
      bool good = to.program(move_tail_ + copied_, slot);
      copied_ += kSlot;
      if (good && copied_ < record_size(entry_[moved_])) continue;
      RecordHeader header;
      if (!good || !to.record_at(move_tail_, kMaxValue, header)) return give_move_up();
      new_offset_[moved_++] = static_cast<std::uint32_t>(move_tail_);
      move_tail_ += copied_;
      copied_ = 0;
    }
    if (moved_ < count_) return hal::WorkState::kWorking;
    if (!to.program_header(sequence_ + 1) || !is_valid(to.header())) return give_move_up();
    end_move();
    return pending_ ? hal::WorkState::kWorking : hal::WorkState::kIdle;
  }

  hal::WorkState give_move_up() {
    moving_ = false;
    page_[other()].spoil_header();
    return failed();
  }

  void end_move() {
    if (active_ != kNone) page_[active_].spoil_header();
    active_ = other();
    ++sequence_;
    for (std::size_t i = 0; i < count_; ++i) entry_[i].offset = new_offset_[i];
    tail_ = move_tail_;
    tail_unsure_ = false;
    moving_ = false;
  }

  Page<Flash> page_[2];
  std::size_t active_ = kNone;
  std::uint32_t sequence_ = 0;
  std::size_t tail_ = 0;
  std::size_t count_ = 0;
  std::uint32_t damaged_ = 0;
  int failures_ = 0;
  bool tail_unsure_ = false;   ///< a power cut may have hit tail_
  bool other_erased_ = false;  ///< this session, verified
  bool pending_ = false;
  bool moving_ = false;
  bool lent_ = false;
  std::size_t written_ = 0;    ///< bytes of the pending record
  std::size_t moved_ = 0;      ///< entries
  std::size_t copied_ = 0;     ///< bytes of the next entry
  std::size_t move_tail_ = 0;  ///< in the other page
  Entry entry_[kMaxKeys] = {};
  std::uint32_t new_offset_[kMaxKeys] = {};
  std::uint8_t image_[record_bytes(kMaxValue)] = {};
};

}  // namespace verp::store
