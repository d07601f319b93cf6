#pragma once
#include <string>
#include <string_view>

#include "host/show/render/gl.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::render {

/// A mesh in any format that assimp reads (STL, OBJ, DAE, glTF), in its own units. Throws
/// RenderError: file, what is wrong, what to do.
scene::Triangles read_mesh(const std::string& file);

/// A PNG as a texture. Throws RenderError.
Texture read_texture(const std::string& file);

/// The picture as a PNG file; whole or not at all. Throws RenderError.
void write_png(const std::string& file, const Image& image);

/// The same in memory, made quickly: larger than write_png()'s file by half.
std::string png_of(const Image& image);
/// And read from there. Throws RenderError; `name` is for its words.
Image read_png(const std::string& name, std::string_view bytes);

/// Depth as 16 bit grey, 1 mm a step, 0: nothing within 65.5 m.
void write_depth_png(const std::string& file, const Measured& measured);

Image read_png(const std::string& file);

}  // namespace verp::render
