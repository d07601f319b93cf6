#include "host/twin/can/client.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/sdo_transfer.hpp"

namespace verp::can {
namespace {

using canopen::Abort;
using canopen::Address;
using canopen::SdoClient;

constexpr Address kDeviceType{0x1000, 0};
constexpr Address kName{0x1008, 0};
constexpr std::uint16_t kIdentityIndex = 0x1018;
constexpr std::size_t kMostBytes = 1 << 16;      // limit of an object that is read
constexpr unsigned kRequestsAtOnce = 16;         // of a scan; the size of a queue
constexpr std::uint32_t kStopAfter_us = 20'000;  // longest wait for Ctrl-C during a scan

std::uint32_t to_number(const std::vector<std::uint8_t>& data) {
  return static_cast<std::uint32_t>(
      canopen::get_le(data.data(), static_cast<unsigned>(std::min<std::size_t>(data.size(), 4))));
}

template <class Port>
class PortBus final : public ClientBus {
 public:
  template <class From>
  explicit PortBus(From& from) : port_(from) {}
  bool send(const CanFrame& frame) override { return port_.send(frame); }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    return port_.poll(frame, timeout_us);
  }
  std::uint64_t now_us() override { return port_.now_us(); }
  hal::CanErrors errors() const override { return port_.errors(); }
  bool connected() const override { return port_.connected(); }

 private:
  Port port_;
};

/// True if a retry may help: no answer, or one to an earlier request.
bool may_be_late(Abort why) {
  return why == Abort::kTimeout || why == Abort::kCommand || why == Abort::kToggle;
}

/// Device type in an answer for 1000h; 0 after a refusal or a segmented answer.
std::uint32_t device_type_in(const CanFrame& frame, std::uint8_t node) {
  std::uint8_t type[4] = {};
  SdoClient client(node);
  client.upload(kDeviceType, type, sizeof type, SdoClient::Mode::kPlain, 0);
  client.receive(frame, 0);
  return static_cast<std::uint32_t>(canopen::get_le(type, client.size()));
}

}  // namespace

std::string to_text(Address at) {
  return fmt::format("{:04X}:{:X}", at.index, at.subindex);
}

Client::Client(const link::Endpoint& endpoint, std::uint32_t timeout_us)
    : own_(std::make_unique<PortBus<link::CanPort>>(endpoint)),
      bus_(*own_),
      master_(bus_),
      timeout_us_(timeout_us),
      place_(to_text(endpoint)) {}
Client::Client(link::CanPort& port, const link::Endpoint& endpoint, std::uint32_t timeout_us)
    : own_(std::make_unique<PortBus<link::CanPort&>>(port)),
      bus_(*own_),
      master_(bus_),
      timeout_us_(timeout_us),
      place_(to_text(endpoint)) {}
Client::Client(ClientBus& bus, std::string place, std::uint32_t timeout_us)
    : bus_(bus), master_(bus_), timeout_us_(timeout_us), place_(std::move(place)) {}

canopen::SdoChannel Client::channel_to(std::uint8_t node) {
  if (node != canopen::plan::kControllerNode) return canopen::default_sdo(node);
  const canopen::SdoChannel own = canopen::further_sdo(canopen::plan::kToolSdo);
  for (int times = 0; !has_own_channel_ && times < kAttempts - 1; ++times) {
    std::uint8_t type[4];
    SdoClient client(own);
    client.upload(kDeviceType, type, sizeof type, SdoClient::Mode::kPlain, master_.now_us());
    if (app::run_transfer(client, master_, timeout_us_)) has_own_channel_ = true;
  }
  if (!has_own_channel_) has_own_channel_ = false;
  return *has_own_channel_ ? own : canopen::default_sdo(node);
}

Abort Client::upload(std::uint8_t node, Address at, int attempts, std::vector<std::uint8_t>& data) {
  Abort why = Abort::kTimeout;
  for (int times = 0; times < attempts && may_be_late(why); ++times) {
    if (times > 0 && stop_()) break;
    data.resize(kMostBytes);
    SdoClient client(channel_to(node));
    client.upload(at, data.data(), kMostBytes, SdoClient::Mode::kPlain, master_.now_us());
    const bool good = app::run_transfer(client, master_, timeout_us_);
    data.resize(good ? client.size() : 0);
    why = good ? Abort::kNone : client.reason();
  }
  return why;
}

