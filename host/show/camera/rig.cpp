#include "host/show/camera/rig.hpp"

#include <sys/socket.h>

#include <utility>

namespace verp::camera {

Rig::Rig(const std::filesystem::path& program, const Stage& stage, Pace pace)
    : pace_(pace), program_(program, stage), listener_([this] { listen(); }) {
  if (pace_ == Pace::kNeverWaits) program_.step_back();
}

Rig::~Rig() {
  ::shutdown(program_.socket(), SHUT_RDWR);
  listener_.join();
}

void Rig::listen() {
  std::vector<Picture> pictures;
  while (const std::optional<Message> message = receive(program_.socket())) {
    if (message->kind == Kind::kPicture) {
      if (auto picture = unpack_picture(message->data)) pictures.push_back(std::move(*picture));
    } else if (message->kind == Kind::kDone) {
      const std::lock_guard lock(mutex_);
      done_.push_back(std::exchange(pictures, {}));
      processor_us_ = unpack_number(message->data).value_or(processor_us_);
      came_.notify_all();
    }
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  came_.notify_all();
}

void Rig::fail_ended() const {
  throw CameraError("cameras: their program ended in the midst of the run; what it said is above");
}

void Rig::expose(const Moment& moment) {
  if (pace_ == Pace::kNeverWaits && sent_ - taken_ >= kAhead) {
    ++dropped_;
    return;
  }
  if (!send(program_.socket(), Kind::kMoment, pack(moment))) fail_ended();
  ++sent_;
}

std::vector<Picture> Rig::take_within(std::uint64_t on_their_way, bool wait) {
  if (sent_ - taken_ <= on_their_way) return {};
  std::unique_lock lock(mutex_);
  if (wait) came_.wait(lock, [this] { return !done_.empty() || ended_; });
  if (done_.empty()) {
    if (ended_) fail_ended();
    return {};
  }
  std::vector<Picture> pictures = std::move(done_.front());
  done_.pop_front();
  ++taken_;
  return pictures;
}

std::vector<Picture> Rig::take() {
  const bool every = pace_ == Pace::kEveryPicture;
  return take_within(every ? kAhead : 0, every);
}

std::vector<Picture> Rig::take_last() {
  return take_within(0, true);
}

double Rig::processor_s() const {
  const std::lock_guard lock(mutex_);
  return static_cast<double>(processor_us_) * 1e-6;
}

}  // namespace verp::camera
