#pragma once
#include "host/show/render/renderer.hpp"

namespace verp::render {

struct Marks {
  struct Vertex {
    float point[3], normal[3], colour[4];
  };
  std::vector<Vertex> vertices;

  void ball(const scene::Vec3& at_m, double radius_m, const scene::Colour& colour);
  void rod(const scene::Vec3& from_m, const scene::Vec3& to_m, double radius_m,
           const scene::Colour& colour);
  void arrow(const scene::Vec3& from_m, const scene::Vec3& to_m, double radius_m,
             const scene::Colour& colour);
  /// Convex, level at height_m.
  void area(const std::vector<scene::Vec2>& corners_m, double height_m,
            const scene::Colour& colour);
  void outline(const std::vector<scene::Vec2>& corners_m, double height_m, double width_m,
               const scene::Colour& colour);
  void disc(const scene::Vec2& at_m, double height_m, double radius_m, double hole_m,
            const scene::Colour& colour);

 private:
  void triangle(const scene::Vec3& a, const scene::Vec3& b, const scene::Vec3& c,
                const scene::Vec3& na, const scene::Vec3& nb, const scene::Vec3& nc,
                const scene::Colour& colour);
  void cone(const scene::Vec3& from_m, const scene::Vec3& to_m, double from_radius_m,
            double to_radius_m, const scene::Colour& colour);
};

Marks marks_of(const scene::Scene& scene, const scene::Snapshot& now, const Effects& effects);

}  // namespace verp::render
