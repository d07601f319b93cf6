#include "host/apps/view/run/gamepad.hpp"

#include <fcntl.h>
#include <linux/joystick.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <utility>

namespace verp::view {
namespace {

constexpr double kMost = 32767;
constexpr double kDead = 0.15;  // worn sticks do not return to the middle
constexpr int kLookAgain = 30;  // polls
// Numbers of the kernel's drivers for common gamepads.
constexpr int kLeftX = 0, kLeftY = 1, kRightX = 3;
constexpr int kStand = 0, kStop = 1;

double deflection(int value) {
  const double share = value / kMost, beyond = std::abs(share) - kDead;
  return beyond <= 0 ? 0 : std::copysign(std::min(1.0, beyond / (1 - kDead)), share);
}

}  // namespace

Gamepad::~Gamepad() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Gamepad::open() {
  if (wait_ > 0 && --wait_ > 0) return;
  wait_ = kLookAgain;
  descriptor_ = ::open(device_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

void Gamepad::close(News& news) {
  ::close(std::exchange(descriptor_, -1));
  if (!std::exchange(present_, false)) return;
  news.went = true;
  news.moved = sticks_ != Sticks{};
  sticks_ = {};
}

Gamepad::News Gamepad::poll() {
  News news;
  if (descriptor_ < 0) open();
  while (descriptor_ >= 0) {
    js_event event{};
    const ssize_t count = ::read(descriptor_, &event, sizeof event);
    if (count == ssize_t{sizeof event}) {
      news.came = news.came || !std::exchange(present_, true);
      take(event.type, event.number, event.value, news);
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else {
      if (count >= 0 || errno != EAGAIN) close(news);  // end of file, or ENODEV
      break;
    }
  }
  return news;
}

void Gamepad::take(int type, int number, int value, News& news) {
  const bool began = (type & JS_EVENT_INIT) != 0;  // not a press
  type &= ~JS_EVENT_INIT;
  if (type == JS_EVENT_BUTTON && value != 0 && !began) {
    news.stand = news.stand || number == kStand;
    news.stop = news.stop || number == kStop;
  }
  if (type != JS_EVENT_AXIS || began) return;
  const Sticks before = sticks_;
  if (number == kLeftX) sticks_.left = -deflection(value);
  if (number == kLeftY) sticks_.ahead = -deflection(value);
  if (number == kRightX) sticks_.turn = -deflection(value);
  news.moved = news.moved || sticks_ != before;
}

}  // namespace verp::view
