#pragma once
#include "host/show/render/renderer.hpp"

namespace verp::pictures {

/// Upper left corner; a dot is `scale` pixels.
void write_number(render::Image& image, int number, int scale);

}  // namespace verp::pictures
