#include "host/can/client.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <bitset>

#include "common/protocol/canopen/cob_id.hpp"
#include "firmware/app/sdo_transfer.hpp"

namespace verp::can {
namespace {

using canopen::Abort;
using canopen::Address;
using canopen::SdoClient;

constexpr Address kDeviceType{0x1000, 0};
constexpr Address kName{0x1008, 0};
constexpr std::uint16_t kIdentityIndex = 0x1018;
constexpr std::size_t kMostBytes = 1 << 16;  // of an object that is read
constexpr unsigned kRequestsAtOnce = 16;     // of a scan; a queue takes so many

std::uint32_t to_number(const std::vector<std::uint8_t>& data) {
  return static_cast<std::uint32_t>(
      canopen::get_le(data.data(), static_cast<unsigned>(std::min<std::size_t>(data.size(), 4))));
}

}  // namespace

std::string to_text(Address at) {
  return fmt::format("{:04X}:{:X}", at.index, at.subindex);
}

Client::Client(const wire::Endpoint& endpoint, std::uint32_t timeout_us)
    : own_(std::in_place, endpoint),
      port_(*own_),
      master_(port_),
      timeout_us_(timeout_us),
      place_(to_text(endpoint)) {}
Client::Client(wire::CanPort& port, const wire::Endpoint& endpoint, std::uint32_t timeout_us)
    : port_(port), master_(port_), timeout_us_(timeout_us), place_(to_text(endpoint)) {}

Abort Client::upload(std::uint8_t node, Address at, int attempts, std::vector<std::uint8_t>& data) {
  Abort why = Abort::kTimeout;
  for (int times = 0; times < attempts && why == Abort::kTimeout; ++times) {
    data.resize(kMostBytes);
    SdoClient client(node);
    client.upload(at, data.data(), kMostBytes, SdoClient::Mode::kPlain, master_.now_us());
    const bool good = app::run_transfer(client, master_, timeout_us_);
    data.resize(good ? client.size() : 0);
    why = good ? Abort::kNone : client.reason();
  }
  return why;
}

void Client::fail(std::uint8_t node, Address at, const char* what, Abort why) {
  const std::string head = fmt::format("{}: node {} ", place_, node);
  if (!port_.connected()) {
    throw SilentError(
        fmt::format("{}can't be asked: the interface is down or off the bus; "
                    "see `ip -details link show {}`",
                    head, port_.interface().name));
  }
  if (why == Abort::kTimeout) {
    throw SilentError(
        fmt::format("{}does not answer, asked {} times; check power, wiring, "
                    "termination and bit rate, or see `verp bus scan --link {}`",
                    head, kAttempts, place_));
  }
  throw bus::DeviceError(fmt::format("{}: the {} of {} at node {} was aborted: {} (0x{:08X})",
                                     place_, what, to_text(at), node, canopen::abort_text(why),
                                     static_cast<std::uint32_t>(why)));
}

std::vector<std::uint8_t> Client::read(std::uint8_t node, Address at) {
  std::vector<std::uint8_t> data;
  const Abort why = upload(node, at, kAttempts, data);
  if (why != Abort::kNone) fail(node, at, "read", why);
  return data;
}

void Client::write(std::uint8_t node, Address at, const std::vector<std::uint8_t>& data) {
  Abort why = Abort::kTimeout;
  for (int times = 0; times < kAttempts && why == Abort::kTimeout; ++times) {
    SdoClient client(node);
    client.download(at, data.data(), static_cast<std::uint32_t>(data.size()),
                    SdoClient::Mode::kPlain, master_.now_us());
    why = app::run_transfer(client, master_, timeout_us_) ? Abort::kNone : client.reason();
  }
  if (why != Abort::kNone) fail(node, at, "write", why);
}

bool Client::read_once(std::uint8_t node, Address at) {
  std::vector<std::uint8_t> data;
  return upload(node, at, 1, data) != Abort::kTimeout;
}

std::optional<std::uint32_t> Client::number(std::uint8_t node, Address at) {
  std::vector<std::uint8_t> data;
  if (upload(node, at, kAttempts, data) != Abort::kNone) return std::nullopt;
  return to_number(data);
}

NodeIdentity Client::described(std::uint8_t node, std::uint32_t device_type) {
  std::vector<std::uint8_t> name;
  upload(node, kName, kAttempts, name);
  return {.node = node,
          .device_type = device_type,
          .vendor = number(node, {kIdentityIndex, 1}),
          .product = number(node, {kIdentityIndex, 2}),
          .revision = number(node, {kIdentityIndex, 3}),
          .name = {name.begin(), name.end()}};
}

std::optional<NodeIdentity> Client::identify(std::uint8_t node, int attempts) {
  std::vector<std::uint8_t> type;
  if (upload(node, kDeviceType, attempts, type) == Abort::kTimeout) return std::nullopt;
  return described(node, to_number(type));
}

std::vector<NodeIdentity> Client::scan() {
  std::bitset<canopen::kMaxNode + 1> found;
  const auto listen = [&](std::uint32_t time_us) {
    const std::uint64_t end_us = master_.now_us() + time_us;
    CanFrame frame;
    while (master_.now_us() < end_us && master_.receive(frame, time_us)) {
      const auto from =
          canopen::is_canopen(frame) ? canopen::connection_of(frame.id) : canopen::Connection{};
      if (from.service == canopen::Service::kSdoResponse) found.set(from.node);
    }
  };
  for (unsigned node = 1; node <= canopen::kMaxNode; ++node) {
    SdoClient client(static_cast<std::uint8_t>(node));
    std::uint8_t type[4];
    client.upload(kDeviceType, type, sizeof type, SdoClient::Mode::kPlain, master_.now_us());
    CanFrame frame;
    while (client.next(frame, master_.now_us())) master_.send(frame);
    if (node % kRequestsAtOnce == 0) listen(timeout_us_ / kRequestsAtOnce);
  }
  listen(timeout_us_);
  std::vector<NodeIdentity> all;
  for (unsigned node = 1; node <= canopen::kMaxNode; ++node) {
    if (!found[node]) continue;
    if (auto each = identify(static_cast<std::uint8_t>(node))) all.push_back(std::move(*each));
  }
  return all;
}

}  // namespace verp::can
