#include "host/author/edit/meshes/triangles.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>

namespace verp::edit {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 200u << 20;  // a whole robot for printing has 50 MB
constexpr std::size_t kMostTriangles = 2'000'000;
constexpr double kMost_m = 10;  // size of a link

[[noreturn]] void refuse(const fs::path& file, const std::string& what, const std::string& fix) {
  throw model::LoadError(file.string(), 0, what, fix);
}

void add(Triangles& out, const fs::path& file, const aiMesh& part, const aiMatrix4x4& pose,
         double unit_m) {
  const auto first = std::uint32_t(out.points_m.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D p = pose * part.mVertices[i];
    out.points_m.push_back(unit_m * Vec3(double(p.x), double(p.y), double(p.z)));
    if (!out.points_m.back().allFinite())
      refuse(file, "a corner is no finite number", "export it anew");
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    out.corners.push_back(
        {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
  if (out.corners.size() > kMostTriangles)
    refuse(file, "it has more than 2,000,000 triangles", "simplify it");
}

void add(Triangles& out, const fs::path& file, const aiScene& scene, const aiNode& node,
         aiMatrix4x4 pose, double unit_m) {
  pose = pose * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    add(out, file, *scene.mMeshes[node.mMeshes[i]], pose, unit_m);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    add(out, file, scene, *node.mChildren[i], pose, unit_m);
}

void weld(Triangles& mesh) {
  std::map<std::array<double, 3>, std::uint32_t> index;
  std::vector<std::uint32_t> where;
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points_m) {
    const auto [found, fresh] = index.insert({{p.x(), p.y(), p.z()}, std::uint32_t(points.size())});
    if (fresh) points.push_back(p);
    where.push_back(found->second);
  }
  for (auto& corner : mesh.corners) {
    for (auto& each : corner) each = where[each];
  }
  std::erase_if(mesh.corners,
                [](const auto& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; });
  mesh.points_m = std::move(points);
}

bool is_closed(const Triangles& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // opposite directions cancel
  for (const auto& c : mesh.corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = c[k], b = c[(k + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& each) { return each.second == 0; });
}

}  // namespace

Triangles read_triangles(const fs::path& file, double unit_m) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) refuse(file, "no such file", "give a mesh that exists");
  if (fs::file_size(file, error) > kMostBytes)
    refuse(file, "a mesh of more than 200 MB", "simplify it");
  Assimp::Importer importer;
  // Keeps the file's axes, as ROS and simulators do.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    refuse(file, "not a mesh (" + std::string(importer.GetErrorString()) + ")",
           "give an STL, OBJ, DAE or glTF file");
  }
  Triangles out;
  add(out, file, *scene, *scene->mRootNode, aiMatrix4x4(), unit_m);
  weld(out);
  if (out.corners.empty()) refuse(file, "a mesh without triangles", "export its surfaces");
  Eigen::AlignedBox3d box;
  for (const Vec3& p : out.points_m) box.extend(p);
  if (box.sizes().maxCoeff() > kMost_m) {
    refuse(file,
           "it is " + std::to_string(std::llround(std::min(1e9, double(box.sizes().maxCoeff())))) +
               " m long",
           "is it in millimetres? give --unit mm");
  }
  return out;
}

Filling filling(const Triangles& mesh) {
  Filling out;
  out.closed = is_closed(mesh);
  // Sums signed volumes of tetrahedra from one point to each triangle.
  const Vec3 from = mesh.points_m.front();
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& corner : mesh.corners) {
    const Vec3 a = mesh.points_m[corner[0]] - from, b = mesh.points_m[corner[1]] - from,
               c = mesh.points_m[corner[2]] - from;
    const double six = a.dot(b.cross(c));
    const Vec3 sum = a + b + c;
    volume += six / 6;
    first += six / 24 * sum;
    second += six / 120 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  out.volume_m3 = std::abs(volume);  // triangles may face inward
  if (out.volume_m3 < 1e-15) return out.closed = false, out;
  const Vec3 centre = first / volume;
  const Mat3 spread = second / volume - centre * centre.transpose();
  out.centre_m = from + centre;
  out.inertia_per_kg = spread.trace() * Mat3::Identity() - spread;
  return out;
}

}  // namespace verp::edit
