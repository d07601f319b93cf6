#pragma once
#include <string>
#include <string_view>

#include "host/show/render/gl.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::render {

/// Reads a mesh in any format of assimp (STL, OBJ, DAE, glTF), in the file's units. Throws
/// RenderError that names the file, the fault and the remedy.
scene::Triangles read_mesh(const std::string& file);

/// Reads a PNG as a texture. Throws RenderError.
Texture read_texture(const std::string& file);

/// Writes the whole PNG file or nothing. Throws RenderError.
void write_png(const std::string& file, const Image& image);

/// PNG in memory, compressed quickly: half as large again as write_png()'s file.
std::string png_of(const Image& image);
/// Reads a PNG from memory. Throws RenderError that names `name`.
Image read_png(const std::string& name, std::string_view bytes);

/// Depth as 16-bit grey, 1 mm a step; 0: nothing within 65.5 m.
void write_depth_png(const std::string& file, const Measured& measured);

Image read_png(const std::string& file);

}  // namespace verp::render
