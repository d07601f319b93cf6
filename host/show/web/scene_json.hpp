#pragma once
#include <string>
#include <vector>

#include "host/show/scene/snapshot.hpp"

namespace verp::web {

/// First robot for viewer.js: tree, shapes, and frames as float32 in base64. Frame: body pose,
/// joint angles, marks. `with_air`: the scene's floor, sky and lights replace the page's.
std::string scene_json(const scene::Scene& scene, const std::vector<scene::Snapshot>& frames,
                       bool with_air);

}  // namespace verp::web
