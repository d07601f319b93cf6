#include "host/run/shadow/polled_check.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "firmware/app/register_image.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/run/shadow/identity.hpp"

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

using app::reg;
using Answer = TickPort::Answer;
using Log = app::TickLog;

namespace {
constexpr int kMostReads = 100;  // of the tick register
}

bool PolledCheck::turn(std::uint64_t now_us) {
  now_us_ = now_us;
  if (state_ == State::kAsking) return begin();
  return state_ == State::kFollowing && follow();
}

bool PolledCheck::good(Answer answer) {
  if (answer == Answer::kGood) heard_us_ = now_us_;
  return answer == Answer::kGood;
}

bool PolledCheck::begin() {
  std::uint32_t crc = 0, core = 0, tick = 0, later = 0;
  std::uint16_t actions = 0;
  if (!good(port_.read(reg("model_information"), &crc, sizeof crc)) ||
      !good(port_.read(reg("core_version"), &core, sizeof core))) {
    return false;
  }
  if (const std::string why = why_another(params_, crc, core); !why.empty()) {
    refuse(why);
    return false;
  }
  if (!good(port_.read(reg("action_count"), &actions, sizeof actions)) || !take_actions(actions)) {
    return false;
  }
  // Releases a stale hold.
  if (!hold(Log::kNothing) || !good(port_.read(reg("tick"), &tick, sizeof tick))) return false;
  for (int reads = 0; reads < kMostReads && (reads == 0 || later == tick); ++reads) {
    if (!good(port_.read(reg("tick"), &later, sizeof later))) return false;
  }
  if (tick == later || !hold(Log::kStateOnly) || !read_state() || !hold(Log::kNothing))
    return false;
  shadow_ = testimony_.held.state;
  next_ = testimony_.held.record.inputs.tick + 1;
  state_ = State::kFollowing;
  return true;
}

bool PolledCheck::hold(app::TickLog::Hold what) {
  const Answer held = port_.write(reg("tick_hold"), what);
  if (held == Answer::kRefused) {
    refuse(port_.error() == dxl::Error::kResultFail ? kKeepsNoTicks : kNoTickHold);
  }
  return good(held);
}

bool PolledCheck::read_state() {
  return good(
      port_.read_image(app::ImageKind::kState, 0, &testimony_.held, sizeof testimony_.held));
}

bool PolledCheck::read_ticks() {
  std::uint8_t image[kTicks * sizeof(TickRecord)];
  if (!good(port_.read_image(app::ImageKind::kTicks, 0, image, sizeof image))) return false;
  testimony_.ticks = ticks_of(image, sizeof image, testimony_.held);
  return true;
}

bool PolledCheck::follow() {
  TickRecord record;
  std::uint32_t newest = 0;
  const std::size_t place = next_ % kTicks * sizeof record;
  if (!good(port_.read(reg("tick"), &newest, sizeof newest))) return false;
  const std::uint32_t ahead = newest - next_;
  if (ahead == ~0u) return false;  // `next_` does not exist yet
  if (ahead >= kTicks) {
    const bool back = ahead >= 1u << 31;
    boots_ += back ? 1 : 0;
    lose(back ? "the controller began anew" : "the controller dropped ticks before they were read");
    return false;
  }
  if (!good(port_.read_image(app::ImageKind::kTicks, place, &record, sizeof record))) return false;
  if (record.inputs.tick == next_) return compare(record);
  if (record.inputs.tick - next_ < 1u << 31) {
    lose("the controller dropped ticks before they were read");
    return false;
  }
  ++next_;  // a period without tick
  return true;
}

bool PolledCheck::compare(const TickRecord& record) {
  if (!step_on(record.inputs, record.digest.chain)) return settle(record);
  ++next_;
  return true;
}

// A record that changed during its reading is no difference.
bool PolledCheck::settle(const TickRecord& record) {
  if (!hold(Log::kAll) || !read_state() || !read_ticks() || !hold(Log::kNothing)) {
    ++unsettled_;
    lose("a digest differed, and the link was lost over it");
    return false;
  }
  conclude({shadow_, record.inputs, record.digest.chain}, "a tick was not read whole");
  return false;
}

}  // namespace verp::shadow
