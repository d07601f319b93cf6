#pragma once
#include <cstdint>

#include "common/base/can_frame.hpp"

namespace verp::can {

/// A node receives each frame at its end on the wire and works once a millisecond. The plant is
/// always at `now_us`.
class Node {
 public:
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  virtual std::uint8_t id() const = 0;
  virtual void hear(const CanFrame& frame, std::uint64_t now_us) = 0;
  virtual void work(std::uint64_t now_us) = 0;
  /// False: nothing to send.
  virtual bool say(CanFrame& frame, std::uint64_t now_us) = 0;
  virtual void power_on() = 0;
  virtual void power_off() = 0;

 protected:
  Node() = default;
};

}  // namespace verp::can
