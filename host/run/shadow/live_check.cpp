#include "host/run/shadow/live_check.hpp"

#include <cstring>
#include <utility>

#include "common/model/image.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/controller_objects.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/run/shadow/identity.hpp"

namespace verp::shadow {
namespace {

using canopen::Abort;
using Client = canopen::SdoClient;

constexpr canopen::Address image(app::ImageKind kind) {
  return {static_cast<std::uint16_t>(app::kImageIndex + static_cast<int>(kind)), 0};
}
std::uint32_t number_of(const std::uint8_t (&bytes)[4]) {
  return static_cast<std::uint32_t>(canopen::get_le(bytes, 4));
}

}  // namespace

LiveCheck::LiveCheck(const Params& params, const action::Library& own)
    : Check(params, own),
      listener_(params),
      client_(canopen::further_sdo(canopen::plan::kWatcherSdo)) {}

void LiveCheck::take(const CanFrame& frame, std::uint64_t now_us) {
  if (over()) return;
  if (client_.state() == Client::State::kBusy) client_.receive(frame, now_us);
  listener_.take(frame);
  if (listener_.take_boot()) {
    boots_ += compared_ > 0 ? 1 : 0;
    if (begun_) lose("the controller began anew");
  }
  HeardTick tick;
  while (listener_.next(tick)) {
    heard_us_ = now_us;
    heard_.push_back(std::move(tick));
    if (heard_.size() > kMostHeard) heard_.pop_front();
  }
  if (running_ && client_.state() != Client::State::kBusy) {
    running_ = false;
    client_.state() == Client::State::kDone ? end_step(now_us) : fail_step(now_us);
  }
  if (state_ == State::kFollowing) follow();
}

bool LiveCheck::next(CanFrame& frame, std::uint64_t now_us) {
  if (over() || step_ == Step::kDone) return false;
  if (heard_us_ == 0) return false;  // no controller reports ticks
  if (hold_is_late(now_us)) {
    client_.cancel();
    running_ = false;
  }
  if (!running_ && now_us >= pause_until_us_) begin_step(now_us);
  if (!running_) return false;
  const bool sends = client_.next(frame, now_us);
  if (client_.state() != Client::State::kBusy) {
    running_ = false;
    client_.state() == Client::State::kDone ? end_step(now_us) : fail_step(now_us);
  }
  return sends;
}

// A lost hold order loses the ticks: retry before SDO's timeout.
bool LiveCheck::hold_is_late(std::uint64_t now_us) const {
  constexpr std::uint64_t kAllowance_us = 20'000;
  const bool holds = state_ == State::kReading && step_ == Step::kHold && running_;
  return holds && now_us > step_began_us_ + 3 * std::uint64_t{params_.period_us} + kAllowance_us;
}

void LiveCheck::ask(Step step) {
  step_ = step;
  running_ = false;
}

void LiveCheck::begin_step(std::uint64_t now_us) {
  step_began_us_ = now_us;
  const auto read = [&](canopen::Address at, void* to, std::size_t size, Client::Mode mode) {
    running_ = client_.upload(at, static_cast<std::uint8_t*>(to), static_cast<std::uint32_t>(size),
                              mode, now_us);
  };
  const auto hold = [&](app::TickLog::Hold what) {
    number_[0] = what;
    running_ = client_.download(app::object("tick_hold"), number_, 1, Client::Mode::kPlain, now_us);
  };
  switch (step_) {
    case Step::kName:
      return read(app::object("model_information"), number_, 4, Client::Mode::kPlain);
    case Step::kCore:
      return read(app::object("core_version"), number_, 4, Client::Mode::kPlain);
    case Step::kActions:
      return read(app::object("action_count"), number_, 2, Client::Mode::kPlain);
    case Step::kRelease:
    case Step::kReleaseLast:
      return hold(app::TickLog::kNothing);
    case Step::kHold:
      return hold(state_ == State::kReading ? app::TickLog::kAll : app::TickLog::kStateOnly);
    case Step::kState:
      bytes_.resize(sizeof(app::HeldTick));
      return read(image(app::ImageKind::kState), bytes_.data(), bytes_.size(),
                  Client::Mode::kBlock);
    case Step::kTicks:
      bytes_.resize(app::TickLog::kTicks * sizeof(TickRecord));
      return read(image(app::ImageKind::kTicks), bytes_.data(), bytes_.size(),
                  Client::Mode::kBlock);
    case Step::kDone:
      return;
  }
}

void LiveCheck::end_step(std::uint64_t now_us) {
  heard_us_ = now_us;
  const bool asking = state_ == State::kAsking;
  switch (step_) {
    case Step::kName:
      crc_ = number_of(number_);
      return ask(Step::kCore);
    case Step::kCore:
      if (const std::string why = why_another(params_, crc_, number_of(number_)); !why.empty()) {
        return refuse(why);
      }
      return ask(Step::kActions);
    case Step::kActions:
      if (!take_actions(number_[0] | number_[1] << 8)) return;
      return ask(Step::kRelease);
    case Step::kRelease:
      pause_until_us_ = now_us + kTurn_us;
      return ask(Step::kHold);
    case Step::kHold:
      return ask(Step::kState);
    case Step::kState:
      if (client_.size() != sizeof(app::HeldTick)) {
        return refuse("the controller's State has another size; build both from one revision");
      }
      std::memcpy(static_cast<void*>(&testimony_.held), bytes_.data(), sizeof testimony_.held);
      return ask(asking ? Step::kReleaseLast : Step::kTicks);
    case Step::kTicks:
      testimony_.ticks = ticks_of(bytes_.data(), client_.size(), testimony_.held);
      return ask(Step::kReleaseLast);
    case Step::kReleaseLast:
      ask(Step::kDone);
      if (asking) return start();
      conclude(*suspicion_, "this PC heard another tick than the controller had");
      return suspicion_.reset();
    case Step::kDone:
      return;
  }
}

// Retries without an answer or a tick. Gives up without the object.
void LiveCheck::fail_step(std::uint64_t now_us) {
  pause_until_us_ = now_us + kPause_us;
  if (step_ == Step::kHold && client_.reason() == Abort::kDeviceState) {
    return refuse(kKeepsNoTicks);
  }
  if (client_.reason() == Abort::kNoObject && (step_ == Step::kRelease || step_ == Step::kHold)) {
    return refuse(kNoTickHold);
  }
  ask(state_ == State::kAsking ? Step::kName : Step::kHold);
}

void LiveCheck::start() {
  shadow_ = testimony_.held.state;
  inputs_ = testimony_.held.record.inputs;
  begun_ = true;
  state_ = State::kFollowing;
  while (!heard_.empty() && is_past(heard_.front())) heard_.pop_front();
  follow();
}

void LiveCheck::follow() {
  while (state_ == State::kFollowing && !heard_.empty()) {
    const HeardTick tick = std::move(heard_.front());
    heard_.pop_front();
    if (!follows(tick)) {
      lose("a tick was not heard");
    } else {
      compare(tick);
    }
  }
}

bool LiveCheck::is_past(const HeardTick& tick) const {
  return static_cast<std::int16_t>(tick.tick_low - static_cast<std::uint16_t>(inputs_.tick)) <= 0;
}
// Only a reported overrun skips periods.
bool LiveCheck::follows(const HeardTick& tick) const {
  return tick.tick_low == static_cast<std::uint16_t>(inputs_.tick + 1) ||
         (tick.flags & kOverrun) != 0;
}

void LiveCheck::compare(const HeardTick& tick) {
  std::string lacking;
  const std::vector<Inputs> all = readings(tick, inputs_, params_, kMostReadings, lacking);
  if (all.empty()) return lose(lacking + " was not heard");
  for (const Inputs& each : all) {
    if (!step_on(each, tick.digest)) continue;
    inputs_ = each;
    return;
  }
  suspicion_ = std::make_unique<Suspicion>(Suspicion{shadow_, all.front(), tick.digest});
  state_ = State::kReading;
  pause_until_us_ = 0;
  ask(Step::kHold);
}

void LiveCheck::lose(const std::string& why) {
  Check::lose(why);
  begun_ = false;
  client_.cancel();
  pause_until_us_ = 0;
  ask(Step::kName);
}

}  // namespace verp::shadow
