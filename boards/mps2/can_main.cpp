#include "board.hpp"
#include "can.hpp"
#include "firmware/boot/boot.hpp"
#include "hal/chip/semihosting/semihosting.hpp"

/// can_<board>: the CAN bus without a robot. Sends "ready" (identifier 0x700), then answers every
/// frame with the same data and format at the next higher identifier. 0x7FF is answered with the
/// error counters and ends the image, with status 1 if any is not 0.
namespace {

constexpr std::uint32_t kEnd = 0x7FF;
constexpr std::uint32_t kReady = 0x700;
constexpr std::uint32_t kPatience_us = 0xFFFFFFFFu;  // longer than any test

verp::board::Can can = verp::board::make_can();

bool send(const verp::CanFrame& frame) {
  verp::CanFrame unread;
  for (int tries = 0; tries < 1000; ++tries) {
    if (can.send(frame)) return true;
    can.poll(unread, 0);
  }
  return false;
}

int end() {
  const verp::hal::CanErrors errors = can.errors();
  verp::CanFrame last;
  last.id = kEnd - 1;
  last.size = 4;
  const std::uint32_t counts[] = {errors.errors, errors.overruns, errors.bus_offs, errors.dropped};
  bool good = true;
  for (int i = 0; i < 4; ++i) {
    last.data[i] = static_cast<std::uint8_t>(counts[i] < 255 ? counts[i] : 255);
    good = good && counts[i] == 0;
  }
  return send(last) && good ? 0 : 1;
}

}  // namespace

extern "C" int verp_main() {
  using verp::hal::semihosting::print;
  if (!verp::board::open_can(can)) {
    print("can: no controller here\n");
    return 3;
  }
  verp::CanFrame frame;
  frame.id = kReady;
  send(frame);
  for (;;) {
    if (!can.poll(frame, kPatience_us)) continue;
    if (!frame.extended && frame.id == kEnd) return end();
    ++frame.id;
    if (!send(frame)) {
      print("can: an answer was refused\n");
      return 1;
    }
  }
}
