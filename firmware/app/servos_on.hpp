#pragma once
#include "firmware/app/canopen_servos.hpp"
#include "firmware/app/dynamixel_servos.hpp"

namespace verp::app {

/// ServosOn<Bus>::Type: the ServoBinding for a kind of bus.
template <class Bus>
struct ServosOn;

template <hal::FrameBus Bus>
struct ServosOn<Bus> {
  using Type = DynamixelServos<Bus>;
};
template <hal::CanBus Bus>
struct ServosOn<Bus> {
  using Type = CanopenServos<Bus>;
};

}  // namespace verp::app
