#pragma once
#include <epoxy/gl.h>

#include <map>
#include <string>
#include <utility>

#include "host/show/scene/scene.hpp"

/// Owning handles; private to this folder.
namespace verp::render {

using Mat4 = Eigen::Matrix4f;

/// Delete frees the object.
template <void (*Delete)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint id) : id_(id) {}
  GlName(GlName&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~GlName() {
    if (id_ != 0) Delete(id_);
  }
  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

void delete_buffer(GLuint id);
void delete_vertices(GLuint id);
void delete_texture(GLuint id);
void delete_frame(GLuint id);
void delete_renderbuffer(GLuint id);
void delete_program(GLuint id);
using Buffer = GlName<delete_buffer>;
using VertexArray = GlName<delete_vertices>;
using Texture = GlName<delete_texture>;
using FrameBuffer = GlName<delete_frame>;
using RenderBuffer = GlName<delete_renderbuffer>;

Buffer new_buffer();
VertexArray new_vertices();
Texture new_texture();
FrameBuffer new_frame();
RenderBuffer new_renderbuffer();

class Program {
 public:
  /// Throws RenderError with the compiler's line.
  Program(const char* vertex, const char* fragment, const char* fragment_header = "");
  void use() const { glUseProgram(name_.id()); }
  GLint at(const char* uniform);
  void set(const char* uniform, const Mat4& value);
  void set(const char* uniform, const Eigen::Vector3f& value);
  void set(const char* uniform, const Eigen::Vector4f& value);
  void set(const char* uniform, float value);
  void set(const char* uniform, int value);

 private:
  GlName<delete_program> name_;
  std::map<std::string, GLint> at_;
};

class GpuMesh {
 public:
  GpuMesh() = default;
  explicit GpuMesh(const scene::Triangles& mesh);
  void draw() const;
  bool empty() const { return count_ == 0; }
  const Eigen::AlignedBox3f& around() const { return around_; }

 private:
  VertexArray vertices_;
  Buffer points_, indices_;
  GLsizei count_ = 0;
  Eigen::AlignedBox3f around_;
};

/// A target with colour and depth, to be read back.
class Canvas {
 public:
  Canvas() = default;
  /// samples 0: no multisampling. Throws RenderError for a refused size.
  Canvas(int width, int height, GLenum format, int samples);
  bool fits(int width, int height, int samples) const {
    return frame_.id() != 0 && width == width_ && height == height_ && samples == samples_;
  }
  GLuint frame() const { return frame_.id(); }

 private:
  FrameBuffer frame_;
  RenderBuffer colour_, depth_;
  int width_ = 0, height_ = 0, samples_ = 0;
};

void require_size(int width, int height);

}  // namespace verp::render
