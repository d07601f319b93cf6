#include "host/apps/view/run/player.hpp"

#include <algorithm>
#include <utility>

namespace verp::view {
namespace {

constexpr double kUnpaced = 50;  // as fast as an eye can follow

}  // namespace

Player::Player(RunSetup setup)
    : live_(std::make_unique<LiveRun>(std::move(setup))), follows_(true) {}

Player::Player(std::shared_ptr<const Film> trace)
    : trace_(std::move(trace)), shown_s_(trace_->begin_s()), follows_(false) {}

std::shared_ptr<const Film> Player::film() const {
  if (live_) return live_->film();
  return trace_;
}

void Player::play() {
  if (live_) {
    follows_ = true;
    live_->play();
    return;
  }
  if (shown_s_ + 1e-9 >= trace_->end_s()) shown_s_ = trace_->begin_s();
  playing_ = true;
}

void Player::pause() {
  playing_ = false;
  if (live_) live_->pause();
}

bool Player::playing() const {
  return live_ ? live_->status().playing && !live_->status().over : playing_;
}

void Player::step(int ticks) {
  const auto film = this->film();
  const bool newest = follows_ || shown_s_ + 1e-9 >= film->end_s();
  pause();
  if (live_ && newest && ticks > 0) {
    follows_ = true;
    return live_->tick_once();
  }
  // at() finds the instant at or before a time; instants are a period apart to within a physics
  // step.
  const double from_s = follows_ ? film->end_s() : shown_s_;
  seek(from_s + (ticks + 0.5) * film->period_s());
}

void Player::seek(double t_s) {
  const auto film = this->film();
  if (film->empty()) return;
  if (live_) live_->pause();
  follows_ = false;
  const Picture found = film->at(std::clamp(t_s, film->begin_s(), film->end_s()));
  if (found) shown_s_ = found->t_s;
}

void Player::set_speed(double factor) {
  speed_ = factor;
  if (live_) live_->set_speed(factor);
}

void Player::reset() {
  if (live_) {
    follows_ = true;
    return live_->reset();
  }
  shown_s_ = trace_->begin_s();
}

Picture Player::now(double wall_s) {
  const double before_s = std::exchange(wall_s_, wall_s);
  const double gone_s = before_s > 0 ? wall_s - before_s : 0;
  const auto film = this->film();
  if (film->empty()) return nullptr;
  if (follows_) shown_s_ = film->end_s();
  if (playing_) {
    shown_s_ += gone_s * (speed_ > 0 ? speed_ : kUnpaced);
    if (shown_s_ >= film->end_s()) {
      shown_s_ = film->end_s();
      playing_ = false;
    }
  }
  return film->at(shown_s_);
}

}  // namespace verp::view
