#pragma once
#include <memory>
#include <string>

#include "host/robot/model/world.hpp"

namespace verp::model {

/// .stl (text or binary) or .obj, scaled. Throws std::runtime_error with the reason.
std::shared_ptr<const Mesh> read_mesh_to_touch(const std::string& path, const Vec3& scale);

/// .pgm, P2 or P5: black is 0, white size_z_m. Its first row is at +y.
std::shared_ptr<const Heightfield> read_pgm(const std::string& path, const Vec3& size_m);

}  // namespace verp::model
