#pragma once
#include "host/show/render/renderer.hpp"

namespace verp::pictures {

/// A small number in the picture's upper left corner; a dot of it is `scale` pixels.
void write_number(render::Image& image, int number, int scale);

}  // namespace verp::pictures
