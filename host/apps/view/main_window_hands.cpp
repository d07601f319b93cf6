#include <QAction>
#include <QFileDialog>
#include <QPushButton>
#include <cmath>

#include "common/safety/machine.hpp"
#include "host/apps/view/main_window.hpp"
#include "host/apps/view/pose_panel.hpp"

namespace verp::view {
namespace {

constexpr double kPush_n_m = 100;  // per metre of drag
constexpr double kPush_s = 0.1;

}  // namespace

void MainWindow::drive(const std::function<void(Steering&)>& how) {
  if (!steering_ || !player_ || player_->live() == nullptr) return;
  how(*steering_);
  player_->live()->touch(
      [command = steering_->command()](LiveRun::Hands& hands) { hands.orders.take(command); });
  const Command& asked = steering_->command();
  say(asked.request == Request::kWalk
          ? QString("walk %1 m/s ahead, %2 m/s left, %3 rad/s")
                .arg(1e-4 * asked.vx_tenth_mm_s, 0, 'f', 2)
                .arg(1e-4 * asked.vy_tenth_mm_s, 0, 'f', 2)
                .arg(1e-3 * asked.wz_mrad_s, 0, 'f', 2)
          : QString(asked.request == Request::kStand ? "stand" : "sit down and let go"));
  if (!player_->playing()) player_->play();
}

void MainWindow::stop(bool pressed) {
  if (!player_ || player_->live() == nullptr) return;
  player_->live()->touch(
      [pressed](LiveRun::Hands& hands) { hands.orders.press_emergency_stop(pressed); });
  stop_->setText(pressed ? "Release stop" : "Emergency stop");
}

/// The robot obeys only the window, and stands once up.
void MainWindow::get_up() {
  if (live() == nullptr || !steering_ || !get_up_->isEnabled()) return;
  steering_->stop();
  live()->touch([command = steering_->command()](LiveRun::Hands& hands) {
    hands.orders.take(command);
    hands.orders.get_up();
  });
  if (!player_->playing()) player_->play();
}

void MainWindow::show_get_up(const scene::RobotView& robot) {
  const bool can = live() != nullptr && !live()->setup().plan().actions.empty();
  const bool limp = !safety::has_torque(static_cast<safety::Mode>(robot.mode));
  const bool offered = can && limp && robot.fallen;
  get_up_->setEnabled(offered);
  up_->setEnabled(offered);
  by_itself_->setEnabled(can);
  const QString why =
      can || live() == nullptr ? "" : "this robot has no actions get_up_front and get_up_back";
  up_->setToolTip(why);
  by_itself_->setToolTip(why);
  const LiveRun::Status status = can ? live()->status() : LiveRun::Status{};
  by_itself_->setChecked(status.gets_up_by_itself);
  if (status.happened != happened_ && !status.happened.empty())
    say(QString::fromStdString(status.happened));
  happened_ = status.happened;
}

void MainWindow::pick_up() {
  if (!player_) return;
  if (!pose_->posing()) return scene_->say("");
  if (player_->playing()) player_->pause();
  scene_->say("In the hand: no physics");
  scene_->show_picture(pose_->picture());
}

void MainWindow::hold(const SceneView::Hold& at) {
  if (!pose_->posing()) {
    const session::Intervention push = push_of(at);
    return scene_->say(QString("push %1 with %2 N for %3 s: let go")
                           .arg(QString::fromStdString(push.name))
                           .arg(push.force_world_n.norm(), 0, 'f', 1)
                           .arg(push.for_s));
  }
  const int side = pose_->hand()->foot_of(at.node);
  if (side < 0) {
    if (!grip_link_m_) grip_link_m_ = pose_->in_link_m(at.node, at.at_world_m);
    return pose_->drag_link(at.node, *grip_link_m_, at.to_world_m);
  }
  if (!foot_from_m_) foot_from_m_ = pose_->sole_world_m(side);
  pose_->drag_foot(side, *foot_from_m_ + at.to_world_m - at.at_world_m);
}

void MainWindow::let_go(const SceneView::Hold& at) {
  foot_from_m_.reset();
  grip_link_m_.reset();
  if (pose_->posing() || !player_ || player_->live() == nullptr) return;
  scene_->say("");
  player_->live()->intervene(push_of(at));
  say("Pushed: " + QString::fromStdString(session::in_words(push_of(at))));
}

session::Intervention MainWindow::push_of(const SceneView::Hold& at) const {
  session::Intervention push{.kind = session::Intervention::Kind::kPush, .name = {}};
  push.name = entity_->nodes[static_cast<std::size_t>(at.node)].name;
  push.force_world_n = kPush_n_m * (at.to_world_m - at.at_world_m);
  // Rounded, as a user would type it.
  for (double& axis : push.force_world_n) axis = std::round(10 * axis) / 10;
  push.for_s = kPush_s;
  return push;
}

void MainWindow::save_trace() {
  if (!player_ || player_->live() == nullptr) return say("There is no run to save");
  const QString file =
      QFileDialog::getSaveFileName(this, "Save the run as a trace", "run.mcap", "Traces (*.mcap)");
  if (file.isEmpty()) return;
  const std::string lost = player_->live()->save(file.toStdString());
  say(lost.empty() ? "Saved " + file : QString::fromStdString(lost));
}

}  // namespace verp::view
