#pragma once
#include <string>
#include <vector>

#include "host/show/scene/snapshot.hpp"

namespace verp::web {

/// The first robot and its motion for viewer.js: tree, shapes, and frames as float32 in base64. A
/// frame holds the body's pose, the joint angles and the marks. `with_air` adds the scene's own
/// floor, sky and lights in place of the page's.
std::string scene_json(const scene::Scene& scene, const std::vector<scene::Snapshot>& frames,
                       bool with_air);

}  // namespace verp::web
