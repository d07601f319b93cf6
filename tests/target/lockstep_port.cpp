#include "tests/target/lockstep_port.hpp"

namespace verp::can {
namespace {

// Filters, so that this socket does not receive its own frames.
const std::vector<link::CanFilter> kAll = {{.id = 0, .mask = 0, .extended = false},
                                           {.id = 0, .mask = 0, .extended = true}};
/// The controller's messages, without those that frames_ sends.
constexpr std::uint32_t kKind = 0x1FFFFFF8;
const std::vector<link::CanFilter> kClock = {
    {.id = lockstep::kCanHelloId, .mask = kKind, .extended = true},
    {.id = lockstep::kCanAdvanceId, .mask = kKind, .extended = true}};
static_assert(((lockstep::kCanHelloId + lockstep::kCanHelloParts - 1) & kKind) ==
              lockstep::kCanHelloId);
static_assert((lockstep::kCanHelloReplyId & kKind) == lockstep::kCanHelloReplyId);
static_assert((lockstep::kCanAdvancedId & kKind) == lockstep::kCanAdvancedId);

/// Both sockets receive a frame within this time.
constexpr std::uint32_t kMoment_us = 1000;

}  // namespace

LockstepPort::LockstepPort(const link::Endpoint& endpoint)
    : frames_(endpoint, kAll, false), bell_(endpoint, kClock, false) {}

bool LockstepPort::serve(LockstepServer& server, std::uint32_t wait_us) {
  CanFrame frame;
  const bool asked = bell_.await(frame, wait_us);
  if (asked) ++rung_;
  answer_.clear();
  for (;;) {
    const bool owed = rung_ > taken_;
    if (!frames_.await(frame, 0) && !(owed && frames_.await(frame, kMoment_us))) {
      taken_ = rung_;
      break;
    }
    server.take(frame, answer_);
    if (!lockstep::is_clock_frame(frame)) continue;
    ++taken_;
    while (bell_.await(frame, 0)) ++rung_;
    if (rung_ <= taken_) break;  // later frames belong to the next one
    // This PC was late. Two answers at once overflow a small FIFO.
    answer_.clear();
  }
  // The controller asks again for frames that cannot leave.
  if (!answer_.empty()) frames_.send_all(answer_.data(), answer_.size());
  return asked;
}

hal::CanErrors LockstepPort::errors() const {
  hal::CanErrors errors = frames_.errors();
  errors.overruns += bell_.errors().overruns;
  return errors;
}

}  // namespace verp::can
