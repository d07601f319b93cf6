#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/author/edit/parts.hpp"

namespace verp::edit {

struct Triangles {
  std::vector<Vec3> points_m;
  std::vector<std::array<std::uint32_t, 3>> corners;
};

/// Throws model::LoadError.
Triangles read_triangles(const std::filesystem::path& file, double unit_m);

struct Filling {
  bool closed = false;  ///< each edge joins two triangles
  double volume_m3 = 0;
  Vec3 centre_m = Vec3::Zero();
  Mat3 inertia_per_kg = Mat3::Zero();  ///< about the centre, m2
};
Filling filling(const Triangles& mesh);

Solid fitted(const Triangles& mesh, Solid::Kind kind);

}  // namespace verp::edit
