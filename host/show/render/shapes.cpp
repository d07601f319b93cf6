#include "host/show/render/shapes.hpp"

#include <cmath>
#include <numbers>

namespace verp::render {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using scene::Triangles;

constexpr float kPi = std::numbers::pi_v<float>;

void add_point(Triangles& mesh, const Vector3f& point, const Vector3f& normal, const Vector2f& at) {
  mesh.points.push_back(point);
  mesh.normals.push_back(normal);
  mesh.texture_at.push_back(at);
}

/// Two triangles per cell; `columns`: row length.
void add_grid(Triangles& mesh, std::uint32_t first, std::uint32_t rows, std::uint32_t columns) {
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t a = first + r * columns + c, b = a + columns;
      for (const std::uint32_t i : {a, b, a + 1, a + 1, b, b + 1}) mesh.indices.push_back(i);
    }
  }
}

/// From -half to half: arcs in steps, the flat part in one.
std::vector<float> ticks(float half, float round) {
  constexpr int kArc = 2;
  std::vector<float> at;
  if (round <= 0) return {-half, half};
  for (int i = 0; i <= kArc; ++i) {
    const float angle = kPi / 4 * static_cast<float>(i) / kArc;
    at.push_back(-half + round * (1 - std::tan(kPi / 4 - angle)));
  }
  for (int i = kArc; i >= 0; --i) at.push_back(-at[static_cast<std::size_t>(i)]);
  return at;
}

struct Face {
  int u, v, w;
  float sign;
};

void add_face(Triangles& mesh, const Face& face, const Vector3f& half, float round) {
  const auto us = ticks(half[face.u], round), vs = ticks(half[face.v], round);
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const float u : us) {
    for (const float v : vs) {
      Vector3f point;
      point[face.u] = u;
      point[face.v] = face.sign * v;
      point[face.w] = face.sign * half[face.w];
      const Vector3f least = (round - half.array()).matrix(), most = -least;
      const Vector3f inner = point.cwiseMax(least).cwiseMin(most);
      const Vector3f normal = round > 0 ? Vector3f((point - inner).normalized())
                                        : Vector3f(face.sign * Vector3f::Unit(face.w));
      add_point(mesh, round > 0 ? Vector3f(inner + round * normal) : point, normal,
                {u / (2 * half[face.u]) + 0.5F, 0.5F - v / (2 * half[face.v])});
    }
  }
  add_grid(mesh, first, static_cast<std::uint32_t>(us.size()),
           static_cast<std::uint32_t>(vs.size()));
}

}  // namespace

Triangles box(const scene::Vec3& edges_m, double round_m) {
  Triangles mesh;
  const Vector3f half = (edges_m / 2).cast<float>();
  const float round = std::min(static_cast<float>(round_m), 0.98F * half.minCoeff());
  for (const float sign : {1.0F, -1.0F}) {
    add_face(mesh, {1, 0, 2, sign}, half, round);
    add_face(mesh, {0, 2, 1, sign}, half, round);
    add_face(mesh, {2, 1, 0, sign}, half, round);
  }
  // The grids wind inward.
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  return mesh;
}

Triangles turned(const std::vector<Vector2f>& profile, const std::vector<Vector2f>& normals,
                 int around) {
  Triangles mesh;
  for (std::size_t p = 0; p < profile.size(); ++p) {
    for (int i = 0; i <= around; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(around);
      const Vector3f out(std::cos(angle), std::sin(angle), 0);
      add_point(mesh, profile[p].x() * out + profile[p].y() * Vector3f::UnitZ(),
                normals[p].x() * out + normals[p].y() * Vector3f::UnitZ(),
                {angle / (2 * kPi),
                 static_cast<float>(p) /
                     static_cast<float>(std::max<std::size_t>(profile.size(), 2) - 1)});
    }
  }
  // Profiles run down, so triangles face outward.
  add_grid(mesh, 0, static_cast<std::uint32_t>(profile.size()),
           static_cast<std::uint32_t>(around + 1));
  return mesh;
}

Triangles capsule(double radius_m, double length_m, int around) {
  const auto radius = static_cast<float>(radius_m), half = static_cast<float>(length_m / 2);
  std::vector<Vector2f> profile, normals;
  const int rows = around / 2;
  for (int end = 0; end < 2; ++end) {
    for (int i = 0; i <= rows / 2; ++i) {
      const float angle =
          kPi * static_cast<float>(i + end * (rows / 2)) / static_cast<float>(2 * (rows / 2));
      const Vector2f normal(std::sin(angle), std::cos(angle));
      profile.push_back(radius * normal + Vector2f(0, end == 0 ? half : -half));
      normals.push_back(normal);
    }
  }
  return turned(profile, normals, around);
}

Triangles sphere(double radius_m, int around) {
  return capsule(radius_m, 0, around);
}

Triangles cylinder(double radius_m, double length_m, double round_m, int around) {
  const auto radius = static_cast<float>(radius_m), half = static_cast<float>(length_m / 2);
  const auto round = static_cast<float>(round_m);
  constexpr int kArc = 2;
  std::vector<Vector2f> profile = {{0, half}, {radius - round, half}}, normals = {{0, 1}, {0, 1}};
  for (int end = 0; end < 2; ++end) {
    for (int i = 0; i <= kArc; ++i) {
      const float angle = kPi / 2 * (static_cast<float>(i) / kArc + static_cast<float>(end));
      const Vector2f normal(std::sin(angle), std::cos(angle));
      profile.push_back(Vector2f(radius - round, end == 0 ? half - round : round - half) +
                        round * normal);
      normals.push_back(normal);
    }
  }
  profile.insert(profile.end(), {{radius - round, -half}, {0, -half}});
  normals.insert(normals.end(), {{0, -1}, {0, -1}});
  return turned(profile, normals, around);
}

Triangles plane(double x_m, double y_m) {
  Triangles mesh;
  const auto x = static_cast<float>(x_m / 2), y = static_cast<float>(y_m / 2);
  for (const float u : {0.0F, 1.0F}) {
    for (const float v : {0.0F, 1.0F}) {
      add_point(mesh, {x * (2 * u - 1), y * (2 * v - 1), 0}, Vector3f::UnitZ(), {u, v});
    }
  }
  mesh.indices = {0, 2, 1, 1, 2, 3};
  return mesh;
}

void add_flat_normals(Triangles& mesh) {
  Triangles flat;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vector3f &a = mesh.points[mesh.indices[i]], &b = mesh.points[mesh.indices[i + 1]],
                   &c = mesh.points[mesh.indices[i + 2]];
    const Vector3f normal = (b - a).cross(c - a).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.indices[i + k];
      flat.indices.push_back(static_cast<std::uint32_t>(flat.points.size()));
      flat.points.push_back(mesh.points[from]);
      flat.normals.push_back(normal);
      if (!mesh.texture_at.empty()) flat.texture_at.push_back(mesh.texture_at[from]);
    }
  }
  mesh = std::move(flat);
}

}  // namespace verp::render