void Client::fail(std::uint8_t node, Address at, const char* what, Abort why) {
  const std::string head = fmt::format("{}: node {} ", place_, node);
  if (!bus_.connected()) {
    throw SilentError(
        fmt::format("{}can't be asked: the interface is down or off the bus; "
                    "see `ip -details link show {}`",
                    head, place_.substr(place_.find(':') + 1)));
  }
  if (why == Abort::kTimeout) {
    throw SilentError(
        fmt::format("{}does not answer, asked {} times; check power, wiring, "
                    "termination and bit rate, or see `verp bus scan --link {}`",
                    head, kAttempts, place_));
  }
  throw AbortedError(
      fmt::format("{}: the {} of {} at node {} was aborted: {} (0x{:08X})", place_, what,
                  to_text(at), node, canopen::abort_text(why), static_cast<std::uint32_t>(why)),
      why);
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
    SdoClient client(channel_to(node));
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

void Client::describe(NodeIdentity& identity) {
  using Asked = NodeIdentity::Asked;
  std::vector<std::uint8_t> data;
  const auto ask = [&](Address at) {
    if (identity.asked == Asked::kToTheEnd && stop_()) identity.asked = Asked::kInterrupted;
    if (identity.asked != Asked::kToTheEnd) return false;
    const Abort why = upload(identity.node, at, kAttempts, data);
    if (why != Abort::kTimeout) return why == Abort::kNone;
    identity.asked = stop_() ? Asked::kInterrupted : Asked::kFellSilent;
    return false;
  };
  // 0 also if the scan heard an answer to another client's request.
  if (identity.device_type == 0 && ask(kDeviceType)) identity.device_type = to_number(data);
  if (ask(kName)) identity.name.assign(data.begin(), data.end());
  if (ask({kIdentityIndex, 1})) identity.vendor = to_number(data);
  if (ask({kIdentityIndex, 2})) identity.product = to_number(data);
  if (ask({kIdentityIndex, 3})) identity.revision = to_number(data);
}

std::optional<NodeIdentity> Client::identify(std::uint8_t node, int attempts) {
  std::vector<std::uint8_t> type;
  if (upload(node, kDeviceType, attempts, type) == Abort::kTimeout) return std::nullopt;
  NodeIdentity identity;
  identity.node = node;
  identity.device_type = to_number(type);
  describe(identity);
  return identity;
}

std::vector<std::optional<std::uint32_t>> Client::device_types() {
  std::vector<std::optional<std::uint32_t>> found(canopen::kMaxNode + 1);
  const auto listen = [&](std::uint32_t time_us) {
    const std::uint64_t end_us = master_.now_us() + time_us;
    CanFrame frame;
    for (std::uint64_t now_us = 0; (now_us = master_.now_us()) < end_us && !stop_();) {
      if (!master_.receive_until(frame, std::min(end_us, now_us + kStopAfter_us))) continue;
      const auto from =
          canopen::is_canopen(frame) ? canopen::connection_of(frame.id) : canopen::Connection{};
      if (from.service != canopen::Service::kSdoResponse) continue;
      if (!found[from.node]) found[from.node] = device_type_in(frame, from.node);
    }
  };
  for (unsigned node = 1; node <= canopen::kMaxNode && !stop_(); ++node) {
    SdoClient client(static_cast<std::uint8_t>(node));
    std::uint8_t type[4];
    client.upload(kDeviceType, type, sizeof type, SdoClient::Mode::kPlain, master_.now_us());
    CanFrame frame;
    while (client.next(frame, master_.now_us())) master_.send(frame);
    if (node % kRequestsAtOnce == 0) listen(timeout_us_ / kRequestsAtOnce);
  }
  listen(timeout_us_);
  return found;
}

std::vector<NodeIdentity> Client::scan() {
  const auto types = device_types();
  std::vector<NodeIdentity> all;
  for (std::size_t node = 1; node < types.size(); ++node) {
    if (!types[node]) continue;
    NodeIdentity each;
    each.node = static_cast<std::uint8_t>(node);
    each.device_type = *types[node];
    describe(each);
    all.push_back(std::move(each));
  }
  return all;
}

}  // namespace verp::can
