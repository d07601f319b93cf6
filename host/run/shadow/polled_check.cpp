#include "host/run/shadow/polled_check.hpp"

#include "firmware/app/register_image.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/run/shadow/identity.hpp"

namespace verp::shadow {

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
