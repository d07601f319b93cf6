#pragma once
#include "host/show/render/renderer.hpp"

namespace verp::render {

/// Antialiases a picture. An edge is a jump in brightness; a pixel's share follows from the next
/// steps along it, up to 12 pixels. Thin details stay broken, and textures are smoothed too. `verp
/// bench --only frames` compares it with multisampling.
void smooth_edges(Image& image);

}  // namespace verp::render
