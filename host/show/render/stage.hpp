#pragma once
#include <map>

#include "host/show/render/gl.hpp"
#include "host/show/render/renderer.hpp"

/// A scene in the driver; private to this folder.
namespace verp::render {

struct Placed {
  const scene::Item* item;
  const GpuMesh* mesh;
  const GpuMesh* sharp;  ///< without rounded edges, or null
  GLuint texture = 0;
  int index = 0;  ///< in Scene::items
  Mat4 world = Mat4::Identity();
  Eigen::Vector3f scale{1, 1, 1};
};

class Stage {
 public:
  /// Bad files do not throw; notes() lists those left out.
  void fill(const scene::Scene& scene);
  void set_looks(const scene::Scene& scene);
  const scene::Scene& scene() const { return scene_; }
  const std::vector<std::string>& notes() const { return notes_; }

  /// Leaves out missing robots and bodies, and poses that are not finite.
  std::vector<Placed> place(const scene::Snapshot& now, const Effects& effects) const;

  /// A ball that the sun's shadows must cover.
  struct Ball {
    scene::Vec3 centre_m = scene::Vec3::Zero();
    double radius_m = 1;
  };
  Ball extent(const scene::Snapshot& now, const scene::Camera& camera) const;

 private:
  void upload(const scene::Item& item, std::size_t index);
  const GpuMesh& mesh_of_file(const std::string& file);
  GLuint texture_of_file(const std::string& file);

  scene::Scene scene_;
  std::vector<GpuMesh> own_;          ///< per item; empty: its mesh is from a file
  std::vector<GpuMesh> sharp_;        ///< without rounded edges
  std::vector<const GpuMesh*> mesh_;  ///< one per item
  std::vector<GLuint> texture_;       ///< per item; 0: none
  std::map<std::string, GpuMesh> files_;
  std::map<std::string, Texture> pictures_;
  std::vector<std::string> notes_;
};

}  // namespace verp::render
