#pragma once
#include <string>
#include <string_view>

#include "host/show/render/gl.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::render {

/// Reads files of assimp (STL, OBJ, DAE, glTF), file's units. Throws RenderError with file, fault
/// and remedy.
scene::Triangles read_mesh(const std::string& file);

/// Throws RenderError.
Texture read_texture(const std::string& file);

/// All or nothing. Throws RenderError.
void write_png(const std::string& file, const Image& image);

/// Compressed quickly: half as large again as write_png()'s file.
std::string png_of(const Image& image);
/// Throws RenderError with `name`.
Image read_png(const std::string& name, std::string_view bytes);

/// 16-bit grey, 1 mm a step; 0: nothing within 65.5 m.
void write_depth_png(const std::string& file, const Measured& measured);

Image read_png(const std::string& file);

}  // namespace verp::render
