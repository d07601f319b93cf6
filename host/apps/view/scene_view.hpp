#pragma once
#include <QOpenGLWidget>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host/apps/view/run/film.hpp"
#include "host/show/render/renderer.hpp"
#include "host/show/scene/camera.hpp"

class QLabel;

namespace verp::view {

/// Left drag turns, middle or right drag moves, the wheel zooms; Shift grips what is under the
/// mouse.
class SceneView final : public QOpenGLWidget {
 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  void set_scene(scene::Scene scene);
  void show_picture(Picture now);
  /// False: `name` is not one of scene::view_names().
  bool set_view(const std::string& name);
  const std::string& view() const { return view_; }
  void set_follow(bool follow) { follow_ = follow; }
  bool follow() const { return follow_; }
  const scene::Orbit& orbit() const { return orbit_; }
  render::Effects& effects() { return effects_; }

  void say(const QString& text);  ///< in the corner

  struct Hold {
    int robot = 0, node = 0;
    scene::Vec3 at_world_m = scene::Vec3::Zero();  ///< where the grip began
    scene::Vec3 to_world_m = scene::Vec3::Zero();  ///< the mouse, at the same distance from the eye
  };
  std::function<void(const Hold&)> held, let_go;
  std::function<void(const Hold&)> taken;              ///< double click
  std::function<void(const std::string& why)> failed;  ///< the view cannot draw
  std::function<void(const std::string& what)> noted;  ///< an item that cannot be drawn

  std::uint64_t drawn() const { return drawn_; }

 protected:
  void initializeGL() override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  scene::Camera camera() const;
  render::Size pixels() const;
  std::optional<Hold> take_hold(const QPointF& at);
  scene::Vec3 under_mouse(const QPointF& at, double ahead_m) const;
  void free_view();

  scene::Scene scene_;
  Picture now_;
  std::unique_ptr<render::Renderer> renderer_;
  render::Effects effects_;
  scene::Orbit orbit_;
  std::string view_ = "three-quarter";
  bool follow_ = true, placed_ = false, scene_changed_ = true;
  scene::Vec3 followed_m_ = scene::Vec3::Zero();
  QPointF mouse_;
  std::optional<Hold> hold_;
  QLabel* overlay_;
  std::uint64_t drawn_ = 0;
};

}  // namespace verp::view
