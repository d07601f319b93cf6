#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/show/scene/camera.hpp"
#include "host/show/scene/snapshot.hpp"

/// OpenGL 3.3 core by libepoxy, in the current context.
namespace verp::render {

/// No driver, no context, or a bad file; one line.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Effects {
  bool antialias = true;
  bool shadows = true;
  bool quick = false;  ///< coarser shadows, for windows drawn by the processor
  bool fog = true;
  bool textures = true;
  bool transparency = true;
  bool sky = true;
  bool ground = true;
  bool ground_grid = true;
  bool visuals = true;
  bool collisions = false;  ///< over the visuals
  // Marks of what cannot be seen:
  bool axes = false;  ///< of each link
  bool com = false, zmp = false, support = false, contacts = false, footsteps = false;
  bool trails = false, rays = false;
  bool goals = false;  ///< at its joint goals, transparent

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
  std::vector<float> depth_m;        ///< along the axis; infinity: nothing
  std::vector<std::uint16_t> label;  ///< scene::label_of
};

/// The constructor's context must be current in the destructor. No snapshot makes it throw: it
/// skips items that are not finite.
class Renderer {
 public:
  /// Throws RenderError without OpenGL 3.3.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// True if the PC's processor draws: pictures cost its time.
  bool on_processor() const;

  /// Unreadable files are left out, with a line in notes().
  void set_scene(const scene::Scene& scene);
  /// Sets materials, lights, fog, sky or ground of the same items, without upload.
  void set_looks(const scene::Scene& scene);
  const std::vector<std::string>& notes() const;

  /// Draws into `framebuffer` (in a window, QOpenGLWidget::defaultFramebufferObject()).
  void draw(const scene::Snapshot& now, const scene::Camera& camera, Size size,
            const Effects& effects, unsigned framebuffer = 0);

  Image image(const scene::Snapshot& now, const scene::Camera& camera, Size size,
              const Effects& effects = {});
  Measured measure(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                   const Effects& effects = {});

  /// The item at a pixel from the top left: index into Scene::items, or -1, and point.
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
