#pragma once
#include "firmware/app/canopen_servos.hpp"
#include "firmware/app/dynamixel_servos.hpp"

namespace verp::app {

/// The ServoBinding for a bus, by what the bus carries: ServosOn<Bus>::Type. One more kind of bus
/// is one more specialisation.
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
