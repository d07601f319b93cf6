#pragma once
#include "host/robot/model/entity.hpp"

namespace verp::scene {

struct MeshCount {
  std::size_t there = 0, missing = 0, coloured = 0;
};

inline MeshCount meshes_of(const model::Entity& entity) {
  MeshCount count;
  for (const model::Node& node : entity.nodes) {
    for (const model::Visual& visual : node.visuals) {
      if (visual.shape != model::Visual::Shape::kMesh) continue;
      (visual.mesh.empty() ? count.missing : count.there) += 1;
      count.coloured += visual.rgba.has_value() && !visual.mesh_uri.empty();
    }
  }
  return count;
}

}  // namespace verp::scene
