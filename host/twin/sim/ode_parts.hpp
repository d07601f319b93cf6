#pragma once
#include <ode/ode.h>

#include "host/robot/model/entity.hpp"

namespace verp::sim {

inline model::Vec3 vec_of(const dReal* v) {
  return {v[0], v[1], v[2]};
}

/// ODE has three rows of four.
inline model::Mat3 mat_of(const dReal* m) {
  model::Mat3 out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out(row, column) = m[4 * row + column];
  }
  return out;
}

inline void to_ode(const model::Mat3& rotation, dReal* out) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out[4 * row + column] = rotation(row, column);
    out[4 * row + 3] = 0;
  }
}

}  // namespace verp::sim
