#include "host/author/action/send.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "common/action/kept.hpp"
#include "common/protocol/controller_table.hpp"
#include "firmware/app/block_window.hpp"
#include "host/twin/bus/client.hpp"

namespace verp::action {
namespace {

using Clock = std::chrono::steady_clock;
using dxl::controller::WindowState;

constexpr std::chrono::milliseconds kAskAgain{100};

constexpr const char* kArmedText =
    "its servos hold torque, and it takes actions only without; support the robot, and have it let "
    "go: `verp bus write --link ... --register request 0`";

Clock::time_point in(double seconds) {
  return Clock::now() + std::chrono::milliseconds(static_cast<int>(1e3 * seconds));
}

[[noreturn]] void fail(const ActionPort& port, const std::string& what) {
  throw bus::DeviceError(port.place() + ": " + what);
}

std::string reason(std::uint32_t fault) {
  if (fault == app::kWrongWindowCrc) return "a block was lost or damaged; send them again";
  if (fault == app::kBlockNotKept) {
    return "its flash did not keep a block, as an emulated chip's does not; write them with `verp "
           "flash --params`";
  }
  const std::string what = fault < std::size(kKeptFaultNames)
                               ? kKeptFaultNames[fault]
                               : fmt::format("of no use, fault {}", fault);
  return fmt::format(
      "they are {}; build program and firmware of one revision, and name the robot "
      "that the controller drives",
      what);
}

void require_ready(ActionPort& port, const SendOptions& options) {
  const std::vector<std::uint8_t> text = port.read("robot_name");
  const std::string robot(text.begin(), std::find(text.begin(), text.end(), 0));
  if (robot != options.robot) {
    fail(port, fmt::format("its robot is {}, and these are actions of {}; name that robot, or give "
                           "the controller this one: `verp flash --params`",
                           robot.empty() ? "none" : robot, options.robot));
  }
  if (port.number("torque_enable") != 0) fail(port, kArmedText);
}

[[noreturn]] void refused(ActionPort& port, Offer what, std::size_t bytes) {
  std::string why = "it refuses the actions: ";
  if (what == Offer::kArmed) why = kArmedText;
  if (what == Offer::kNoRoom) {
    why = fmt::format("it has no room for {} bytes of actions; leave some out", bytes);
  }
  if (what == Offer::kNotHere) {
    why = "it takes no actions while it runs; write them with `verp flash --params`";
  }
  if (what == Offer::kRefused) why += reason(port.number("window_fault"));
  fail(port, why + "; it keeps those that it has");
}

/// Offers until there is a place; a chip that erases does not answer.
Offer offer_until(ActionPort& port, std::span<const std::uint8_t> image,
                  const SendOptions& options) {
  const Clock::time_point end = in(options.place_s);
  bool waits = false, began = false;
  const auto went = [&](std::size_t bytes) { return began = true, options.went(bytes); };
  for (;;) {
    try {
      const Offer what = port.offer(image, went);
      if (what != Offer::kNotYet) return what;
      if (Clock::now() > end) fail(port, "it makes no place for the actions; start it anew");
      waits = true;
    } catch (const bus::DeviceError&) {
      if (!waits || began || Clock::now() > end) throw;
    }
    std::this_thread::sleep_for(kAskAgain);
  }
}

/// The controller does not answer while it writes.
bool has_started_anew(ActionPort& port) {
  try {
    return static_cast<WindowState>(port.number("window_state")) != WindowState::kAccepted;
  } catch (const bus::DeviceError&) {
    return false;
  }
}

void require_started(ActionPort& port, const SendOptions& options) {
  const Clock::time_point end = in(options.start_s);
  while (!has_started_anew(port)) {
    if (Clock::now() > end) {
      fail(port,
           "it took the actions, and does not start anew with them; turn it off and on, and see "
           "its action_count");
    }
    std::this_thread::sleep_for(kAskAgain);
  }
  const std::uint32_t count = port.number("action_count"), fault = port.number("action_fault");
  if (fault == 0 && count == static_cast<std::uint32_t>(options.actions)) return;
  fail(port, fmt::format("it started anew with {} actions (action_fault {}) in place of {}; send "
                         "them again",
                         count, fault, options.actions));
}

}  // namespace

bool send_actions(ActionPort& port, std::span<const std::uint8_t> image,
                  const SendOptions& options) {
  require_ready(port, options);
  const Offer what = offer_until(port, image, options);
  if (what == Offer::kStopped) return false;
  if (what != Offer::kTaken) refused(port, what, image.size());
  require_started(port, options);
  return true;
}

}  // namespace verp::action
