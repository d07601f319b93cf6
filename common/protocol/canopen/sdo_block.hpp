#pragma once
#include <cstdint>

#include "common/protocol/canopen/sdo.hpp"

/// The two ends of a block transfer's data phase: the sender is the client of a download or the
/// server of an upload, the receiver the other one.
namespace verp::canopen::sdo {

/// Cuts an object into blocks of numbered segments and sends again what was not confirmed.
class BlockSender {
 public:
  constexpr BlockSender() = default;
  BlockSender(std::uint32_t size, std::uint8_t block) : size_(size), block_(block) {}

  /// True while segments of this block are to be sent; after it a response is due.
  bool sending() const { return sequence_ < block_ && !all_sent(); }

  /// The next segment; `read(offset, buffer, size)` gives its bytes and returns an Abort.
  template <class Read>
  Abort next(std::uint32_t id, Frame& frame, Read&& read) {
    const std::uint32_t offset = base_ + std::uint32_t{sequence_} * kSegmentBytes;
    const std::uint32_t left = size_ - offset;
    const std::uint32_t bytes = left < kSegmentBytes ? left : kSegmentBytes;
    ++sequence_;
    frame = bare(
        id, static_cast<std::uint8_t>(sequence_ | (left <= kSegmentBytes ? kLastOfBlocks : 0)));
    const Abort refused = read(offset, frame.data + 1, bytes);
    if (refused == Abort::kNone && offset == summed_) {  // a repeated segment is summed already
      crc_ = crc16(frame.data + 1, bytes, crc_);
      summed_ += bytes;
    }
    return refused;
  }

  /// A response: `sequence` segments have come, the next block is to have `block` of them.
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
  /// True when everything has been confirmed.
  bool done() const { return done_; }
  /// Bytes of the last segment that carry nothing.
  unsigned unused() const {
    if (size_ == 0) return kSegmentBytes;
    return (kSegmentBytes - size_ % kSegmentBytes) % kSegmentBytes;
  }
  std::uint16_t crc() const { return crc_; }

 private:
  /// An empty object has one segment, too.
  bool all_sent() const {
    return sequence_ > 0 && base_ + std::uint32_t{sequence_} * kSegmentBytes >= size_;
  }
  std::uint32_t size_ = 0;
  std::uint32_t base_ = 0;    ///< of this block's first byte
  std::uint32_t summed_ = 0;  ///< bytes that the CRC covers
  std::uint16_t crc_ = 0;
  std::uint8_t block_ = 0;
  std::uint8_t sequence_ = 0;  ///< of the segment sent last
  std::uint8_t idle_ = 0;
  bool done_ = false;
};

/// Takes segments in order and drops all others. The last segment is kept back: how many of its
/// bytes count is told at the end.
class BlockReceiver {
 public:
  enum class Take : std::uint8_t {
    kStray,    ///< not the next segment: no progress
    kMore,     ///< the block goes on
    kRespond,  ///< the sender waits for respond()
    kFailed,   ///< the store refused the bytes, see failure()
  };

  constexpr BlockReceiver() = default;
  explicit BlockReceiver(std::uint8_t block) : block_(block) {}

  /// Takes a segment; `store(data, size)` gets bytes in order and returns an Abort.
  template <class Store>
  Take take(const Frame& frame, Store&& store) {
    const auto sequence = static_cast<std::uint8_t>(frame.data[0] & 0x7F);
    const bool last = (frame.data[0] & kLastOfBlocks) != 0;
    const bool ends_block = last || sequence >= block_;
    // The sender waits after the block's end, even if segments before it were lost.
    if (complete_ || sequence != sequence_ + 1) return ends_block ? Take::kRespond : Take::kStray;
    if (!flush(kSegmentBytes, store)) return Take::kFailed;
    sequence_ = sequence;
    ++taken_;
    complete_ = last;
    held_ = true;
    for (unsigned i = 0; i < kSegmentBytes; ++i) tail_[i] = frame.data[1 + i];
    return ends_block ? Take::kRespond : Take::kMore;
  }

  /// The response's sequence number; the next block begins.
  std::uint8_t respond() {
    const std::uint8_t sequence = sequence_;
    if (!complete_) sequence_ = 0;
    return sequence;
  }
  /// True when the last segment has come.
  bool complete() const { return complete_; }
  std::uint8_t block() const { return block_; }
  /// Segments taken in all: it grows with progress only.
  std::uint32_t taken() const { return taken_; }

  /// The transfer's end: `unused` bytes of the last segment carry nothing.
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
  std::uint8_t sequence_ = 0;  ///< of the last segment in order
  std::uint16_t crc_ = 0;
  std::uint32_t taken_ = 0;
  Abort failure_ = Abort::kNone;
};

/// How long an end waits, in bus time: kTimeoutUs since the last progress. A receiver of blocks
/// reminds the sender halfway, because what was lost may be a block's last segment.
class Patience {
 public:
  void progress(std::uint64_t now_us) {
    since_us_ = now_us;
    reminded_ = false;
  }
  bool over(std::uint64_t now_us) const { return now_us >= since_us_ + kTimeoutUs; }
  /// True once for each silence.
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
