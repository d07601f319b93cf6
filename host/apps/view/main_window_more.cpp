#include <QLabel>
#include <QPushButton>

#include "common/safety/machine.hpp"
#include "host/apps/view/main_window.hpp"
#include "host/apps/view/state_panel.hpp"
#include "host/apps/view/tuning_panel.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/run/session/fault_names.hpp"
#include "host/show/scene/plan_marks.hpp"

// Links, gamepads, and a trace's State.
namespace verp::view {

void MainWindow::link_to(const std::string& link) {
  link::parse_endpoint(link);
  link_ = link;
}

void MainWindow::show_link() {
  if (!linked_) return;
  const Linked::Told told = linked_->told();
  if (told.looks == 0 || told.lost) {
    link_told_->setText((told.lost ? "link lost: " : "link: ") +
                        QString::fromStdString(told.trouble));
    return;
  }
  const std::string faults = session::fault_names(told.robot.faults);
  link_told_->setText(QString("link: %1 · tick %2%3")
                          .arg(safety::kModeNames[told.robot.mode % safety::kModes])
                          .arg(told.tick)
                          .arg(faults.empty() ? "" : " · " + QString::fromStdString(faults)));
}

void MainWindow::steer_by(const std::string& gamepad) {
  gamepad_ = std::make_unique<Gamepad>(gamepad);
}

void MainWindow::poll_gamepad() {
  if (!gamepad_) return;
  const Gamepad::News news = gamepad_->poll();
  const Sticks sticks = gamepad_->sticks();
  if (news.stop) stop_->setChecked(true);
  if (news.stand) drive([](Steering& steering) { steering.stop(); });
  if (news.moved) {
    drive([&](Steering& steering) { steering.lean(sticks.ahead, sticks.left, sticks.turn); });
  }
  const QString name = QString::fromStdString(gamepad_->device());
  if (news.came) say("Gamepad " + name + ": it steers now");
  if (news.went) say("Gamepad " + name + ": unplugged; what it held is let go");
}

void MainWindow::show_state() {
  if (!player_ || !state_->isVisible()) return;
  if (!trace_) {
    if (state_index_ == ~std::size_t{0}) {
      state_->show_none("State at any tick is a trace's: save the run (Ctrl+S) and open it");
      state_index_ = 0;
    }
    return;
  }
  const scene::TracePlayer& player = trace_->player();
  std::size_t index = player.index_at(player_->shown_s());
  if (shadow_ && index != shadow_->index()) step_on(0);  // the user moved
  if (index == state_index_) return;
  state_index_ = index;
  StatePanel::Tick recorded;
  recorded.inputs = player.trace().ticks[index].inputs;
  player.controller_at(index, recorded.state, recorded.outputs);
  if (!shadow_) {
    tuning_->show_tuning(recorded.state.tuning);
    state_->show_tick(recorded, nullptr);
    return state_->say("");
  }
  tuning_->show_tuning(shadow_->state().tuning);
  state_->show_tick({shadow_->state(), shadow_->inputs(), shadow_->outputs()}, &recorded);
  state_->say(
      shadow_->same_bits()
          ? QString("Goes on by itself: the bits that were recorded")
          : QString("Goes on by itself: %1 fields are not as recorded").arg(state_->different()));
}

void MainWindow::step_on(int ticks) {
  if (!trace_) return;
  const scene::TracePlayer& player = trace_->player();
  state_index_ = ~std::size_t{0};
  if (ticks == 0) {
    if (shadow_) tuning_->set_robot(player.trace().params.tuning, false);
    shadow_.reset();
    return;
  }
  player_->pause();
  if (!shadow_) {
    shadow_ = std::make_unique<StepOn>(player, player.index_at(player_->shown_s()));
    tuning_->set_robot(shadow_->state().tuning, true);
  }
  shadow_->on(ticks);
  player_->seek((shadow_->inputs().tick + 0.5) * player.trace().period_s());
}

/// The robot with the continuing controller's goals.
Picture MainWindow::with_shadow(Picture now) const {
  if (!shadow_ || !now || now->robots.empty()) return now;
  auto picture = std::make_shared<scene::Snapshot>(*now);
  scene::add_outputs(picture->robots.front(), shadow_->outputs(), trace_->player().trace().params);
  return picture;
}

}  // namespace verp::view
