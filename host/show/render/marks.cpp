#include "host/show/render/marks.hpp"

#include <cmath>
#include <numbers>

namespace verp::render {

using scene::Colour;
using scene::Vec2;
using scene::Vec3;

namespace {

constexpr int kAround = 14;

Vec3 on_floor(const Vec2& at_m, double height_m) {
  return {at_m.x(), at_m.y(), height_m};
}

}  // namespace

void Marks::triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& na, const Vec3& nb,
                     const Vec3& nc, const Colour& colour) {
  if (!(a.allFinite() && b.allFinite() && c.allFinite())) return;
  const std::array<const Vec3*, 6> of = {&a, &na, &b, &nb, &c, &nc};
  for (std::size_t i = 0; i < 6; i += 2) {
    Vertex vertex{};
    for (int k = 0; k < 3; ++k) {
      vertex.point[k] = static_cast<float>((*of[i])[k]);
      vertex.normal[k] = static_cast<float>((*of[i + 1])[k]);
    }
    const float rgba[] = {colour.r, colour.g, colour.b, colour.a};
    std::copy(std::begin(rgba), std::end(rgba), vertex.colour);
    vertices.push_back(vertex);
  }
}

void Marks::ball(const Vec3& at_m, double radius_m, const Colour& colour) {
  constexpr int kRows = 8;
  const auto out = [](int row, int column) {
    const double a = std::numbers::pi * row / kRows, b = 2 * std::numbers::pi * column / kAround;
    return Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
  };
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kAround; ++c) {
      const Vec3 p = out(r, c), q = out(r + 1, c), s = out(r, c + 1), t = out(r + 1, c + 1);
      const auto at = [&](const Vec3& n) { return Vec3(at_m + radius_m * n); };
      triangle(at(p), at(q), at(s), p, q, s, colour);
      triangle(at(s), at(q), at(t), s, q, t, colour);
    }
  }
}

void Marks::cone(const Vec3& from_m, const Vec3& to_m, double from_radius_m, double to_radius_m,
                 const Colour& colour) {
  const Vec3 along = to_m - from_m;
  if (!(along.norm() > 1e-9)) return;
  const Vec3 axis = along.normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  for (int i = 0; i < kAround; ++i) {
    const auto out = [&](int k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      return Vec3(std::cos(angle) * u + std::sin(angle) * v);
    };
    const Vec3 n = out(i), m = out(i + 1);
    const Vec3 a = from_m + from_radius_m * n, b = from_m + from_radius_m * m;
    const Vec3 c = to_m + to_radius_m * n, d = to_m + to_radius_m * m;
    triangle(a, b, c, n, m, n, colour);
    triangle(c, b, d, n, m, m, colour);
    triangle(from_m, b, a, -axis, -axis, -axis, colour);
    triangle(to_m, c, d, axis, axis, axis, colour);
  }
}

void Marks::rod(const Vec3& from_m, const Vec3& to_m, double radius_m, const Colour& colour) {
  cone(from_m, to_m, radius_m, radius_m, colour);
}

void Marks::arrow(const Vec3& from_m, const Vec3& to_m, double radius_m, const Colour& colour) {
  const Vec3 along = to_m - from_m;
  const double length_m = along.norm(), head_m = std::min(5 * radius_m, 0.6 * length_m);
  if (!(length_m > 1e-6)) return;
  const Vec3 neck_m = to_m - head_m * along / length_m;
  rod(from_m, neck_m, radius_m, colour);
  cone(neck_m, to_m, 2.4 * radius_m, 0, colour);
}

void Marks::area(const std::vector<Vec2>& corners_m, double height_m, const Colour& colour) {
  const Vec3 up = Vec3::UnitZ();
  for (std::size_t i = 2; i < corners_m.size(); ++i) {
    triangle(on_floor(corners_m[0], height_m), on_floor(corners_m[i - 1], height_m),
             on_floor(corners_m[i], height_m), up, up, up, colour);
  }
}

void Marks::outline(const std::vector<Vec2>& corners_m, double height_m, double width_m,
                    const Colour& colour) {
  const Vec3 up = Vec3::UnitZ();
  Vec2 centre_m = Vec2::Zero();
  for (const Vec2& corner : corners_m) centre_m += corner / static_cast<double>(corners_m.size());
  const auto inner = [&](const Vec2& corner) {
    const Vec2 out = corner - centre_m;
    return Vec2(corner - width_m * out / std::max(out.norm(), width_m));
  };
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Vec2 &a = corners_m[i], &b = corners_m[(i + 1) % corners_m.size()];
    const Vec3 p = on_floor(a, height_m), q = on_floor(b, height_m);
    const Vec3 r = on_floor(inner(a), height_m), s = on_floor(inner(b), height_m);
    triangle(p, q, r, up, up, up, colour);
    triangle(r, q, s, up, up, up, colour);
  }
}

void Marks::disc(const Vec2& at_m, double height_m, double radius_m, double hole_m,
                 const Colour& colour) {
  const Vec3 up = Vec3::UnitZ(), centre_m = on_floor(at_m, height_m);
  constexpr int kRound = 28;
  for (int i = 0; i < kRound; ++i) {
    const auto out = [](int k) {
      const double angle = 2 * std::numbers::pi * k / kRound;
      return Vec3(std::cos(angle), std::sin(angle), 0);
    };
    const Vec3 a = centre_m + radius_m * out(i), b = centre_m + radius_m * out(i + 1);
    const Vec3 c = centre_m + hole_m * out(i), d = centre_m + hole_m * out(i + 1);
    triangle(a, b, c, up, up, up, colour);
    triangle(c, b, d, up, up, up, colour);
  }
}

}  // namespace verp::render
