#include <algorithm>
#include <utility>

#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {
namespace {

/// Longest pause within a packet; an estimate, the vendor documents none.
constexpr std::uint64_t kPause_ns = 100'000'000;

}  // namespace

void VirtualBus::set_baud(std::uint32_t baud) {
  if (baud == 0 || baud == baud_) return;
  baud_ = baud;
  replies_.clear();
  words_->forget();
}

void VirtualBus::begin_time() {
  held_ = false;
  replies_.clear();
  words_->forget();
  now_ns_ = wire_free_ns_ = asked_ns_ = master_free_ns_ = send_start_ns_ = 0;
  for (const auto& each : devices_) each->heard(0);
}

bool VirtualBus::torque_on() const {
  return std::any_of(devices_.begin(), devices_.end(),
                     [](const auto& each) { return each->torque_on(); });
}

std::size_t VirtualBus::unsent() const {
  return master_free_ns_ <= now_ns_
             ? 0
             : static_cast<std::size_t>((master_free_ns_ - now_ns_) / bytes_ns(1));
}

// A device that owes an answer is deaf; if two transmit, both are lost (collision.hpp).
bool VirtualBus::jams(std::uint8_t byte, std::uint64_t start_ns, std::uint64_t end_ns) {
  bool any = false;
  for (Chunk& each : replies_) {
    const std::uint64_t over_ns = each.start_ns + bytes_ns(each.bytes.size());
    if (each.echo || end_ns <= each.asked_ns || start_ns >= over_ns) continue;
    any = true;
    for (std::size_t i = each.taken; i < each.bytes.size(); ++i) {
      const std::uint64_t at_ns = each.start_ns + bytes_ns(i);
      if (end_ns > at_ns && start_ns < at_ns + bytes_ns(1)) each.bytes[i] &= byte;
    }
  }
  return any;
}

void VirtualBus::talk(const std::uint8_t* data, std::size_t size) {
  bytes_on_wire_ += size;
  send_start_ns_ = std::max(now_ns_, master_free_ns_);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t start_ns = std::max(now_ns_, master_free_ns_);
    if (start_ns > master_free_ns_ + kPause_ns) words_->forget();
    master_free_ns_ = start_ns + bytes_ns(1);
    const bool jammed = jams(data[i], start_ns, master_free_ns_);
    if (jammed && !std::exchange(jammed_, true)) ++lost_requests_;
    if (jammed) {
      words_->jam();
      continue;
    }
    jammed_ = false;
    words_->watch_header(data[i]);
    for (bool found = words_->push(data[i]); found; found = words_->next()) {
      wire_free_ns_ = master_free_ns_;
      // A new packet cancels remaining answers to a broadcast Ping.
      std::erase_if(replies_, [this](const Chunk& each) {
        return !each.echo && each.asked_ns > master_free_ns_;
      });
      words_->handle(master_free_ns_);
    }
  }
  sent({data, size}, send_start_ns_);
}

}  // namespace verp::bus
