#include "host/twin/bus/bus_server.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace verp::bus {
namespace {

constexpr std::size_t kReadChunk = 65536;

template <class T>
T payload_as(const std::uint8_t* payload) {
  T value;
  std::memcpy(&value, payload, sizeof value);
  return value;
}

}  // namespace

BusServer::BusServer(const Params& params, VirtualBus& bus, ByteStreams streams, ServerHooks hooks,
                     RunOptions options)
    : params_(params),
      bus_(bus),
      streams_(std::move(streams)),
      hooks_(std::move(hooks)),
      options_(options) {}

bool BusServer::end(std::uint32_t exit_code, std::string reason) {
  result_ = {exit_code, std::move(reason)};
  return false;
}

bool BusServer::receive(std::size_t size) {
  while (inbox_.size() - used_ < size) {
    inbox_.erase(inbox_.begin(), inbox_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ = 0;
    const std::size_t before = inbox_.size();
    inbox_.resize(before + kReadChunk);
    const std::size_t count = streams_.read_some(inbox_.data() + before, kReadChunk);
    inbox_.resize(before + count);
    if (count == 0) return end(3, "the controller closed the link without a word");
  }
  return true;
}

ServerResult BusServer::serve() {
  for (;;) {
    if (!receive(sizeof(link::MessageHeader))) return result_;
    const auto header = payload_as<link::MessageHeader>(inbox_.data() + used_);
    if (!receive(sizeof header + header.size)) return result_;
    const std::uint8_t* payload = inbox_.data() + used_ + sizeof header;
    used_ += sizeof header + header.size;
    if (!handle(header, payload)) return result_;
  }
}

bool BusServer::handle(const link::MessageHeader& header, const std::uint8_t* payload) {
  const auto size_is = [&header](std::size_t size) { return header.size == size; };
  if (!greeted_ && header.kind != link::Kind::kHello) {
    return end(3, "the controller did not begin with a hello");
  }
  switch (header.kind) {
    case link::Kind::kHello:
      if (size_is(sizeof(link::Hello))) return hello(payload_as<link::Hello>(payload));
      break;
    case link::Kind::kSend:
      send_failed_ = !bus_.send(payload, header.size) || send_failed_;
      return true;
    case link::Kind::kPoll:
      if (size_is(sizeof(link::Poll))) return poll(payload_as<link::Poll>(payload));
      break;
    case link::Kind::kRecord:
      if (!size_is(sizeof(TickRecord))) break;
      if (hooks_.record) hooks_.record(payload_as<TickRecord>(payload));
      return true;
    case link::Kind::kOutputs:
      if (!size_is(sizeof(Outputs))) break;
      if (hooks_.outputs) hooks_.outputs(payload_as<Outputs>(payload));
      return true;
    case link::Kind::kState:
      if (!size_is(sizeof(State))) break;
      if (hooks_.state) hooks_.state(payload_as<State>(payload));
      return true;
    case link::Kind::kQuit:
      if (header.size < sizeof(link::Quit)) break;
      return end(payload_as<link::Quit>(payload).exit_code,
                 std::string(reinterpret_cast<const char*>(payload) + sizeof(link::Quit),
                             header.size - sizeof(link::Quit)));
  }
  return end(3, "the controller sent a message of kind " +
                    std::to_string(static_cast<int>(header.kind)) + " with " +
                    std::to_string(header.size) + " bytes, which no message of this link is");
}

bool BusServer::hello(const link::Hello& message) {
  link::HelloReply reply;
  reply.params_size = sizeof(Params);
  reply.actions_size = static_cast<std::uint32_t>(options_.actions.size_bytes());
  reply.ticks = options_.ticks;
  reply.state_every = options_.state_every;
  if (message.version != link::kVersion) {
    reply.status = link::HelloStatus::kWrongVersion;
  } else if (message.params_size != sizeof(Params) || message.record_size != sizeof(TickRecord) ||
             message.state_size != sizeof(State)) {
    reply.status = link::HelloStatus::kWrongSizes;
  }
  greeted_ = reply.status == link::HelloStatus::kReady;
  std::vector<std::uint8_t> bytes;
  const auto append = [&bytes](const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
  };
  append(&reply, sizeof reply);
  if (greeted_) {
    append(&params_, sizeof params_);
    append(options_.actions.data(), options_.actions.size_bytes());
  }
  if (!streams_.write(bytes.data(), bytes.size())) return end(3, "the controller hung up");
  if (!greeted_) {
    return end(3, "the controller was built from other sources: rebuild its firmware");
  }
  return true;
}

bool BusServer::poll(const link::Poll& message) {
  std::uint8_t bytes[link::kMaxReply];
  link::PollReply reply;
  const std::size_t capacity = std::min<std::size_t>(message.capacity, link::kMaxPollBytes);
  const std::size_t count = bus_.poll(bytes + sizeof reply, capacity, message.timeout_us);
  if (bus_.ticking() && (!ordered_ || bus_.tick() != ordered_tick_)) {
    ordered_ = true;
    ordered_tick_ = bus_.tick();
    if (hooks_.order) order_ = hooks_.order(ordered_tick_);
  }
  reply.now_us = bus_.now_us();
  reply.size = static_cast<std::uint16_t>(count);
  reply.order = order_;
  if (send_failed_) reply.flags |= link::kSendFailed;
  if (hooks_.stop && hooks_.stop()) reply.flags |= link::kStop;
  send_failed_ = false;
  std::memcpy(bytes, &reply, sizeof reply);
  if (!streams_.write(bytes, sizeof reply + count)) return end(3, "the controller hung up");
  return true;
}

}  // namespace verp::bus
