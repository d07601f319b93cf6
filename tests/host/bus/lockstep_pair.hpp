#pragma once
#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "hal/contract/byte_link.hpp"
#include "host/twin/bus/lockstep_server.hpp"
#include "tests/support/link_faults.hpp"

/// A controller's link to a server in the same thread. A seeded generator loses, doubles or flips
/// bytes.
namespace verp::test {

class ServedLink final : public hal::ByteLink {
 public:
  explicit ServedLink(bus::LockstepServer& server) : server_(server) {}

  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t) override {
    if (cut) return 0;
    spoil({data, size}, to_server_, outbound);
    return size;
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t) override {
    if (to_client_.empty() && !cut) serve();
    const std::size_t count = std::min(capacity, to_client_.size());
    std::copy_n(to_client_.begin(), count, buffer);
    to_client_.erase(to_client_.begin(), to_client_.begin() + static_cast<std::ptrdiff_t>(count));
    if (count == 0) ++quiet_reads;
    return count;
  }
  bool connected() const override { return true; }
  hal::LinkErrors errors() const override { return {}; }
  void whisper(std::span<const std::uint8_t> bytes) {
    to_client_.insert(to_client_.end(), bytes.begin(), bytes.end());
  }

  LinkFaults outbound, inbound;
  bool cut = false;
  int cut_every = 0;  ///< after so many answers one is lost and the link cut
  std::uint64_t quiet_reads = 0;
  std::uint64_t faults = 0;

 private:
  template <class To>
  void spoil(std::span<const std::uint8_t> from, To& to, const LinkFaults& odds) {
    spoiler_.spoil(from, to, odds);
    faults = spoiler_.faults();
  }
  void serve() {
    std::vector<std::uint8_t> answer;
    server_.take(to_server_, answer);
    to_server_.clear();
    cut = !answer.empty() && cut_every > 0 && ++answers_ % cut_every == 0;
    if (!cut) spoil(answer, to_client_, inbound);
  }

  bus::LockstepServer& server_;
  std::vector<std::uint8_t> to_server_;
  std::deque<std::uint8_t> to_client_;
  LinkSpoiler spoiler_{1};
  int answers_ = 0;
};

/// Restores the link on each hundredth call.
struct Waiting {
  bool operator()() {
    ++calls;
    if (calls % 100 == 0 && mends) link->cut = false;
    return calls < most;
  }
  ServedLink* link;
  bool mends = true;
  std::uint64_t calls = 0;
  std::uint64_t most = ~std::uint64_t{0};
};

}  // namespace verp::test
