#include "host/run/shadow/tick_port.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "firmware/app/register_image.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::shadow {
namespace {

using app::reg;

constexpr int kAttempts = 3;
constexpr std::uint64_t kPatience_ns = 100'000'000;  // the loop answers when idle
constexpr std::uint32_t kSlice_us = 5'000;
constexpr std::uint32_t kQuiet_us = 20'000;
/// Image blocks per exchange, limited by the requests that a board's port can buffer.
constexpr int kBlocksAtOnce = 2;

}  // namespace

void TickPort::add_read(std::uint16_t address, std::uint8_t* to, std::size_t size) {
  std::uint8_t packet[32];
  const std::size_t bytes =
      dxl::encode_read(packet, sizeof packet, kId, address, static_cast<std::uint16_t>(size));
  outbox_.insert(outbox_.end(), packet, packet + bytes);
  asked_.push_back({to, size});
}

// Costs no waiting: a broadcast write has no answer.
void TickPort::add_write(std::uint8_t id, std::uint16_t address, const void* data,
                         std::size_t size) {
  std::uint8_t packet[32];
  const std::size_t bytes = dxl::encode_write(packet, sizeof packet, id, address,
                                              static_cast<const std::uint8_t*>(data), size);
  outbox_.insert(outbox_.end(), packet, packet + bytes);
  if (id != dxl::kBroadcast) asked_.push_back({});
}

TickPort::Answer TickPort::read(std::uint16_t address, void* to, std::uint16_t size) {
  add_read(address, static_cast<std::uint8_t*>(to), size);
  return exchange();
}

TickPort::Answer TickPort::write(std::uint16_t address, std::uint8_t value) {
  add_write(kId, address, &value, 1);
  return exchange();
}

TickPort::Answer TickPort::read_image(app::ImageKind kind, std::size_t offset, void* to,
                                      std::size_t size) {
  if (window_ != kind) {
    const Answer answer = write(reg("window_kind"), static_cast<std::uint8_t>(kind));
    if (answer != Answer::kGood) return answer;
    window_ = kind;
  }
  for (std::size_t done = 0; done < size;) {
    for (int block = 0; block < kBlocksAtOnce && done < size; ++block) {
      const std::size_t count = std::min<std::size_t>(size - done, app::table::kWindowBytes);
      const auto at = static_cast<std::uint32_t>(offset + done);
      add_write(dxl::kBroadcast, reg("window_offset"), &at, sizeof at);
      add_read(reg("window_data"), static_cast<std::uint8_t*>(to) + done, count);
      done += count;
    }
    const Answer answer = exchange();
    if (answer != Answer::kGood) return answer;
  }
  return Answer::kGood;
}

TickPort::Answer TickPort::exchange() {
  Answer answer = Answer::kSilent;
  for (int attempt = 0; attempt < kAttempts && answer == Answer::kSilent; ++attempt) {
    if (attempt > 0) drain();  // a late answer must not count
    link_.write(outbox_.data(), outbox_.size(), static_cast<std::uint32_t>(kPatience_ns / 1000));
    bool refused = false;
    if (collect(refused)) answer = refused ? Answer::kRefused : Answer::kGood;
  }
  if (answer != Answer::kGood) window_ = app::ImageKind::kNone;
  outbox_.clear();
  asked_.clear();
  return answer;
}

bool TickPort::collect(bool& refused) {
  dxl::Parser parser;
  std::uint8_t piece[256];
  std::size_t answers = 0;
  const std::uint64_t end_ns = link::monotonic_ns() + kPatience_ns;
  while (link::monotonic_ns() < end_ns) {
    const std::size_t count = link_.read(piece, sizeof piece, kSlice_us);
    for (std::size_t i = 0; i < count; ++i) {
      for (bool found = parser.push(piece[i]); found; found = parser.next()) {
        const dxl::Packet& packet = parser.packet();
        if (!packet.is_status() || packet.id != kId) continue;
        const Request& request = asked_[answers];
        error_ = static_cast<dxl::Error>(packet.error & ~dxl::kAlert);
        refused = refused || error_ != dxl::Error::kNone;
        if (!refused && packet.size != request.size) continue;
        if (!refused && request.to != nullptr) {
          std::memcpy(request.to, packet.parameters, request.size);
        }
        if (++answers == asked_.size() || refused) return true;
      }
    }
  }
  return false;
}

void TickPort::drain() {
  std::uint8_t piece[256];
  while (link_.read(piece, sizeof piece, kQuiet_us) > 0) {
  }
}

}  // namespace verp::shadow
