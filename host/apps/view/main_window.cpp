#include "host/apps/view/main_window.hpp"

#include <QCloseEvent>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>
#include <QUndoGroup>
#include <QUndoStack>
#include <chrono>

#include "common/gait/types.hpp"
#include "common/safety/machine.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/view/editor_panel.hpp"
#include "host/apps/view/plot_panel.hpp"
#include "host/apps/view/pose_panel.hpp"
#include "host/apps/view/safety_panel.hpp"
#include "host/apps/view/signal_tree.hpp"
#include "host/apps/view/state_panel.hpp"
#include "host/apps/view/theme.hpp"
#include "host/apps/view/transport.hpp"
#include "host/apps/view/tuning_panel.hpp"
#include "host/run/session/fault_names.hpp"

namespace verp::view {
namespace {

constexpr int kNumbersEvery = 4;                          // frames; faster is illegible
constexpr scene::Colour kLinked{0.16F, 0.47F, 0.86F, 1};  // the robot at the link
constexpr int kLayout = 1;                                // version of the saved layout

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
      undos_(new QUndoGroup(this)),
      scene_(new SceneView(this)),
      plots_(new PlotPanel(this)),
      signals_(new SignalTree(this)),
      safety_(new SafetyPanel(this)),
      tuning_(new TuningPanel(*undo_, this)),
      pose_(new PosePanel(this)),
      state_(new StatePanel(this)),
      transport_(new Transport(this)),
      timer_(new QTimer(this)) {
  setWindowTitle("verp view");
  resize(1280, 740);  // fits 800 lines with a desktop's bars
  setCentralWidget(scene_);
  make_editor();
  addToolBar(Qt::BottomToolBarArea, transport_);
  make_docks();
  make_menus();
  make_status();
  scene_->effects() = render::Effects::explained();
  scene_->failed = [this](const std::string& why) {
    failure_ = why;
    close();
  };
  scene_->noted = [this](const std::string& what) {
    say(QString::fromStdString(what));
    if (told_.insert(what).second) cli::complain("verp view: " + what);
  };
  scene_->held = [this](const SceneView::Hold& at) { hold(at); };
  scene_->let_go = [this](const SceneView::Hold& at) { let_go(at); };
  plots_->sought = [this](double t_s) {
    if (player_) player_->seek(t_s);
  };
  signals_->ticked = [this](int signal, bool on) { plots_->set_shown(signal, on); };
  tuning_->wanted = [this](int id, float value) {
    if (shadow_) shadow_->write(id, value);
    if (live() == nullptr) return;
    live()->touch([id, value](LiveRun::Hands& hands) { hands.orders.write(id, value); });
  };
  state_->stepped = [this](int ticks) { step_on(ticks); };
  pose_->changed = [this] { pick_up(); };
  first_layout_ = saveState(kLayout);
  restore();
  scene_->say("Open a robot or a trace: Ctrl+O");
  connect(timer_, &QTimer::timeout, this, [this] { frame(); });
  timer_->start(frame_ms(0));
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
  QDockWidget* state = add("State", state_, Qt::RightDockWidgetArea);
  tabifyDockWidget(safety, tuning);
  tabifyDockWidget(tuning, pose);
  tabifyDockWidget(pose, state);
  tabifyDockWidget(state, add("Editor", editor_, Qt::RightDockWidgetArea));
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
  link_told_ = add("status_link", 0, 0);
  digest_ = add("status_digest", 0, 210);
  digest_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  digest_->setToolTip("What names the whole run to this tick: equal without a window");
}

void MainWindow::watch(RunSetup setup) {
  entity_ = std::make_shared<const scene::Entity>(setup.plan().entity);
  const QString file = QString::fromStdString(setup.plan().entity.file);
  const Params params = setup.plan().params;
  trace_.reset();
  linked_.reset();
  if (!link_.empty()) {
    linked_ = std::make_shared<Linked>(link_, entity_, params);
    setup.beside = [linked = linked_](const scene::RobotView& own) { return linked->beside(own); };
  }
  player_ = std::make_unique<Player>(std::move(setup));
  steering_ = std::make_unique<Steering>(params);
  tuning_->set_robot(params.tuning, true);
  pose_->set_robot(entity_, params);
  remember(file);
  editor_->open(file.toStdString());
  show_film(QString::fromStdString(entity_->name));
  player_->play();
}

void MainWindow::watch(const std::filesystem::path& trace) {
  const auto film = std::make_shared<const TraceFilm>(trace);
  player_ = std::make_unique<Player>(film);
  steering_.reset();
  linked_.reset();
  trace_ = film;
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
  shadow_.reset();
  state_index_ = ~std::size_t{0};
  link_told_->setText("");
  pose_->set_posing(false);
  film_.reset();
  safety_->clear();
  stop_->setEnabled(player_->live() != nullptr);
  edited_.reset();
  show_scene();
  scene_->show_picture([&] {
    auto first = std::make_shared<scene::Snapshot>();
    first->robots.push_back(scene::standing(*entity_));
    return first;
  }());
  scene_->say("");
  const std::vector<int> ticked = plots_->shown();
  const std::vector<Signal> all = player_->film()->all_signals();
  signals_->set_signals(all);
  plots_->clear();
  transport_->set_player(player_.get());
  frame();
  signals_->set_ticked(ticked.empty() ? std::vector<int>{signal_number(all, "ZMP y"),
                                                         signal_number(all, "ZMP planned y")}
                                      : ticked);
  setWindowTitle(name + " – verp view");
}

scene::Scene MainWindow::scene_of_all() {
  const LiveRun* run = live();
  scene::Scene scene = scene::surroundings(run != nullptr ? run->setup().run.world.scenery.get()
                                                          : player_->film()->world());
  scene::add_robot(scene, *entity_);
  if (run == nullptr) return scene;
  const RunSetup& setup = run->setup();
  if (setup.beside) scene::tint(scene, scene::add_robot(scene, *entity_), kLinked);
  for (std::size_t i = 1; i < setup.run.plans.size(); ++i)
    scene::add_robot(scene, setup.run.plans[i].entity);
  return scene;
}

void MainWindow::open(const QString& file) {
  try {
    if (file.endsWith(".mcap")) return watch(std::filesystem::path(file.toStdString()));
    watch(make_run_(file.toStdString()));
  } catch (const std::exception& error) {
    // Opens it anyway: the user can repair an unsound robot.
    if (!file.endsWith(".mcap")) editor_->open(file.toStdString());
    say(QString::fromUtf8(error.what()));
  }
}

void MainWindow::frame() {
  ++frames_;
  if (!player_) return;
  poll_gamepad();
  if (const auto film = player_->film(); film != film_) {
    film_ = film;
    plots_->set_film(film_);
    safety_->clear();
  }
  const bool goes_on = live() != nullptr && player_->playing();
  const int next_ms = frame_ms(goes_on ? live()->status().late_s : 0);
  if (timer_->interval() != next_ms) timer_->setInterval(next_ms);
  const Picture now = player_->now(wall_s());
  const bool posing = pose_->posing();
  if (edited_ && player_->playing()) {
    edited_.reset();
    show_scene();
  }
  if (!posing && !edited_) scene_->show_picture(with_shadow(now));
  if (now) safety_->show_robot(now->t_s, now->robots.front());
  if (frames_ % kNumbersEvery != 0) return;
  transport_->refresh();
  plots_->refresh(player_->shown_s(), player_->live() != nullptr);
  if (now) show_numbers(*now);
  show_link();
  show_state();
}

void MainWindow::show_numbers(const scene::Snapshot& now) {
  const scene::RobotView& robot = now.robots.front();
  const bool beside = live() != nullptr && live()->setup().beside;
  signals_->set_values(values_of(robot, *entity_, beside ? &now.robots.at(1) : nullptr));
  mode_->setText(QString("%1 · %2").arg(safety::kModeNames[robot.mode % safety::kModes],
                                        phase_name(robot.phase)));
  const std::string faults = session::fault_names(robot.faults);
  faults_->setText(faults.empty() ? "no faults" : QString::fromStdString(faults));
  show_get_up(robot);
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

void MainWindow::closeEvent(QCloseEvent* event) {
  settings_.setValue("geometry", saveGeometry());
  settings_.setValue("layout", saveState(kLayout));
  timer_->stop();
  event->accept();
}

}  // namespace verp::view
