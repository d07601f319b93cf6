#include "host/twin/bus/virtual_bus.hpp"

#include <algorithm>
#include <utility>

#include "host/twin/bus/dynamixel_words.hpp"

namespace verp::bus {
namespace {

constexpr std::uint64_t kBitsPerByte = 10;

}  // namespace

VirtualBus::VirtualBus(const Params& params, sim::Plant& plant)
    : plant_(plant), period_ns_(std::uint64_t{params.period_us} * 1000), baud_(params.baud) {
  const bool feetech = params.bus_protocol == BusProtocol::kFeetech;
  SpokenBus spoken =
      feetech ? make_feetech_bus(params, plant, *this) : make_dynamixel_bus(params, plant, *this);
  words_ = std::move(spoken.words);
  devices_ = std::move(spoken.devices);
}

VirtualBus::~VirtualBus() = default;

void VirtualBus::add(std::unique_ptr<Device> device) {
  dynamic_cast<DynamixelWords&>(*words_).add(*device);
  devices_.push_back(std::move(device));
}

void VirtualBus::request_ended(std::uint64_t end_ns) {
  advance_plant(end_ns / 1000);
  for (const auto& each : devices_) {
    if (hears(*each)) each->heard(end_ns / 1000);
  }
}

std::uint64_t VirtualBus::bytes_ns(std::size_t count) const {
  return count * kBitsPerByte * 1'000'000'000u / baud_;
}

bool VirtualBus::hears(const BusDevice& device) const {
  return !unplugged_[device.id()] && !unpowered_[device.id()] && device.runs_at(baud_);
}

void VirtualBus::set_connected(std::uint8_t id, bool connected) {
  unplugged_[id] = !connected;
}

void VirtualBus::set_powered(std::uint8_t id, bool powered) {
  if (unpowered_[id] != powered) return;
  unpowered_[id] = !powered;
  for (const auto& device : devices_) {
    if (device->id() == id) powered ? device->reboot() : device->lose_power();
  }
}

std::uint64_t VirtualBus::begin_tick(std::uint64_t ready_ns) {
  std::uint64_t start_ns = (ready_ns + period_ns_ - 1) / period_ns_ * period_ns_;
  if (ticking_) start_ns = std::max(start_ns, tick_start_ns_ + period_ns_);
  if (!ticking_) first_tick_ns_ = start_ns;
  ticking_ = true;
  tick_start_ns_ = start_ns;
  tick_ = static_cast<std::uint32_t>((start_ns - first_tick_ns_) / period_ns_);
  return start_ns;
}

bool VirtualBus::send(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > hal::kMaxFrame) return false;
  if (real_time_) return talk(data, size), true;
  std::uint64_t start_ns = std::max(now_ns_, wire_free_ns_);
  bytes_on_wire_ += size;
  for (std::size_t i = 0; i < size; ++i) {
    for (bool found = words_->push(data[i]); found; found = words_->next()) {
      if (words_->begins_tick()) start_ns = begin_tick(start_ns);
      wire_free_ns_ = std::max(wire_free_ns_, start_ns + bytes_ns(i + 1));
      words_->handle(wire_free_ns_);
    }
  }
  wire_free_ns_ = std::max(wire_free_ns_, start_ns + bytes_ns(size));
  sent({data, size}, start_ns);
  send_start_ns_ = start_ns;
  now_ns_ = std::max(now_ns_, start_ns);
  return true;
}

std::size_t VirtualBus::poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) {
  const std::uint64_t deadline_ns =
      std::max(now_ns_, send_start_ns_ + std::uint64_t{timeout_us} * 1000);
  const std::size_t count = arrive(deadline_ns, buffer, capacity);
  if (count == 0 && capacity > 0) now_ns_ = deadline_ns;
  return count;
}

std::size_t VirtualBus::bring_until(std::uint64_t time_us, std::uint8_t* buffer,
                                    std::size_t capacity) {
  const std::uint64_t deadline_ns = std::max(now_ns_, time_us * 1000);
  const std::size_t count = arrive(deadline_ns, buffer, capacity);
  if (count < capacity) now_ns_ = deadline_ns;
  advance_plant(now_ns_ / 1000);
  return count;
}

std::size_t VirtualBus::arrive(std::uint64_t deadline_ns, std::uint8_t* buffer,
                               std::size_t capacity) {
  std::size_t count = 0;
  while (!replies_.empty() && count < capacity) {
    Chunk& chunk = replies_.front();
    const std::uint64_t arrival_ns = chunk.start_ns + bytes_ns(chunk.taken + 1);
    if (arrival_ns > deadline_ns) break;
    buffer[count++] = chunk.bytes[chunk.taken++];
    now_ns_ = std::max(now_ns_, arrival_ns);
    if (chunk.taken == chunk.bytes.size()) replies_.pop_front();
  }
  return count;
}

// The plant may be ahead: an answer is computed at the request and begins later.
void VirtualBus::advance_plant(std::uint64_t time_us) {
  if (held_) return;
  time_us = std::max(time_us, plant_.now_us());
  for (;;) {
    BusDevice* next = nullptr;
    for (const auto& each : devices_) {
      if (next == nullptr || each->deadline_us() < next->deadline_us()) next = each.get();
    }
    if (next == nullptr || next->deadline_us() > time_us) break;
    plant_.advance_to(std::max(next->deadline_us(), plant_.now_us()));
    next->expire();
  }
  plant_.advance_to(time_us);
}

void VirtualBus::wait_us(std::uint32_t delay_us) {
  asked_ns_ = wire_free_ns_;
  wire_free_ns_ += std::uint64_t{delay_us} * 1000;
}

void VirtualBus::put_on_wire(std::vector<std::uint8_t> bytes) {
  if (bytes.empty()) return;
  bytes_on_wire_ += bytes.size();
  const std::uint64_t start_ns = wire_free_ns_;
  tell(false, bytes, start_ns);
  wire_free_ns_ += bytes_ns(bytes.size());
  queue({asked_ns_, start_ns, 0, std::move(bytes)});
}

void VirtualBus::queue(Chunk chunk) {
  const auto later = std::find_if(replies_.begin(), replies_.end(), [&](const Chunk& each) {
    return each.start_ns > chunk.start_ns;  // replies to a broadcast Ping, and those to an echo
  });
  replies_.insert(later, std::move(chunk));
}

void VirtualBus::sent(std::span<const std::uint8_t> bytes, std::uint64_t begin_ns) {
  tell(true, bytes, begin_ns);
  if (echo_) queue({begin_ns, begin_ns, 0, {bytes.begin(), bytes.end()}, true});
}

}  // namespace verp::bus
