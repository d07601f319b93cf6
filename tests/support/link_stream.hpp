#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "hal/contract/byte_link.hpp"

namespace verp::app {

/// A ByteLink as a stream of a RemoteBus, which waits without limit. A loss ends the stream: a peer
/// that returns knows nothing of it.
template <std::derived_from<hal::ByteLink> Link>
class LinkStream {
 public:
  explicit LinkStream(Link& link) : link_(&link), losses_(link.errors().losses) {}

  std::size_t read_some(void* data, std::size_t capacity) {
    while (whole()) {
      const std::size_t count =
          link_->read(static_cast<std::uint8_t*>(data), capacity, kPatience_us);
      if (count > 0) return count;
    }
    return 0;
  }

  bool write(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    while (size > 0 && whole()) {
      const std::size_t count = link_->write(bytes, size, kPatience_us);
      bytes += count;
      size -= count;
    }
    return size == 0;
  }

 private:
  static constexpr std::uint32_t kPatience_us = 100'000;
  bool whole() const { return link_->connected() && link_->errors().losses == losses_; }

  Link* link_;
  std::uint32_t losses_;  ///< when the stream began
};

}  // namespace verp::app
