#pragma once
#include <concepts>

#include "firmware/app/canopen_servos.hpp"
#include "firmware/app/serial_servos.hpp"

namespace verp::app {

/// ServosOn<Bus>::Type: the ServoBinding for a kind of bus.
template <class Bus>
struct ServosOn;

template <std::derived_from<hal::FrameBus> Bus>
struct ServosOn<Bus> {
  using Type = SerialServos;
};
template <std::derived_from<hal::CanBus> Bus>
struct ServosOn<Bus> {
  using Type = CanopenServos;
};

}  // namespace verp::app
