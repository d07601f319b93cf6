#pragma once
#include "common/io/io.hpp"

namespace verp::abi {

/// As the wire has it. Throws Failure for what it, or a robot, cannot.
Command velocity_of(double vx_m_s, double vy_m_s, double wz_rad_s);

}  // namespace verp::abi
