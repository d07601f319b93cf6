#include "host/view/main_window.hpp"

#include <QCloseEvent>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>
#include <QUndoStack>
#include <chrono>
#include <cmath>

#include "common/gait/types.hpp"
#include "common/safety/machine.hpp"
#include "host/session/fault_names.hpp"
#include "host/view/plot_panel.hpp"
#include "host/view/pose_panel.hpp"
#include "host/view/run/trace_film.hpp"
#include "host/view/safety_panel.hpp"
#include "host/view/signal_tree.hpp"
#include "host/view/theme.hpp"
#include "host/view/transport.hpp"
#include "host/view/tuning_panel.hpp"

namespace verp::view {
namespace {

constexpr int kFrame_ms = 33;
constexpr int kNumbersEvery = 4;   // frames: nobody reads faster
constexpr double kPush_n_m = 100;  // of a drag
constexpr double kPush_s = 0.1;
constexpr int kLayout = 1;  // version of what is remembered of it

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

const char* phase_name(int phase) {
  constexpr const char* kNames[] = {"idle", "start", "transition", "finalisation"};
  return phase < 4 ? kNames[phase] : "?";
}

}  // namespace

MainWindow::MainWindow(QSettings& settings, MakeRun make_run)
    : settings_(settings),
      make_run_(std::move(make_run)),
      undo_(new QUndoStack(this)),
      scene_(new SceneView(this)),
      plots_(new PlotPanel(this)),
      signals_(new SignalTree(this)),
      safety_(new SafetyPanel(this)),
      tuning_(new TuningPanel(*undo_, this)),
      pose_(new PosePanel(this)),
      transport_(new Transport(this)),
      timer_(new QTimer(this)) {
  setWindowTitle("verp view");
  resize(1280, 740);  // with a desktop's bars on a screen of 800 lines
  setCentralWidget(scene_);
  addToolBar(Qt::BottomToolBarArea, transport_);
  make_docks();
  make_menus();
  make_status();
  scene_->effects() = render::Effects::explained();
  scene_->failed = [this](const std::string& why) {
    failure_ = why;
    close();
  };
  scene_->held = [this](const SceneView::Hold& at) { hold(at); };
  scene_->let_go = [this](const SceneView::Hold& at) { let_go(at); };
  plots_->sought = [this](double t_s) {
    if (player_) player_->seek(t_s);
  };
  signals_->ticked = [this](int signal, bool on) { plots_->set_shown(signal, on); };
  tuning_->wanted = [this](int id, float value) {
    if (!player_ || player_->live() == nullptr) return;
    player_->live()->touch([id, value](LiveRun::Hands& hands) { hands.orders.write(id, value); });
  };
  pose_->changed = [this] { pick_up(); };
  first_layout_ = saveState(kLayout);
  restore();
  scene_->say("Open a robot or a trace: Ctrl+O");
  connect(timer_, &QTimer::timeout, this, [this] { frame(); });
  timer_->start(kFrame_ms);
}

MainWindow::~MainWindow() = default;

void MainWindow::make_docks() {
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  setTabPosition(Qt::RightDockWidgetArea, QTabWidget::North);
  const auto add = [this](const char* title, QWidget* content, Qt::DockWidgetArea area) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(QString("dock_") + title);
    dock->setWidget(content);
    addDockWidget(area, dock);
    return dock;
  };
  QDockWidget* signal = add("Signals", signals_, Qt::LeftDockWidgetArea);
  QDockWidget* plots = add("Plots", plots_, Qt::BottomDockWidgetArea);
  QDockWidget* safety = add("Safety", safety_, Qt::RightDockWidgetArea);
  QDockWidget* tuning = add("Tuning", tuning_, Qt::RightDockWidgetArea);
  QDockWidget* pose = add("Pose", pose_, Qt::RightDockWidgetArea);
  tabifyDockWidget(safety, tuning);
  tabifyDockWidget(tuning, pose);
  safety->raise();
  resizeDocks({signal, safety}, {260, 330}, Qt::Horizontal);
  resizeDocks({plots}, {190}, Qt::Vertical);
}

void MainWindow::make_status() {
  const auto add = [this](const char* name, int stretch, int width_px) {
    auto* label = new QLabel(this);
    label->setMinimumWidth(width_px);
    label->setObjectName(name);
    label->setContentsMargins(6, 0, 10, 0);
    statusBar()->addWidget(label, stretch);
    return label;
  };
  mode_ = add("status_mode", 0, 170);
  speed_ = add("status_speed", 0, 230);
  faults_ = add("status_faults", 1, 100);
  digest_ = add("status_digest", 0, 210);
  digest_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  digest_->setToolTip("What names the whole run to this tick: equal without a window");
}

void MainWindow::watch(RunSetup setup) {
  entity_ = std::make_shared<const scene::Entity>(setup.plan.entity);
  const QString file = QString::fromStdString(setup.plan.entity.file);
  const Params params = setup.plan.params;
  player_ = std::make_unique<Player>(std::move(setup));
  steering_ = std::make_unique<Steering>(params);
  tuning_->set_robot(params.tuning, true);
  pose_->set_robot(entity_, params);
  remember(file);
  show_film(QString::fromStdString(entity_->name));
  player_->play();
}

