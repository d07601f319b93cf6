#pragma once
#include <cstdint>

#include "common/base/can_frame.hpp"

namespace verp::can {

/// A node of a virtual CAN bus: it hears each frame when that ends on the wire, does what it does
/// by itself once a millisecond, and has frames to send. The plant always stands at `now_us`.
class Node {
 public:
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  virtual std::uint8_t id() const = 0;
  virtual void hear(const CanFrame& frame, std::uint64_t now_us) = 0;
  virtual void work(std::uint64_t now_us) = 0;
  /// The next frame that it wants to send, if there is one.
  virtual bool say(CanFrame& frame, std::uint64_t now_us) = 0;
  /// Its power comes: everything in it is as it was bought and set up, and it boots.
  virtual void power_on() = 0;
  /// Its power goes.
  virtual void power_off() = 0;

 protected:
  Node() = default;
};

}  // namespace verp::can
