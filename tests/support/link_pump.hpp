#pragma once
#include <concepts>
#include <cstdint>
#include <vector>

#include "hal/contract/byte_link.hpp"

namespace verp::bus {

/// Takes bytes, appends its answer.
template <class Server>
concept ByteServer = requires(Server& server, const std::uint8_t* bytes,
                              std::vector<std::uint8_t>& answer) {
  server.take({bytes, std::size_t{1}}, answer);
};

/// Passes a link's bytes to the server and the answers back.
template <std::derived_from<hal::ByteLink> Link, ByteServer Server>
class LinkPump {
 public:
  LinkPump(Link& link, Server& server) : link_(link), server_(server) {}

  /// Waits up to timeout_us. False if no bytes came.
  bool turn(std::uint32_t timeout_us) {
    std::uint8_t piece[4096];
    const std::size_t count = link_.read(piece, sizeof piece, timeout_us);
    if (count == 0) return false;
    answer_.clear();
    server_.take({piece, count}, answer_);
    const std::uint8_t* from = answer_.data();
    std::size_t size = answer_.size();
    // A peer that does not read will ask again.
    for (int i = 0; i < kPieces && size > 0; ++i) {
      const std::size_t written = link_.write(from, size, kPatience_us);
      from += written;
      size -= written;
      if (!link_.connected()) break;
    }
    return true;
  }

 private:
  static constexpr int kPieces = 20;
  static constexpr std::uint32_t kPatience_us = 50'000;
  Link& link_;
  Server& server_;
  std::vector<std::uint8_t> answer_;
};

}  // namespace verp::bus
