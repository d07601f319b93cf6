#pragma once
#include <sdf/Link.hh>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/picture_files.hpp"

namespace verp::model {

/// Poses in the SDF link's frame. Omits unsupported shapes: only pictures need them. A link without
/// visuals is drawn by the meshes that it touches with.
std::vector<Visual> read_visuals(const sdf::Link& link, const PictureFiles& files);

}  // namespace verp::model
