#pragma once
#include "host/show/render/renderer.hpp"

namespace verp::render {

/// Stairs along edges become slopes: what a picture that was drawn without antialiasing has of it
/// afterwards. An edge is where brightness jumps; how much of a pixel lies behind it follows from
/// how far away along the edge the next steps of the stairs are, up to 12 pixels. It knows no
/// shapes: what is thinner than a pixel stays broken, and a texture's edges are smoothed too. What
/// it costs and gains beside samples: `verp bench --only frames`.
void smooth_edges(Image& image);

}  // namespace verp::render
