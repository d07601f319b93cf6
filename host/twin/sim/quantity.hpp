#pragma once
#include <functional>
#include <string>

namespace verp::sim {

/// A number of the physics that has a name: `body.mass_kg`, `world.gravity_m_s2`. Read and set
/// between steps only, by the world's thread.
struct Quantity {
  std::string name;
  std::string unit;          ///< "" for a pure number
  std::string what;          ///< in words, the same for all links, joints or objects
  double low = 0, high = 0;  ///< of what it may be set to
  std::function<double()> read;
  std::function<void(double)> set;  ///< empty: it can only be read

  bool settable() const { return static_cast<bool>(set); }
};

}  // namespace verp::sim
