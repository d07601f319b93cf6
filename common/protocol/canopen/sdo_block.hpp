#pragma once
#include <cstdint>

#include "common/protocol/canopen/sdo.hpp"

/// A block transfer's data phase. Sender: client of a download or server of an upload.
namespace verp::canopen::sdo {

/// Repeats segments that were not confirmed.
class BlockSender {
 public:
  constexpr BlockSender() = default;
  BlockSender(std::uint32_t size, std::uint8_t block) : size_(size), block_(block) {}

  /// False: a response is due.
  bool sending() const { return sequence_ < block_ && !all_sent(); }

  /// `read(offset, buffer, size)` supplies bytes and returns an Abort.
  template <class Read>
  Abort next(std::uint32_t id, Frame& frame, Read&& read) {
    const std::uint32_t offset = base_ + std::uint32_t{sequence_} * kSegmentBytes;
    const std::uint32_t left = size_ - offset;
    const std::uint32_t bytes = left < kSegmentBytes ? left : kSegmentBytes;
    ++sequence_;
    frame = bare(
        id, static_cast<std::uint8_t>(sequence_ | (left <= kSegmentBytes ? kLastOfBlocks : 0)));
    const Abort refused = read(offset, frame.data + 1, bytes);
    if (refused == Abort::kNone && offset == summed_) {  // repeated ones are in the CRC
      crc_ = crc16(frame.data + 1, bytes, crc_);
      summed_ += bytes;
    }
    return refused;
  }

  /// `sequence` segments arrived; the next block has `block`.
  Abort confirm(std::uint8_t sequence, std::uint8_t block) {
    if (sequence > sequence_) return Abort::kSequence;
    if (block < 1 || block > kMaxBlock) return Abort::kBlockSize;
    idle_ = sequence == 0 ? static_cast<std::uint8_t>(idle_ + 1) : std::uint8_t{0};
    if (idle_ > kMaxIdleBlocks) return Abort::kSequence;
    done_ = sequence == sequence_ && all_sent();
    base_ += std::uint32_t{sequence} * kSegmentBytes;
    block_ = block;
    sequence_ = 0;
    return Abort::kNone;
  }
  bool done() const { return done_; }
  unsigned unused() const {
    if (size_ == 0) return kSegmentBytes;
    return (kSegmentBytes - size_ % kSegmentBytes) % kSegmentBytes;
  }
  std::uint16_t crc() const { return crc_; }

 private:
  /// An empty object has one segment.
  bool all_sent() const {
    return sequence_ > 0 && base_ + std::uint32_t{sequence_} * kSegmentBytes >= size_;
  }
  std::uint32_t size_ = 0;
  std::uint32_t base_ = 0;    ///< offset of this block's first byte
  std::uint32_t summed_ = 0;  ///< bytes in the CRC
  std::uint16_t crc_ = 0;
  std::uint8_t block_ = 0;
  std::uint8_t sequence_ = 0;  ///< last segment sent
  std::uint8_t idle_ = 0;
  bool done_ = false;
};

/// Takes segments in order, drops others. The last one waits for the end, which says how many of
/// its bytes count.
class BlockReceiver {
 public:
  enum class Take : std::uint8_t {
    kStray,  ///< out of order
    kMore,
    kRespond,  ///< the sender waits for respond()
    kFailed,   ///< the store refused, see failure()
  };

  constexpr BlockReceiver() = default;
  explicit BlockReceiver(std::uint8_t block) : block_(block) {}

  /// `store(data, size)` takes bytes in order and returns an Abort.
  template <class Store>
  Take take(const Frame& frame, Store&& store) {
    const auto sequence = static_cast<std::uint8_t>(frame.data[0] & 0x7F);
    const bool last = (frame.data[0] & kLastOfBlocks) != 0;
    const bool ends_block = last || sequence >= block_;
    // The sender waits now, even if segments were lost.
    if (complete_ || sequence != sequence_ + 1) return ends_block ? Take::kRespond : Take::kStray;
    if (!flush(kSegmentBytes, store)) return Take::kFailed;
    sequence_ = sequence;
    ++taken_;
    complete_ = last;
    held_ = true;
    for (unsigned i = 0; i < kSegmentBytes; ++i) tail_[i] = frame.data[1 + i];
    return ends_block ? Take::kRespond : Take::kMore;
  }

  /// The response's sequence number; starts the next block.
  std::uint8_t respond() {
    const std::uint8_t sequence = sequence_;
    if (!complete_) sequence_ = 0;
    return sequence;
  }
  bool complete() const { return complete_; }
  std::uint8_t block() const { return block_; }
  /// Segments taken in total: grows only with progress.
  std::uint32_t taken() const { return taken_; }

  /// `unused` bytes of the last segment do not count.
  template <class Store>
  Abort finish(unsigned unused, Store&& store) {
    return flush(kSegmentBytes - unused, store) ? Abort::kNone : failure_;
  }
  std::uint16_t crc() const { return crc_; }
  Abort failure() const { return failure_; }

 private:
  template <class Store>
  bool flush(unsigned bytes, Store&& store) {
    if (!held_) return true;
    held_ = false;
    crc_ = crc16(tail_, bytes, crc_);
    failure_ = store(static_cast<const std::uint8_t*>(tail_), bytes);
    return failure_ == Abort::kNone;
  }
  std::uint8_t tail_[kSegmentBytes] = {};
  bool held_ = false;
  bool complete_ = false;
  std::uint8_t block_ = 0;
  std::uint8_t sequence_ = 0;  ///< last segment in order
  std::uint16_t crc_ = 0;
  std::uint32_t taken_ = 0;
  Abort failure_ = Abort::kNone;
};

/// kTimeoutUs of bus time without progress. A block receiver reminds the sender halfway, in case
/// the last segment was lost.
class Patience {
 public:
  void progress(std::uint64_t now_us) {
    since_us_ = now_us;
    reminded_ = false;
  }
  bool over(std::uint64_t now_us) const { return now_us >= since_us_ + kTimeoutUs; }
  /// True once per silence.
  bool remind(std::uint64_t now_us) {
    if (reminded_ || now_us < since_us_ + kTimeoutUs / 2) return false;
    reminded_ = true;
    return true;
  }

 private:
  std::uint64_t since_us_ = 0;
  bool reminded_ = false;
};

}  // namespace verp::canopen::sdo
