#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/show/scene/camera.hpp"
#include "host/show/scene/snapshot.hpp"

/// Snapshots to pixels. OpenGL 3.3 core through libepoxy, in whatever context is current: a
/// window's or an OffscreenContext.
namespace verp::render {

/// No driver, no context, or a file that cannot be drawn: one line for people.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is drawn besides plain shapes. All can change from one picture to the next.
struct Effects {
  bool antialias = true;
  bool shadows = true;
  bool quick = false;  ///< coarser shadows: for a window whose driver is this PC's processor
  bool fog = true;
  bool textures = true;
  bool transparency = true;
  bool sky = true;
  bool ground = true;
  bool ground_grid = true;
  bool visuals = true;
  bool collisions = false;  ///< shapes of physics, over the visuals
  // Marks of what cannot be seen:
  bool axes = false;  ///< of each link
  bool com = false, zmp = false, support = false, contacts = false, footsteps = false;
  bool trails = false, rays = false;
  bool goals = false;  ///< the robot as its joints' goals have it, see-through

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

/// Everything that it holds in the driver belongs to the context that was current when it was made,
/// and must be when it goes. Never throws for what a snapshot holds: numbers that aren't finite are
/// not drawn.
class Renderer {
 public:
  /// Throws RenderError: no context, or one below OpenGL 3.3.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// The driver draws with this PC's processor: pictures cost it time.
  bool on_processor() const;

  /// Uploads shapes, meshes and textures; lights, fog, sky, ground and materials may be changed
  /// without by look(). A mesh or texture that cannot be read is left out: notes() has a line of
  /// each.
  void set_scene(const scene::Scene& scene);
  /// The same items with other materials, lights, fog, sky or ground.
  void set_looks(const scene::Scene& scene);
  const std::vector<std::string>& notes() const;

  /// Into `framebuffer` (a window's is QOpenGLWidget::defaultFramebufferObject()).
  void draw(const scene::Snapshot& now, const scene::Camera& camera, Size size,
            const Effects& effects, unsigned framebuffer = 0);

  Image image(const scene::Snapshot& now, const scene::Camera& camera, Size size,
              const Effects& effects = {});
  Measured measure(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                   const Effects& effects = {});

  /// What lies under a pixel (from the top left) of a picture so made: an index into Scene::items,
  /// or -1; and where.
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
