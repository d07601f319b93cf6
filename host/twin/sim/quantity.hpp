#pragma once
#include <functional>
#include <string>

namespace verp::sim {

/// A named number of the physics: `body.mass_kg`, `world.gravity_m_s2`. Only the world's thread may
/// read or set it, between steps.
struct Quantity {
  std::string name;
  std::string unit;          ///< "": a pure number
  std::string what;          ///< the same for all of its kind
  double low = 0, high = 0;  ///< range of settable values
  std::function<double()> read;
  std::function<void(double)> set;  ///< empty: read only

  bool settable() const { return static_cast<bool>(set); }
};

}  // namespace verp::sim
