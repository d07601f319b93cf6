#include "host/apps/view/scene_view.hpp"

#include <QLabel>
#include <QMouseEvent>
#include <cmath>

namespace verp::view {
namespace {

constexpr double kTurn_rad_px = 0.008;
constexpr double kZoomStep = 0.9;  // wheel notch
constexpr double kNotch = 120;

scene::Orbit orbit_of(const scene::Camera& camera) {
  scene::Orbit orbit;
  const scene::Vec3 back = camera.eye_m - camera.target_m;
  orbit.target_m = camera.target_m;
  orbit.distance_m = back.norm();
  orbit.azimuth_rad = std::atan2(back.y(), back.x());
  orbit.elevation_rad = std::asin(back.z() / orbit.distance_m);
  orbit.vertical_fov_rad = camera.vertical_fov_rad;
  return orbit;
}

}  // namespace

SceneView::SceneView(QWidget* parent) : QOpenGLWidget(parent), overlay_(new QLabel(this)) {
  setObjectName("scene");
  setMinimumSize(320, 200);
  setFocusPolicy(Qt::StrongFocus);
  overlay_->setObjectName("overlay");
  overlay_->setAttribute(Qt::WA_TransparentForMouseEvents);
  overlay_->hide();
}

SceneView::~SceneView() {
  makeCurrent();
  renderer_.reset();
  doneCurrent();
}

void SceneView::set_scene(scene::Scene scene) {
  scene_ = std::move(scene);
  scene_changed_ = true;
  placed_ = false;
  now_.reset();
  update();
}

void SceneView::show_picture(Picture now) {
  if (!now || now == now_ || now->robots.empty() || now->robots.front().link_world.empty()) return;
  const scene::Vec3 body_m = now->robots.front().link_world.front().translation();
  now_ = std::move(now);
  if (!placed_) {
    placed_ = true;
    set_view(view_);
  } else if (follow_) {
    orbit_.target_m.head<2>() += (body_m - followed_m_).head<2>();
  }
  followed_m_ = body_m;
  update();
}

bool SceneView::set_view(const std::string& name) {
  if (!now_) {
    view_ = name;
    return true;
  }
  const auto camera = scene::view(name, scene_, *now_, 0, double(width()) / std::max(1, height()));
  if (!camera) return false;
  view_ = name;
  orbit_ = orbit_of(*camera);
  update();
  return true;
}

void SceneView::say(const QString& text) {
  overlay_->setVisible(!text.isEmpty());
  overlay_->setText(text);
  overlay_->adjustSize();
  overlay_->move(12, 12);
}

/// A robot's camera moves with its link.
scene::Camera SceneView::camera() const {
  for (const scene::Mount& mount : scene_.cameras) {
    if (view_ != "head" && view_ != mount.name) continue;
    const auto eye = scene::view(view_, scene_, *now_, 0, double(width()) / std::max(1, height()));
    if (eye) return *eye;
  }
  return orbit_.camera();
}

void SceneView::free_view() {
  if (!now_ || view_ == "free") return;
  orbit_ = orbit_of(camera());
  view_ = "free";
}

render::Size SceneView::pixels() const {
  const double ratio = devicePixelRatioF();
  return {int(std::lround(width() * ratio)), int(std::lround(height() * ratio))};
}

void SceneView::initializeGL() {
  try {
    renderer_ = std::make_unique<render::Renderer>();
    scene_changed_ = true;
    if (renderer_->on_processor()) {  // the twin needs it too
      effects_.quick = true;
      effects_.antialias = false;
    }
  } catch (const render::RenderError& error) {
    if (failed) failed(error.what());
  }
}

void SceneView::paintGL() {
  if (!renderer_ || !now_) return;
  try {
    if (std::exchange(scene_changed_, false)) {
      renderer_->set_scene(scene_);
      for (const std::string& note : renderer_->notes()) {
        if (noted) noted(note);
      }
    }
    scene::Snapshot now = *now_;
    if (hold_) now.rays.push_back({hold_->at_world_m, hold_->to_world_m, true});
    render::Effects effects = effects_;
    effects.rays = effects.rays || hold_;
    renderer_->draw(now, camera(), pixels(), effects, defaultFramebufferObject());
    ++drawn_;
  } catch (const render::RenderError& error) {
    renderer_.reset();
    if (failed) failed(error.what());
  }
}

std::optional<SceneView::Hold> SceneView::take_hold(const QPointF& at) {
  if (!renderer_ || !now_) return std::nullopt;
  makeCurrent();
  const double ratio = devicePixelRatioF();
  const auto hit = renderer_->pick(*now_, camera(), pixels(), int(at.x() * ratio),
                                   int(at.y() * ratio), effects_);
  doneCurrent();
  if (hit.item < 0) return std::nullopt;
  const scene::Item& item = scene_.items[std::size_t(hit.item)];
  if (item.robot < 0) return std::nullopt;
  return Hold{item.robot, item.node, hit.point_world_m, hit.point_world_m};
}

/// The point under the mouse, `ahead_m` from the camera's plane.
scene::Vec3 SceneView::under_mouse(const QPointF& at, double ahead_m) const {
  const scene::Camera from = camera();
  const scene::Vec3 ahead = (from.target_m - from.eye_m).normalized();
  const scene::Vec3 right = ahead.cross(from.up).normalized();
  const scene::Vec3 up = right.cross(ahead);
  const double half_m = ahead_m * std::tan(from.vertical_fov_rad / 2);
  const double x = (2 * at.x() - width()) / height(), y = 1 - 2 * at.y() / height();
  return from.eye_m + ahead_m * ahead + half_m * (x * right + y * up);
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  mouse_ = event->position();
  setFocus();
  if (event->button() == Qt::LeftButton && (event->modifiers() & Qt::ShiftModifier)) {
    hold_ = take_hold(mouse_);
  }
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF by = event->position() - mouse_;
  mouse_ = event->position();
  if (hold_) {
    const scene::Camera from = camera();
    const scene::Vec3 ahead = (from.target_m - from.eye_m).normalized();
    hold_->to_world_m = under_mouse(mouse_, (hold_->at_world_m - from.eye_m).dot(ahead));
    if (held) held(*hold_);
  } else if (event->buttons() & Qt::LeftButton) {
    free_view();
    orbit_.turn(-kTurn_rad_px * by.x(), kTurn_rad_px * by.y());
  } else if (event->buttons() & (Qt::MiddleButton | Qt::RightButton)) {
    free_view();
    orbit_.pan(-by.x() / height(), by.y() / height());
  }
  update();
}

void SceneView::mouseReleaseEvent(QMouseEvent*) {
  if (const auto hold = std::exchange(hold_, std::nullopt); hold && let_go) let_go(*hold);
  update();
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
  const auto at = take_hold(event->position());
  if (at && taken) taken(*at);
}

void SceneView::wheelEvent(QWheelEvent* event) {
  free_view();
  orbit_.zoom(std::pow(kZoomStep, event->angleDelta().y() / kNotch));
  update();
}

void SceneView::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  if (view_ != "free" && now_) set_view(view_);
}

}  // namespace verp::view
