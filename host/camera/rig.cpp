#include "host/camera/rig.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace verp::camera {

Rig::Rig(const std::filesystem::path& program, const Stage& stage, Pace pace) : pace_(pace) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  socket_ = ends[0];
  try {
    program_ = std::make_unique<process::Child>(
        process::Command{.words = {program.string()},
                         .input = {.descriptor = ends[1]},
                         .output = {},
                         .error = process::Stream{.descriptor = STDERR_FILENO}});
  } catch (const std::system_error& error) {
    ::close(ends[1]);
    ::close(socket_);
    throw CameraError("cameras: their program cannot be started (" + error.code().message() +
                      "); `./verp walk --cameras` builds it, or: ninja -C build/host-release "
                      "verp_camera");
  }
  ::close(ends[1]);
  send(socket_, Kind::kStage, pack(stage));
  const std::optional<Message> answer = receive(socket_);
  if (!answer || answer->kind != Kind::kReady) {
    ::close(socket_);
    throw CameraError(answer ? "cameras: " + answer->data
                             : "cameras: their program ended before it could draw; what it said is "
                               "above");
  }
  listener_ = std::thread([this] { listen(); });
}

Rig::~Rig() {
  ::shutdown(socket_, SHUT_RDWR);
  listener_.join();
  ::close(socket_);
}

void Rig::listen() {
  std::vector<Picture> pictures;
  while (const std::optional<Message> message = receive(socket_)) {
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
  if (!send(socket_, Kind::kMoment, pack(moment))) fail_ended();
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
