#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/protocol/feetech.hpp"
#include "host/twin/bus/bus_words.hpp"
#include "host/twin/bus/feetech_device.hpp"

namespace verp::bus {

/// A broadcast Ping is answered by all at once, as Feetech warns; nothing else that is broadcast is
/// answered, except Sync Read.
class FeetechWords final : public BusWords {
 public:
  explicit FeetechWords(VirtualBus& line) : line_(line) {}
  /// The line owns it.
  void add(FeetechDevice& device) { devices_.push_back(&device); }

  bool push(std::uint8_t byte) override { return parser_.push(byte); }
  bool next() override { return parser_.next(); }
  void forget() override { parser_.reset(); }
  bool begins_tick() const override { return begins_tick(parser_.packet()); }
  void handle(std::uint64_t end_ns) override;
  bool begins_tick(std::span<const std::uint8_t> frame) const override;
  std::size_t frame_size(std::span<const std::uint8_t> bytes) const override;

 private:
  static bool begins_tick(const feetech::Packet& packet);
  /// More than one if ids are duplicated, or for all.
  std::vector<FeetechDevice*> devices(std::uint8_t id) const;
  void answer(std::uint8_t id);
  void read(std::uint8_t id, std::uint8_t address, std::uint8_t length);
  template <class Apply>
  void command(std::uint8_t id, Apply apply);
  void sync_read(std::span<const std::uint8_t> parameters);
  void sync_write(std::span<const std::uint8_t> parameters);

  VirtualBus& line_;
  std::vector<FeetechDevice*> devices_;
  feetech::Parser parser_;
};

}  // namespace verp::bus
