#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/byte_link.hpp"

/// Two ByteLinks in one thread, each the other's far end. Nothing else runs while a call waits, so
/// a wait only advances the wire's clock.
namespace verp::hal {

class MemoryWire;

class MemoryLink final : public ByteLink {
 public:
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us) override;
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override;
  bool connected() const override { return connected_; }
  LinkErrors errors() const override { return errors_; }

 private:
  friend class MemoryWire;
  MemoryLink(MemoryWire& wire, MemoryLink& far) : wire_(wire), far_(far) {}
  void look();

  static constexpr std::size_t kBytes = 256;
  MemoryWire& wire_;
  MemoryLink& far_;
  LinkErrors errors_;
  bool connected_ = true;
  std::size_t first_ = 0;  ///< first byte that waits for read()
  std::size_t count_ = 0;
  std::uint8_t waiting_[kBytes] = {};
};

class MemoryWire {
 public:
  MemoryLink& left() { return left_; }
  MemoryLink& right() { return right_; }
  void cut() { whole_ = false; }
  void mend() { whole_ = true; }
  bool whole() const { return whole_; }
  static void spoil_framing(MemoryLink& link) { ++link.errors_.framing; }
  static void spoil_noise(MemoryLink& link) { ++link.errors_.noise; }
  std::uint64_t now_us() const { return now_us_; }

 private:
  friend class MemoryLink;
  bool whole_ = true;
  std::uint64_t now_us_ = 0;
  MemoryLink left_{*this, right_};
  MemoryLink right_{*this, left_};
};

inline void MemoryLink::look() {
  if (connected_ && !wire_.whole() && count_ == 0) {
    connected_ = false;
    ++errors_.losses;
  } else if (!connected_ && wire_.whole()) {
    connected_ = true;
  }
}

inline std::size_t MemoryLink::write(const std::uint8_t* data, std::size_t size,
                                     std::uint32_t timeout_us) {
  const bool was_connected = connected_;
  look();
  std::size_t taken = 0;
  while (wire_.whole() && taken < size && far_.count_ < kBytes) {
    far_.waiting_[(far_.first_ + far_.count_++) % kBytes] = data[taken++];
  }
  if (taken < size && connected_ == was_connected) wire_.now_us_ += timeout_us;
  return taken;
}

inline std::size_t MemoryLink::read(std::uint8_t* buffer, std::size_t capacity,
                                    std::uint32_t timeout_us) {
  const bool was_connected = connected_;
  look();
  std::size_t stored = 0;
  for (; stored < capacity && count_ > 0; --count_) {
    buffer[stored++] = waiting_[first_];
    first_ = (first_ + 1) % kBytes;
  }
  if (stored == 0 && capacity > 0 && connected_ == was_connected) wire_.now_us_ += timeout_us;
  return stored;
}

}  // namespace verp::hal
