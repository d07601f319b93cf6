#pragma once
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <vector>

#include "common/io/io.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/register_image.hpp"
#include "hal/fake/memory_link.hpp"

namespace verp::test {

/// The operator's end of a port: speaks to device 200.
class OperatorDesk {
 public:
  hal::MemoryLink& controller_end() { return wire_.left(); }
  std::function<void()> serve = [] {};

  /// False: the controller answered "not now".
  bool write(std::uint16_t address, const std::vector<std::uint8_t>& data) {
    ask(dxl::encode_write(frame_, sizeof frame_, kId, address, data.data(), data.size()));
    return !refused_;
  }
  /// Two 4 cm steps in 0.450 s; a new `sequence` makes it a new order.
  bool order_walk(std::uint32_t sequence) {
    constexpr std::uint16_t kSpeed_tenth_mm_s = 1778;
    return write(app::reg("request"),
                 {static_cast<std::uint8_t>(Request::kWalk), static_cast<std::uint8_t>(sequence),
                  kSpeed_tenth_mm_s & 0xFF, kSpeed_tenth_mm_s >> 8, 0, 0, 0, 0});
  }
  template <class Value>
  Value read(std::uint16_t address) {
    Value value;
    const std::vector<std::uint8_t> data =
        ask(dxl::encode_read(frame_, sizeof frame_, kId, address, sizeof value));
    if (data.size() != sizeof value) throw std::runtime_error("a short answer of the controller");
    std::memcpy(&value, data.data(), sizeof value);
    return value;
  }
  std::uint32_t counter(const char* name) {
    return read<std::uint32_t>(dxl::controller::find(name)->address);
  }

 private:
  static constexpr std::uint8_t kId = dxl::controller::kDefaultId;

  std::vector<std::uint8_t> ask(std::size_t size) {
    wire_.right().write(frame_, size, 0);
    serve();
    std::uint8_t bytes[dxl::kMaxPacket];
    const std::size_t count = wire_.right().read(bytes, sizeof bytes, 0);
    dxl::Parser parser;
    for (std::size_t i = 0; i < count; ++i) {
      if (!parser.push(bytes[i])) continue;
      const dxl::Packet& packet = parser.packet();
      const auto error = static_cast<dxl::Error>(packet.error & ~dxl::kAlert);
      refused_ = error == dxl::Error::kResultFail;
      if (packet.id == kId && (error == dxl::Error::kNone || refused_)) {
        return {packet.parameters, packet.parameters + packet.size};
      }
    }
    throw std::runtime_error("the controller did not answer its operator");
  }

  hal::MemoryWire wire_;
  std::uint8_t frame_[dxl::kMaxPacket];
  bool refused_ = false;
};

}  // namespace verp::test
