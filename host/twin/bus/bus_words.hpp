#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/bus/bus_device.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::bus {

class VirtualBus;

/// A serial protocol's words: packets in the master's bytes, and what they make the devices do. The
/// line and its time are VirtualBus's.
class BusWords {
 public:
  virtual ~BusWords() = default;

  /// True: a packet is complete; call next() until false before the next push().
  virtual bool push(std::uint8_t byte) = 0;
  virtual bool next() = 0;
  /// Forgets an incomplete packet.
  virtual void forget() = 0;
  /// The line lost a byte of the master's.
  virtual void jam() { forget(); }
  /// In real time, before push(): a header that no packet contains begins a new packet.
  virtual void watch_header(std::uint8_t) {}

  /// Of the packet that was found.
  virtual bool begins_tick() const = 0;
  /// Obeys it; the devices' answers go to the line. Its last byte ended at `end_ns`.
  virtual void handle(std::uint64_t end_ns) = 0;

  /// Of whole frames: does one begin a tick; where the first ends.
  virtual bool begins_tick(std::span<const std::uint8_t> frame) const = 0;
  virtual std::size_t frame_size(std::span<const std::uint8_t> bytes) const = 0;
};

/// The robot's devices and its protocol's words for `line`.
struct SpokenBus {
  std::unique_ptr<BusWords> words;
  std::vector<std::unique_ptr<BusDevice>> devices;
};
SpokenBus make_dynamixel_bus(const Params& params, sim::Plant& plant, VirtualBus& line);
SpokenBus make_feetech_bus(const Params& params, sim::Plant& plant, VirtualBus& line);

}  // namespace verp::bus