void MainWindow::watch(const std::filesystem::path& trace) {
  const auto film = std::make_shared<const TraceFilm>(trace);
  player_ = std::make_unique<Player>(film);
  steering_.reset();
  entity_ = std::make_shared<const scene::Entity>(film->entity());
  const Params& params = film->player().trace().params;
  tuning_->set_robot(params.tuning, false);
  pose_->set_robot(entity_, params);
  remember(QString::fromStdString(std::filesystem::absolute(trace).string()));
  show_film(QString::fromStdString(trace.filename().string()));
  say(QString::fromStdString(film->player().note()));
}

void MainWindow::show_film(const QString& name) {
  undo_->clear();
  pose_->set_posing(false);
  film_.reset();
  safety_->clear();
  stop_->setEnabled(player_->live() != nullptr);
  scene::Scene scene = scene::studio();
  scene::add_robot(scene, *entity_);
  scene_->set_scene(std::move(scene));
  scene_->show_picture([&] {
    auto first = std::make_shared<scene::Snapshot>();
    first->robots.push_back(scene::standing(*entity_));
    return first;
  }());
  scene_->say("");
  const std::vector<int> ticked = plots_->shown();
  const std::vector<Signal> all = signals_of(*entity_);
  signals_->set_signals(all);
  plots_->clear();
  transport_->set_player(player_.get());
  frame();
  signals_->set_ticked(ticked.empty() ? std::vector<int>{signal_number(all, "ZMP y"),
                                                         signal_number(all, "ZMP planned y")}
                                      : ticked);
  setWindowTitle(name + " – verp view");
}

void MainWindow::open(const QString& file) {
  try {
    if (file.endsWith(".mcap")) return watch(std::filesystem::path(file.toStdString()));
    watch(make_run_(file.toStdString()));
  } catch (const std::exception& error) {
    say(QString::fromUtf8(error.what()));
  }
}

void MainWindow::frame() {
  ++frames_;
  if (!player_) return;
  if (const auto film = player_->film(); film != film_) {
    film_ = film;
    plots_->set_film(film_);
    safety_->clear();
  }
  const Picture now = player_->now(wall_s());
  const bool posing = pose_->posing();
  if (!posing) scene_->show_picture(now);
  if (now) safety_->show_robot(now->t_s, now->robots.front());
  if (frames_ % kNumbersEvery != 0) return;
  transport_->refresh();
  plots_->refresh(player_->shown_s(), player_->live() != nullptr);
  if (now) show_numbers(*now);
}

void MainWindow::show_numbers(const scene::Snapshot& now) {
  const scene::RobotView& robot = now.robots.front();
  signals_->set_values(values_of(robot, *entity_));
  mode_->setText(QString("%1 · %2").arg(safety::kModeNames[robot.mode % safety::kModes],
                                        phase_name(robot.phase)));
  const std::string faults = session::fault_names(robot.faults);
  faults_->setText(faults.empty() ? "no faults" : QString::fromStdString(faults));
  LiveRun* live = player_->live();
  if (live == nullptr) {
    speed_->setText(QString("tick %1").arg(now.tick));
    digest_->setText("");
    return;
  }
  const LiveRun::Status status = live->status();
  speed_->setText(QString("tick %1 · %2 of real time")
                      .arg(now.tick)
                      .arg(QString::fromUtf8("%1×").arg(status.real_time_factor, 0, 'f', 2)));
  digest_->setText(QString("digest 0x%1").arg(status.digest, 16, 16, QChar('0')));
  if (status.tuning) tuning_->show_tuning(*status.tuning);
  const std::string told = !status.failure.empty() ? status.failure : status.complaint;
  if (told != said_) say(QString::fromStdString(told));
  said_ = told;
}

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

/// The scene shows the robot in the hand as long as there is one.
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
  if (side < 0) return;
  if (!foot_from_m_) foot_from_m_ = pose_->sole_world_m(side);
  pose_->drag_foot(side, *foot_from_m_ + at.to_world_m - at.at_world_m);
}

void MainWindow::let_go(const SceneView::Hold& at) {
  foot_from_m_.reset();
  if (pose_->posing() || !player_ || player_->live() == nullptr) return;
  scene_->say("");
  player_->live()->intervene(push_of(at));
  say("Pushed: " + QString::fromStdString(session::in_words(push_of(at))));
}

session::Intervention MainWindow::push_of(const SceneView::Hold& at) const {
  session::Intervention push{.kind = session::Intervention::Kind::kPush, .name = {}};
  push.name = entity_->nodes[static_cast<std::size_t>(at.node)].name;
  push.force_world_n = kPush_n_m * (at.to_world_m - at.at_world_m);
  // As a person would type it.
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

void MainWindow::say(const QString& text) {
  if (text.isEmpty()) {
    statusBar()->clearMessage();
  } else {
    statusBar()->showMessage(text, 6000);
  }
}

void MainWindow::restore() {
  restoreGeometry(settings_.value("geometry").toByteArray());
  restoreState(settings_.value("layout").toByteArray(), kLayout);
}

std::string MainWindow::finish() {
  return player_ && player_->live() != nullptr ? player_->live()->finish() : "";
}

void MainWindow::closeEvent(QCloseEvent* event) {
  settings_.setValue("geometry", saveGeometry());
  settings_.setValue("layout", saveState(kLayout));
  timer_->stop();
  event->accept();
}

}  // namespace verp::view
