#pragma once
#include "host/show/scene/scene.hpp"

namespace verp::render {

/// Item's frame, true size, winding outward.
scene::Triangles box(const scene::Vec3& edges_m, double round_m);
scene::Triangles sphere(double radius_m, int around = 24);
scene::Triangles capsule(double radius_m, double length_m, int around = 20);
scene::Triangles cylinder(double radius_m, double length_m, double round_m, int around = 24);
scene::Triangles plane(double x_m, double y_m);

/// Turns a closed profile (radius, height) and its normals about z.
scene::Triangles turned(const std::vector<Eigen::Vector2f>& profile,
                        const std::vector<Eigen::Vector2f>& normals, int around);

/// One normal a face.
void add_flat_normals(scene::Triangles& mesh);

}  // namespace verp::render
