#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/protocol/dynamixel2.hpp"
#include "host/twin/bus/bus_words.hpp"
#include "host/twin/bus/device.hpp"
#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {

class DynamixelWords final : public BusWords {
 public:
  explicit DynamixelWords(VirtualBus& line) : line_(line) {}
  /// The line owns it.
  void add(Device& device) { devices_.push_back(&device); }
  /// A broadcast (Fast) Sync or Bulk Read of Present Position.
  static bool begins_tick(const dxl::Packet& packet);

  bool push(std::uint8_t byte) override { return parser_.push(byte); }
  bool next() override { return parser_.next(); }
  void forget() override { parser_.reset(); }
  void jam() override { parser_.reset(), last_four_ = 0; }
  void watch_header(std::uint8_t byte) override;
  bool begins_tick() const override { return begins_tick(parser_.packet()); }
  void handle(std::uint64_t end_ns) override;
  bool begins_tick(std::span<const std::uint8_t> frame) const override;
  std::size_t frame_size(std::span<const std::uint8_t> bytes) const override;

 private:
  /// More than one only if ids are duplicated.
  std::vector<Device*> devices(std::uint8_t id) const;
  /// `for_group`: by Secondary ID too. Only a device addressed by its own id replies.
  template <class Apply>
  void command(std::uint8_t id, bool for_group, Apply apply);
  void ping(std::uint8_t id);
  void identify(std::uint8_t id);
  void read(const dxl::Packet& packet);
  void factory_reset(const dxl::Packet& packet);
  void read_each(const dxl::Packet& packet);
  void read_fast(const dxl::Packet& packet);
  void write_each(const dxl::Packet& packet);

  VirtualBus& line_;
  std::vector<Device*> devices_;
  dxl::Parser parser_;
  std::uint32_t last_four_ = 0;  ///< last four bytes of the master, in real time
};

}  // namespace verp::bus
