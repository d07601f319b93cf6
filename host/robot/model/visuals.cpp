#include "host/robot/model/visuals.hpp"

#include <sdf/Collision.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>
#include <sdf/Pbr.hh>
#include <sdf/Visual.hh>

#include "host/robot/model/sdf_parts.hpp"

namespace verp::model {
namespace {

bool read_geometry(const sdf::Geometry& geometry, const PictureFiles& files, Visual& visual) {
  if (const auto* mesh = geometry.MeshShape()) {
    visual.shape = Visual::Shape::kMesh;
    visual.size_m = to_vector(mesh->Scale());
    visual.mesh_uri = mesh->Uri();
    visual.mesh = files.find(mesh->Uri());
  } else if (!read_solid(geometry, visual.shape, visual.size_m)) {
    return false;
  }
  return visual.size_m.allFinite();
}

void read_material(const sdf::Material& material, const PictureFiles& files, Visual& visual) {
  const auto colour = material.Diffuse();
  visual.rgba = {colour.R(), colour.G(), colour.B(), colour.A()};
  const auto glow = material.Emissive();
  if (glow.R() > 0 || glow.G() > 0 || glow.B() > 0) {
    visual.emissive_rgb = {glow.R(), glow.G(), glow.B()};
  }
  if (const sdf::Pbr* pbr = material.PbrMaterial()) {
    for (const auto type : {sdf::PbrWorkflowType::METAL, sdf::PbrWorkflowType::SPECULAR}) {
      if (const auto* flow = pbr->Workflow(type); flow && !flow->AlbedoMap().empty()) {
        visual.texture = files.find(flow->AlbedoMap());
        // the renderer reports it
        if (visual.texture.empty()) visual.texture = flow->AlbedoMap();
      }
    }
  }
}

void add_meshes_to_touch(const sdf::Link& link, const PictureFiles& files,
                         std::vector<Visual>& visuals) {
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Collision& sdf = *link.CollisionByIndex(i);
    if (sdf.Geom() == nullptr || sdf.Geom()->MeshShape() == nullptr) continue;
    Visual visual;
    visual.name = sdf.Name();
    if (!read_geometry(*sdf.Geom(), files, visual)) continue;
    visual.pose = resolved(sdf.SemanticPose(), link.Name());
    visuals.push_back(std::move(visual));
  }
}

}  // namespace

std::vector<Visual> read_visuals(const sdf::Link& link, const PictureFiles& files) {
  std::vector<Visual> visuals;
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& sdf = *link.VisualByIndex(i);
    Visual visual;
    visual.name = sdf.Name();
    if (sdf.Geom() == nullptr || !read_geometry(*sdf.Geom(), files, visual)) continue;
    if (sdf.Material() != nullptr) read_material(*sdf.Material(), files, visual);
    visual.pose = resolved(sdf.SemanticPose(), link.Name());
    visuals.push_back(std::move(visual));
  }
  if (link.VisualCount() == 0) add_meshes_to_touch(link, files, visuals);
  return visuals;
}

}  // namespace verp::model
