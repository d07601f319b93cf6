#pragma once
#include <string>
#include <vector>

#include "host/show/scene/snapshot.hpp"

namespace verp::web {

/// The first robot of a scene and what it did, as viewer.js reads it: the tree, its shapes, and for
/// each snapshot the body's pose, the joint angles and what explains them, as float32 in base64.
/// With `with_air` also the scene's own floor, sky and lights, in place of the page's.
std::string scene_json(const scene::Scene& scene, const std::vector<scene::Snapshot>& frames,
                       bool with_air);

}  // namespace verp::web
