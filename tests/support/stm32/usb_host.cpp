#include "tests/support/stm32/usb_host.hpp"

#include <algorithm>

namespace verp::hal::stm32::model {
namespace {

constexpr std::uint8_t kSetAddress = 5, kClearFeature = 1, kSetConfiguration = 9;
constexpr std::uint64_t kBitRate_hz = 12'000'000;
/// Sync, PIDs, CRCs, gaps and handshake (USB 2.0, 5.8.4).
constexpr std::size_t kOverhead = 13;

}  // namespace

void UsbHost::pass(Time time) {
  const Time end = machine_.now() + time;
  while (machine_.now() < end) {
    if (firmware) firmware();
    if (machine_.now() < end) machine_.advance(std::min(us(100), end - machine_.now()));
  }
}

void UsbHost::token(std::size_t bytes) {
  machine_.advance(duration(8 * (bytes + kOverhead), kBitRate_hz));
}

bool UsbHost::plug() {
  core_.set_vbus(true);
  const Time end = machine_.now() + ms(1000);
  while (!core_.pulled_up()) {
    if (machine_.now() >= end) return false;
    pass(ms(1));
  }
  pass(ms(100));
  return reset();
}

void UsbHost::unplug() {
  core_.set_vbus(false);
  address_ = 0;
}

void UsbHost::forget_toggles() {
  for (unsigned e = 0; e < kEndpoints; ++e) in_data1_[e] = out_data1_[e] = false;
}

bool UsbHost::reset() {
  if (!core_.pulled_up()) return false;
  core_.begin_reset();
  pass(ms(10));
  core_.end_reset();
  address_ = 0;
  forget_toggles();
  pass(ms(10));
  return core_.pulled_up();
}

void UsbHost::resume() {
  core_.resume();
  pass(ms(20));
}

bool UsbHost::ack_arrives() {
  if (lose_acks == 0) return true;
  --lose_acks;
  return false;
}

bool UsbHost::again(UsbAnswer answer, Time until, unsigned& silent, UsbResult& result) {
  if (answer == UsbAnswer::kStall) {
    result = UsbResult::kStalled;
    return false;
  }
  if (answer == UsbAnswer::kNone) {
    result = UsbResult::kNoAnswer;
    return ++silent < 3;
  }
  silent = 0;
  ++naks_;
  result = UsbResult::kNaked;
  if (machine_.now() >= until) return false;
  pass(retry);
  return true;
}

UsbResult UsbHost::send(unsigned endpoint, bool& data1, const std::uint8_t* bytes,
                        std::size_t count) {
  const Time until = machine_.now() + patience;
  unsigned silent = 0;
  for (;;) {
    token(count);
    UsbAnswer answer = core_.out(address_, endpoint, data1, bytes, count);
    if (firmware) firmware();
    if (answer == UsbAnswer::kAck && !ack_arrives()) answer = UsbAnswer::kNone;
    if (answer == UsbAnswer::kAck) {
      data1 = !data1;
      return UsbResult::kDone;
    }
    UsbResult result = UsbResult::kDone;
    if (!again(answer, until, silent, result)) return result;
  }
}

UsbResult UsbHost::fetch(unsigned endpoint, bool& data1, std::vector<std::uint8_t>& bytes) {
  const Time until = machine_.now() + patience;
  unsigned silent = 0;
  for (;;) {
    const UsbPacket packet = core_.in(address_, endpoint, lose_acks == 0);
    token(packet.bytes.size());
    if (firmware) firmware();
    if (packet.answer == UsbAnswer::kAck) {
      ack_arrives();
      if (packet.data1 != data1) {
        ++duplicates_;
        if (machine_.now() >= until) return UsbResult::kNaked;
        continue;
      }
      data1 = !data1;
      last_packet_ = packet.bytes.size();
      bytes.insert(bytes.end(), packet.bytes.begin(), packet.bytes.end());
      return UsbResult::kDone;
    }
    UsbResult result = UsbResult::kDone;
    if (!again(packet.answer, until, silent, result)) return result;
  }
}

UsbReply UsbHost::control(const UsbSetup& setup, const std::vector<std::uint8_t>& data) {
  const auto low = [](std::uint16_t word) { return static_cast<std::uint8_t>(word); };
  const auto high = [](std::uint16_t word) { return static_cast<std::uint8_t>(word >> 8); };
  const std::uint8_t request[8] = {setup.type,        setup.request,     low(setup.value),
                                   high(setup.value), low(setup.index),  high(setup.index),
                                   low(setup.length), high(setup.length)};
  unsigned silent = 0;
  for (;;) {
    token(sizeof request);
    const UsbAnswer answer = core_.setup(address_, request);
    if (firmware) firmware();
    if (answer == UsbAnswer::kAck) break;
    if (++silent == 3) return {UsbResult::kNoAnswer, {}};
  }
  in_data1_[0] = out_data1_[0] = true;
  return (setup.type & 0x80) != 0 && setup.length != 0 ? read_stage(setup) : write_stage(data);
}

UsbReply UsbHost::read_stage(const UsbSetup& setup) {
  UsbReply reply;
  do {
    reply.result = fetch(0, in_data1_[0], reply.bytes);
    if (reply.result != UsbResult::kDone) return reply;
  } while (reply.bytes.size() < setup.length && last_packet_ == control_size);
  out_data1_[0] = true;
  reply.result = send(0, out_data1_[0], nullptr, 0);
  return reply;
}

UsbReply UsbHost::write_stage(const std::vector<std::uint8_t>& data) {
  UsbReply reply;
  for (std::size_t i = 0; i < data.size(); i += control_size) {
    const std::size_t count = std::min<std::size_t>(control_size, data.size() - i);
    reply.result = send(0, out_data1_[0], data.data() + i, count);
    if (reply.result != UsbResult::kDone) return reply;
  }
  in_data1_[0] = true;
  reply.result = fetch(0, in_data1_[0], reply.bytes);
  return reply;
}

UsbResult UsbHost::set_address(std::uint8_t address) {
  const UsbResult result = control({.request = kSetAddress, .value = address}).result;
  if (result == UsbResult::kDone) address_ = address;
  pass(ms(2));
  return result;
}

UsbResult UsbHost::configure(std::uint8_t configuration) {
  const UsbResult result = control({.request = kSetConfiguration, .value = configuration}).result;
  if (result == UsbResult::kDone) forget_toggles();
  return result;
}

UsbResult UsbHost::clear_halt(std::uint8_t endpoint_address) {
  const UsbResult result =
      control({.type = 0x02, .request = kClearFeature, .index = endpoint_address}).result;
  const bool in = (endpoint_address & 0x80) != 0;
  if (result == UsbResult::kDone) (in ? in_data1_ : out_data1_)[endpoint_address & 15] = false;
  return result;
}

UsbResult UsbHost::out(unsigned endpoint, const std::vector<std::uint8_t>& bytes) {
  std::size_t sent = 0;
  do {
    const std::size_t count = std::min<std::size_t>(bulk_size, bytes.size() - sent);
    const UsbResult result = send(endpoint, out_data1_[endpoint], bytes.data() + sent, count);
    if (result != UsbResult::kDone) return result;
    sent += count;
  } while (sent < bytes.size());
  return UsbResult::kDone;
}

UsbReply UsbHost::in(unsigned endpoint, std::size_t most) {
  UsbReply reply;
  do {
    reply.result = fetch(endpoint, in_data1_[endpoint], reply.bytes);
    if (reply.result != UsbResult::kDone) return reply;
  } while (reply.bytes.size() < most && last_packet_ == bulk_size);
  return reply;
}

}  // namespace verp::hal::stm32::model
