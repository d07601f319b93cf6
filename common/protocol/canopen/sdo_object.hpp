#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/dictionary.hpp"

namespace verp::canopen::sdo {

/// The object of a server's transfer. Small ones pass through a buffer, so they are read and
/// written whole; large ones go in pieces.
template <Dictionary D, std::size_t kBuffer>
class OpenObject {
  static_assert(kBuffer >= 8, "numbers go whole");

 public:
  explicit OpenObject(D& dictionary) : dictionary_(dictionary) {}

  Address at() const { return at_; }
  void close() { at_ = {}; }
  /// Size of an upload, or bytes downloaded so far.
  std::uint32_t size() const { return size_; }
  /// Size of an expedited download that does not give it.
  std::uint32_t implied_size() const { return entry_.max_size < 4 ? entry_.max_size : 4; }

  Abort open_read(Address at) {
    if (const Abort refused = find(at); refused != Abort::kNone) return refused;
    if (!entry_.readable) return Abort::kWriteOnly;
    size_ = entry_.size;
    pieces_ = size_ > kBuffer;
    return pieces_ ? Abort::kNone : dictionary_.read(at_, 0, buffer_, size_);
  }
  Abort load(std::uint32_t offset, std::uint8_t* to, std::uint32_t size) {
    if (pieces_) return dictionary_.read(at_, offset, to, size);
    for (std::uint32_t i = 0; i < size; ++i) to[i] = buffer_[offset + i];
    return Abort::kNone;
  }

  /// `given`: the client announced `size`.
  Abort open_write(Address at, bool given, std::uint32_t size) {
    if (const Abort refused = find(at); refused != Abort::kNone) return refused;
    if (!entry_.writable) return Abort::kReadOnly;
    pieces_ = entry_.max_size > kBuffer;
    if (pieces_ && !StreamingDictionary<D>) return Abort::kOutOfMemory;
    size_ = 0;
    announced_ = given;
    announced_size_ = size;
    return given ? check_size(size) : Abort::kNone;
  }
  Abort store(const std::uint8_t* data, std::uint32_t size) {
    if (size > entry_.max_size - size_) return Abort::kTooLong;
    Abort refused = Abort::kNone;
    if constexpr (StreamingDictionary<D>) {
      if (pieces_) refused = dictionary_.write_part(at_, size_, data, size);
    }
    if (!pieces_) {
      for (std::uint32_t i = 0; i < size; ++i) buffer_[size_ + i] = data[i];
    }
    size_ += size;
    return refused;
  }
  Abort commit() {
    if (announced_ && size_ != announced_size_) return Abort::kLength;
    if (const Abort refused = check_size(size_); refused != Abort::kNone) return refused;
    if constexpr (StreamingDictionary<D>) {
      if (pieces_) return dictionary_.write_done(at_, size_);
    }
    return dictionary_.write(at_, buffer_, size_);
  }

 private:
  Abort find(Address at) {
    at_ = at;
    entry_ = {};
    return dictionary_.find(at_, entry_);
  }
  Abort check_size(std::uint32_t size) const {
    if (size > entry_.max_size) return Abort::kTooLong;
    return size < entry_.min_size ? Abort::kTooShort : Abort::kNone;
  }

  D& dictionary_;
  Address at_;
  Entry entry_;
  bool pieces_ = false;
  bool announced_ = false;
  std::uint32_t size_ = 0;
  std::uint32_t announced_size_ = 0;
  std::uint8_t buffer_[kBuffer] = {};
};

}  // namespace verp::canopen::sdo
