#pragma once
#include "common/io/io.hpp"

namespace verp::abi {

/// The velocity in the wire's units. Throws Failure beyond the wire's or a robot's range.
Command velocity_of(double vx_m_s, double vy_m_s, double wz_rad_s);

}  // namespace verp::abi
