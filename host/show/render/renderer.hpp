#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/show/scene/camera.hpp"
#include "host/show/scene/snapshot.hpp"

/// OpenGL 3.3 core through libepoxy, in the current context: a window's or an OffscreenContext.
namespace verp::render {

/// No driver, no context, or a bad file; one line.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All can change between pictures.
struct Effects {
  bool antialias = true;
  bool shadows = true;
  bool quick = false;  ///< coarser shadows, for a window drawn by the PC's processor
  bool fog = true;
  bool textures = true;
  bool transparency = true;
  bool sky = true;
  bool ground = true;
  bool ground_grid = true;
  bool visuals = true;
  bool collisions = false;  ///< collision shapes, over the visuals
  // Marks of what cannot be seen:
  bool axes = false;  ///< of each link
  bool com = false, zmp = false, support = false, contacts = false, footsteps = false;
  bool trails = false, rays = false;
  bool goals = false;  ///< the robot at its joint goals, transparent

  /// All marks that explain a walk.
  static Effects explained();
};

struct Size {
  int width = 1280, height = 720;
};

struct Image {
  Size size;
  std::vector<std::uint8_t> rgb;  ///< rows from the top
};

/// Per pixel, rows from the top.
struct Measured {
  Size size;
  std::vector<float> depth_m;        ///< along the camera's axis; infinity: nothing there
  std::vector<std::uint16_t> label;  ///< scene::label_of
};

/// Its OpenGL objects belong to the context that is current in the constructor, which must be
/// current in the destructor. A snapshot never makes it throw: it skips items whose numbers are not
/// finite.
class Renderer {
 public:
  /// Throws RenderError without a context of OpenGL 3.3 or later.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// True if the PC's processor draws: pictures cost its time.
  bool on_processor() const;

  /// Uploads shapes, meshes and textures. Leaves out files that it cannot read, with a line in
  /// notes().
  void set_scene(const scene::Scene& scene);
  /// Sets other materials, lights, fog, sky or ground for the same items, without an upload.
  void set_looks(const scene::Scene& scene);
  const std::vector<std::string>& notes() const;

  /// Draws into `framebuffer` (in a window, QOpenGLWidget::defaultFramebufferObject()).
  void draw(const scene::Snapshot& now, const scene::Camera& camera, Size size,
            const Effects& effects, unsigned framebuffer = 0);

  Image image(const scene::Snapshot& now, const scene::Camera& camera, Size size,
              const Effects& effects = {});
  Measured measure(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                   const Effects& effects = {});

  /// The item at a pixel (from the top left): an index into Scene::items, or -1, and the point.
  struct Hit {
    int item = -1;
    scene::Vec3 point_world_m = scene::Vec3::Zero();
  };
  Hit pick(const scene::Snapshot& now, const scene::Camera& camera, Size size, int x, int y,
           const Effects& effects = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace verp::render
