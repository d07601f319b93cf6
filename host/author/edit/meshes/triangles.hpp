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

/// All of a mesh file's surfaces. Throws model::LoadError.
Triangles read_triangles(const std::filesystem::path& file, double unit_m);

struct Filling {
  bool closed = false;  ///< each edge between two triangles: it has an inside
  double volume_m3 = 0;
  Vec3 centre_m = Vec3::Zero();
  Mat3 inertia_per_kg = Mat3::Zero();  ///< about the centre, m2
};
Filling filling(const Triangles& mesh);

/// The solid of that kind around all points, turned as it is smallest.
Solid fitted(const Triangles& mesh, Solid::Kind kind);

}  // namespace verp::edit
