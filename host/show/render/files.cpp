#include "host/show/render/files.hpp"

#include <png.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <filesystem>

#include "host/os/files/whole.hpp"

namespace verp::render {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostMeshBytes = 200u << 20;  // a whole robot for printing has 50 MB
constexpr int kMostTexture = 8192;

[[noreturn]] void refuse(const std::string& file, const std::string& what, const std::string& fix) {
  throw RenderError(file + ": " + what + "; " + fix);
}

void require_file(const std::string& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) refuse(file, "no such file", "give one that exists");
}

bool is_sound(const aiVector3D& point) {
  constexpr float kFar = 1e7F;  // 10 km in millimetres
  return std::abs(point.x) < kFar && std::abs(point.y) < kFar && std::abs(point.z) < kFar;
}

/// False: a point is not finite, or too far.
bool add_part(scene::Triangles& out, const aiMesh& part, const aiMatrix4x4& pose) {
  const auto first = static_cast<std::uint32_t>(out.points.size());
  const aiMatrix3x3 turn(pose);
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D point = pose * part.mVertices[i];
    if (!is_sound(point)) return false;
    const aiVector3D normal = part.HasNormals() ? turn * part.mNormals[i] : aiVector3D(0, 0, 1);
    out.points.emplace_back(point.x, point.y, point.z);
    out.normals.push_back(Eigen::Vector3f(normal.x, normal.y, normal.z).normalized());
    const bool has = part.HasTextureCoords(0);
    out.texture_at.emplace_back(has ? part.mTextureCoords[0][i].x : 0,
                                has ? 1 - part.mTextureCoords[0][i].y : 0);
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    if (part.mFaces[f].mNumIndices != 3) continue;
    for (unsigned k = 0; k < 3; ++k) out.indices.push_back(first + part.mFaces[f].mIndices[k]);
  }
  return true;
}

bool add_node(scene::Triangles& out, const aiScene& in, const aiNode& node, aiMatrix4x4 pose) {
  pose = pose * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    if (!add_part(out, *in.mMeshes[node.mMeshes[i]], pose)) return false;
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    if (!add_node(out, in, *node.mChildren[i], pose)) return false;
  }
  return true;
}

/// libpng's simplified interface: whole pictures, no setjmp.
struct Png {
  png_image image{};
  Png() { image.version = PNG_IMAGE_VERSION; }
  ~Png() { png_image_free(&image); }
};

void write(const std::string& file, Size size, std::uint32_t format, const void* pixels) {
  Png png;
  png.image.width = static_cast<png_uint_32>(size.width);
  png.image.height = static_cast<png_uint_32>(size.height);
  png.image.format = format;
  files::NewFile made(file);
  if (!made.trouble().any() &&
      png_image_write_to_file(&png.image, made.part().c_str(), 0, pixels, 0, nullptr) == 0) {
    refuse(file, std::string("cannot be written (") + png.image.message + ")",
           "free space, or choose another place with -o");
  }
  const files::Trouble trouble = made.keep();
  if (trouble.any()) refuse(file, trouble.what(), trouble.fix() + " with -o");
}

}  // namespace

scene::Triangles read_mesh(const std::string& file) {
  require_file(file);
  std::error_code error;
  if (fs::file_size(file, error) > kMostMeshBytes) {
    refuse(file, "a mesh of more than 200 MB", "simplify it");
  }
  Assimp::Importer importer;
  const aiScene* in = importer.ReadFile(
      file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_GenSmoothNormals |
                aiProcess_SortByPType | aiProcess_FindDegenerates);
  if (in == nullptr || in->mRootNode == nullptr) {
    refuse(file, "not a mesh (" + std::string(importer.GetErrorString()) + ")",
           "give an STL, OBJ, DAE or glTF file");
  }
  scene::Triangles out;
  if (!add_node(out, *in, *in->mRootNode, aiMatrix4x4())) {
    refuse(file, "a mesh with a corner that is no finite number, or 10 km away", "export it anew");
  }
  if (out.indices.empty()) refuse(file, "a mesh without triangles", "export its surfaces");
  return out;
}

namespace {

/// Reads a PNG after its header.
Image finish_reading(const std::string& name, Png& png) {
  if (png.image.width > kMostTexture || png.image.height > kMostTexture) {
    refuse(name,
           "a picture of " + std::to_string(png.image.width) + "x" +
               std::to_string(png.image.height) + " pixels",
           "8192x8192 is the most: scale it down");
  }
  Image out;
  out.size = {static_cast<int>(png.image.width), static_cast<int>(png.image.height)};
  png.image.format = PNG_FORMAT_RGB;
  out.rgb.resize(PNG_IMAGE_SIZE(png.image));
  if (png_image_finish_read(&png.image, nullptr, out.rgb.data(), 0, nullptr) == 0) {
    refuse(name, std::string("a broken PNG picture (") + png.image.message + ")", "make it anew");
  }
  return out;
}

[[noreturn]] void refuse_png(const std::string& name, const Png& png) {
  refuse(name, std::string("not a PNG picture (") + png.image.message + ")", "convert it");
}

}  // namespace

Image read_png(const std::string& file) {
  require_file(file);
  Png png;
  if (png_image_begin_read_from_file(&png.image, file.c_str()) == 0) refuse_png(file, png);
  return finish_reading(file, png);
}

Image read_png(const std::string& name, std::string_view bytes) {
  Png png;
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0)
    refuse_png(name, png);
  return finish_reading(name, png);
}

Texture read_texture(const std::string& file) {
  const Image image = read_png(file);
  Texture texture = new_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, image.size.width, image.size.height, 0, GL_RGB,
               GL_UNSIGNED_BYTE, image.rgb.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  return texture;
}

void write_png(const std::string& file, const Image& image) {
  write(file, image.size, PNG_FORMAT_RGB, image.rgb.data());
}

std::string png_of(const Image& image) {
  Png png;
  png.image.width = static_cast<png_uint_32>(image.size.width);
  png.image.height = static_cast<png_uint_32>(image.size.height);
  png.image.format = PNG_FORMAT_RGB;
  png.image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) ==
      0) {
    throw RenderError(std::string("a picture cannot be made a PNG (") + png.image.message + ")");
  }
  bytes.resize(size);
  return bytes;
}

void write_depth_png(const std::string& file, const Measured& measured) {
  std::vector<std::uint16_t> mm;
  mm.reserve(measured.depth_m.size());
  for (const float depth : measured.depth_m) {
    const float value = depth * 1000;
    mm.push_back(value < 65535.5F ? static_cast<std::uint16_t>(std::lround(value)) : 0);
  }
  // 16-bit grey is linear, unchanged.
  write(file, measured.size, PNG_FORMAT_LINEAR_Y, mm.data());
}

}  // namespace verp::render
