#pragma once
#include "host/show/render/renderer.hpp"

namespace verp::render {

/// Antialiases a finished picture. An edge is a jump in brightness; its share of a pixel follows
/// from the distance to the next steps along it, up to 12 pixels. Details thinner than a pixel stay
/// broken, and edges in textures are smoothed too. `verp bench --only frames` measures cost and
/// gain against multisampling.
void smooth_edges(Image& image);

}  // namespace verp::render
