#include "host/show/render/gl.hpp"

#include "host/show/render/renderer.hpp"

namespace verp::render {
namespace {

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

GLuint compile(GLenum kind, const char* header, const char* text) {
  const GLuint shader = glCreateShader(kind);
  const char* parts[] = {header, text};
  glShaderSource(shader, 2, parts, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  char log[1000] = {};
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  throw RenderError("the GL driver does not compile our shader: " + first_line(log));
}

template <class Generate>
GLuint one(Generate generate) {
  GLuint id = 0;
  generate(1, &id);
  return id;
}

}  // namespace

void delete_buffer(GLuint id) {
  glDeleteBuffers(1, &id);
}
void delete_vertices(GLuint id) {
  glDeleteVertexArrays(1, &id);
}
void delete_texture(GLuint id) {
  glDeleteTextures(1, &id);
}
void delete_frame(GLuint id) {
  glDeleteFramebuffers(1, &id);
}
void delete_renderbuffer(GLuint id) {
  glDeleteRenderbuffers(1, &id);
}
void delete_program(GLuint id) {
  glDeleteProgram(id);
}
Buffer new_buffer() {
  return Buffer(one([](GLsizei n, GLuint* id) { glGenBuffers(n, id); }));
}
VertexArray new_vertices() {
  return VertexArray(one([](GLsizei n, GLuint* id) { glGenVertexArrays(n, id); }));
}
Texture new_texture() {
  return Texture(one([](GLsizei n, GLuint* id) { glGenTextures(n, id); }));
}
FrameBuffer new_frame() {
  return FrameBuffer(one([](GLsizei n, GLuint* id) { glGenFramebuffers(n, id); }));
}
RenderBuffer new_renderbuffer() {
  return RenderBuffer(one([](GLsizei n, GLuint* id) { glGenRenderbuffers(n, id); }));
}

Program::Program(const char* vertex, const char* fragment, const char* fragment_header)
    : name_(glCreateProgram()) {
  const GLuint first = compile(GL_VERTEX_SHADER, "", vertex),
               second = compile(GL_FRAGMENT_SHADER, fragment_header, fragment);
  glAttachShader(name_.id(), first);
  glAttachShader(name_.id(), second);
  glLinkProgram(name_.id());
  glDeleteShader(first);
  glDeleteShader(second);
  GLint good = GL_FALSE;
  glGetProgramiv(name_.id(), GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return;
  char log[1000] = {};
  glGetProgramInfoLog(name_.id(), sizeof log, nullptr, log);
  throw RenderError("the GL driver does not link our shader: " + first_line(log));
}

GLint Program::at(const char* uniform) {
  const auto [found, fresh] = at_.try_emplace(uniform, -1);
  if (fresh) found->second = glGetUniformLocation(name_.id(), uniform);
  return found->second;
}

void Program::set(const char* uniform, const Mat4& value) {
  glUniformMatrix4fv(at(uniform), 1, GL_FALSE, value.data());
}
void Program::set(const char* uniform, const Eigen::Vector3f& value) {
  glUniform3fv(at(uniform), 1, value.data());
}
void Program::set(const char* uniform, const Eigen::Vector4f& value) {
  glUniform4fv(at(uniform), 1, value.data());
}
void Program::set(const char* uniform, float value) {
  glUniform1f(at(uniform), value);
}
void Program::set(const char* uniform, int value) {
  glUniform1i(at(uniform), value);
}

GpuMesh::GpuMesh(const scene::Triangles& mesh)
    : vertices_(new_vertices()),
      points_(new_buffer()),
      indices_(new_buffer()),
      count_(static_cast<GLsizei>(mesh.indices.size())) {
  for (const Eigen::Vector3f& point : mesh.points) around_.extend(point);
  std::vector<float> data;
  data.reserve(mesh.points.size() * 8);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    data.insert(data.end(), mesh.points[i].data(), mesh.points[i].data() + 3);
    data.insert(data.end(), mesh.normals[i].data(), mesh.normals[i].data() + 3);
    const Eigen::Vector2f at =
        i < mesh.texture_at.size() ? mesh.texture_at[i] : Eigen::Vector2f(0, 0);
    data.insert(data.end(), at.data(), at.data() + 2);
  }
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, points_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size() * sizeof(float)), data.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
               mesh.indices.data(), GL_STATIC_DRAW);
  constexpr GLsizei kStride = 8 * sizeof(float);
  const GLint sizes[] = {3, 3, 2};
  std::size_t offset = 0;
  for (GLuint i = 0; i < 3; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, kStride,
                          reinterpret_cast<const void*>(offset * sizeof(float)));
    offset += static_cast<std::size_t>(sizes[i]);
  }
  glBindVertexArray(0);
}

void GpuMesh::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(vertices_.id());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

Canvas::Canvas(int width, int height, GLenum format, int samples)
    : frame_(new_frame()),
      colour_(new_renderbuffer()),
      depth_(new_renderbuffer()),
      width_(width),
      height_(height),
      samples_(samples) {
  require_size(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
  glBindRenderbuffer(GL_RENDERBUFFER, colour_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw RenderError("the GL driver has no room for a picture of " + std::to_string(width) + "x" +
                      std::to_string(height) + "; ask for a smaller one");
  }
}

void require_size(int width, int height) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  if (width > 0 && height > 0 && width <= most && height <= most) return;
  throw RenderError("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                    " cannot be drawn; this GL driver has 1x1 to " + std::to_string(most) + "x" +
                    std::to_string(most));
}

}  // namespace verp::render
