#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QShortcut>
#include <QUndoGroup>

#include "host/apps/view/editor_panel.hpp"
#include "host/apps/view/main_window.hpp"
#include "host/apps/view/plot_panel.hpp"
#include "host/apps/view/safety_panel.hpp"
#include "host/apps/view/theme.hpp"
#include "host/apps/view/transport.hpp"
#include "host/os/files/whole.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::view {
namespace {

constexpr int kMostRecent = 8;

bool save_png(const QImage& picture, const QString& file) {
  files::NewFile made(file.toStdString());
  return !made.trouble().any() &&
         picture.save(QString::fromStdString(made.part().string()), "PNG") && !made.keep().any();
}

const char* const kKeys = R"(<table cellpadding="3">
<tr><td><b>W A S D</b>, arrows in the picture</td><td>walk: each press a quarter faster that way</td></tr>
<tr><td><b>Q E</b></td><td>turn left, right</td></tr>
<tr><td><b>Space</b></td><td>stop walking, stand</td></tr>
<tr><td><b>G</b></td><td>get up, of a robot that lies and has actions for it</td></tr>
<tr><td><b>Esc</b></td><td>emergency stop: no torque</td></tr>
<tr><td><b>P</b></td><td>play, pause</td></tr>
<tr><td><b>. ,</b></td><td>one tick on, back</td></tr>
<tr><td><b>[ ]</b></td><td>slower, faster</td></tr>
<tr><td><b>Ctrl+R</b></td><td>from the beginning</td></tr>
<tr><td><b>1 to 6</b></td><td>views; <b>F</b> follows the robot</td></tr>
<tr><td>left drag, right drag, wheel</td><td>turn, move, zoom the picture</td></tr>
<tr><td>gamepad</td><td>sticks walk and turn; first button stands, second: emergency stop</td></tr>
<tr><td><b>Shift</b> + drag on the robot</td><td>in the hand: drag a foot</td></tr>
</table>)";

struct View {
  const char *name, *text;
};
constexpr View kViews[] = {{"three-quarter", "Three-quarter"},
                           {"front", "Front"},
                           {"side", "Side"},
                           {"back", "Back"},
                           {"top", "Top"},
                           {"head", "Robot's eye"}};

}  // namespace

void MainWindow::make_menus() {
  QMenu* file = menuBar()->addMenu("&File");
  file->addAction("&Open…", QKeySequence::Open, this, [this] {
    const QString chosen = QFileDialog::getOpenFileName(
        this, "Open a robot or a trace", settings_.value("folder").toString(),
        "Robots and traces (*.sdf *.urdf *.mcap);;All files (*)");
    if (chosen.isEmpty()) return;
    settings_.setValue("folder", QFileInfo(chosen).absolutePath());
    open(chosen);
  });
  recent_ = file->addMenu("Open &recent");
  connect(recent_, &QMenu::aboutToShow, this, [this] { fill_recent(); });
  fill_recent();
  file->addSeparator();
  file->addAction("&Save the run as a trace…", QKeySequence::Save, this, [this] { save_trace(); });
  file->addAction("Save the edited &robot", QKeySequence("Ctrl+Shift+S"), this, [this] {
    const std::string why = editor_->save();
    say(QString::fromStdString(why.empty() ? "Saved" : why));
  });
  file->addAction("Save the &picture…", this, [this] {
    const QString chosen =
        QFileDialog::getSaveFileName(this, "Save the picture", "picture.png", "Pictures (*.png)");
    if (chosen.isEmpty()) return;
    say(save_png(scene_->grabFramebuffer(), chosen) ? "Saved " + chosen
                                                    : chosen + ": it cannot be written there");
  });
  file->addSeparator();
  file->addAction("&Quit", QKeySequence::Quit, this, &QWidget::close);
  QMenu* edit = menuBar()->addMenu("&Edit");
  QAction* undo = undos_->createUndoAction(this);
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = undos_->createRedoAction(this);
  redo->setShortcut(QKeySequence::Redo);
  edit->addActions({undo, redo});
  make_run_menu();
  make_view_menu();
  make_help_menu();
}

void MainWindow::make_run_menu() {
  QMenu* run = menuBar()->addMenu("&Run");
  run->addActions({transport_->play, transport_->tick, transport_->back, transport_->reset});
  run->addSeparator();
  run->addAction("&Slower", Qt::Key_BracketLeft, this, [this] { transport_->change_speed(-1); });
  run->addAction("&Faster", Qt::Key_BracketRight, this, [this] { transport_->change_speed(1); });
  QMenu* robot = menuBar()->addMenu("R&obot");
  struct Way {
    const char* text;
    Qt::Key key, arrow;
    int ahead, left, turn;
  };
  constexpr Way kWays[] = {{"Walk &ahead", Qt::Key_W, Qt::Key_Up, 1, 0, 0},
                           {"Walk &back", Qt::Key_S, Qt::Key_Down, -1, 0, 0},
                           {"Step to the &left", Qt::Key_A, Qt::Key_Left, 0, 1, 0},
                           {"Step to the &right", Qt::Key_D, Qt::Key_Right, 0, -1, 0},
                           {"&Turn left", Qt::Key_Q, Qt::Key_unknown, 0, 0, 1},
                           {"T&urn right", Qt::Key_E, Qt::Key_unknown, 0, 0, -1}};
  for (const Way& way : kWays) {
    const auto nudge = [this, way] {
      drive([&](Steering& steering) { steering.nudge(way.ahead, way.left, way.turn); });
    };
    robot->addAction(way.text, way.key, this, nudge);
    if (way.arrow == Qt::Key_unknown) continue;
    auto* arrow = new QShortcut(QKeySequence(way.arrow), scene_);
    arrow->setContext(Qt::WidgetShortcut);
    connect(arrow, &QShortcut::activated, this, nudge);
  }
  robot->addAction("S&tand", Qt::Key_Space, this, [this] { drive([](Steering& s) { s.stop(); }); });
  robot->addAction("Sit down and let &go", this, [this] { drive([](Steering& s) { s.relax(); }); });
  robot->addSeparator();
  robot->addAction("Set it &upright", this, [this] {
    if (!player_ || player_->live() == nullptr) return;
    drive([](Steering& s) { s.relax(); });
    player_->live()->touch([](LiveRun::Hands& hands) {
      if (!hands.robot.set_upright()) throw std::runtime_error("not now: a servo has torque");
    });
  });
  get_up_ = robot->addAction("&Get up", Qt::Key_G, this, [this] { get_up(); });
  by_itself_ = robot->addAction("Get up by it&self");
  by_itself_->setObjectName("gets_up_by_itself");
  by_itself_->setCheckable(true);
  connect(by_itself_, &QAction::triggered, this, [this](bool on) {
    if (live() != nullptr) live()->let_get_up(on);
  });
  make_corner();
}

/// Buttons for urgent actions, always visible.
void MainWindow::make_corner() {
  const auto button = [](const char* text, const char* name) {
    auto* made = new QPushButton(text);
    made->setObjectName(name);
    made->setFocusPolicy(Qt::NoFocus);
    made->setEnabled(false);
    return made;
  };
  up_ = button("Get up", "get_up");
  get_up_->setEnabled(false);
  by_itself_->setEnabled(false);
  connect(up_, &QPushButton::clicked, this, [this] { get_up(); });
  stop_ = button("Emergency stop", "stop");
  stop_->setCheckable(true);
  stop_->setShortcut(Qt::Key_Escape);
  connect(stop_, &QPushButton::toggled, this, [this](bool pressed) { stop(pressed); });
  auto* corner = new QWidget(this);
  auto* row = new QHBoxLayout(corner);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(up_);
  row->addWidget(stop_);
  menuBar()->setCornerWidget(corner);
}

void MainWindow::make_view_menu() {
  QMenu* view = menuBar()->addMenu("&View");
  int key = Qt::Key_1;
  for (const View& each : kViews) {
    view->addAction(each.text, QKeySequence(key++), this, [this, each] {
      if (!scene_->set_view(each.name)) say("This robot's file declares no camera");
    });
  }
  QAction* follow = view->addAction("&Follow the robot");
  follow->setShortcut(Qt::Key_F);
  follow->setCheckable(true);
  follow->setChecked(true);
  connect(follow, &QAction::toggled, this, [this](bool on) { scene_->set_follow(on); });
  view->addSeparator();
  QMenu* marks = view->addMenu("&Show");
  marks->setObjectName("show");
  const auto mark = [this, marks](const char* text, bool render::Effects::*effect) {
    QAction* action = marks->addAction(text);
    connect(marks, &QMenu::aboutToShow, action, [this, action, effect] {
      const QSignalBlocker quiet(action);
      action->setChecked(scene_->effects().*effect);
    });
    action->setCheckable(true);
    const render::Effects explained = render::Effects::explained();
    action->setChecked(explained.*effect);
    connect(action, &QAction::toggled, this, [this, effect](bool on) {
      scene_->effects().*effect = on;
      scene_->update();
    });
  };
  using E = render::Effects;
  mark("Centre of mass", &E::com);
  mark("ZMP", &E::zmp);
  mark("Support polygon", &E::support);
  mark("Contact forces", &E::contacts);
  mark("Footsteps", &E::footsteps);
  mark("Trails", &E::trails);
  mark("Goals, see-through", &E::goals);
  mark("Axes of links", &E::axes);
  mark("Collision shapes", &E::collisions);
  marks->addSeparator();
  mark("Shadows", &E::shadows);
  mark("Antialiasing", &E::antialias);
  mark("Coarse shadows, quicker", &E::quick);
  mark("Fog", &E::fog);
  mark("Textures", &E::textures);
  mark("Transparency", &E::transparency);
  mark("Sky", &E::sky);
  mark("Floor", &E::ground);
  mark("Floor's grid", &E::ground_grid);
  view->addAction("&Fit plots", Qt::Key_Home, this, [this] { plots_->fit(); });
  QAction* dark = view->addAction("&Dark");
  dark->setCheckable(true);
  dark->setChecked(theme().dark);
  connect(dark, &QAction::toggled, this, [this](bool on) {
    settings_.setValue("dark", on);
    apply_theme(*qApp, on);
    plots_->restyle();
    safety_->clear();
  });
  view->addSeparator();
  for (QDockWidget* dock : findChildren<QDockWidget*>()) view->addAction(dock->toggleViewAction());
  view->addAction("&Reset the layout", this, [this] { restoreState(first_layout_, 1); });
}

void MainWindow::make_help_menu() {
  QMenu* help = menuBar()->addMenu("&Help");
  const auto tell = [this](const QString& title, const QString& text) {
    QMessageBox box(QMessageBox::NoIcon, title, text, QMessageBox::Close, this);
    box.setTextFormat(Qt::RichText);
    box.exec();
  };
  help->addAction("&Keys and mouse", QKeySequence::HelpContents, this,
                  [tell] { tell("Keys and mouse", kKeys); });
  help->addAction("&About", this, [tell] {
    const auto built = record::build_info();
    tell("About", QString("<b>VERP</b>: a humanoid robot's controller and its twin.<br>"
                          "What you see is what runs on the robot, bit for bit.<br><br>"
                          "Revision %1<br>%2")
                      .arg(QString::fromStdString(built.at("source_revision")),
                           QString::fromStdString(built.at("compiler"))));
  });
}

void MainWindow::remember(const QString& file) {
  if (file.isEmpty()) return;
  QStringList all = settings_.value("recent").toStringList();
  all.removeAll(file);
  all.prepend(file);
  settings_.setValue("recent", QStringList(all.mid(0, kMostRecent)));
  fill_recent();
}

void MainWindow::fill_recent() {
  recent_->clear();
  for (const QString& file : settings_.value("recent").toStringList()) {
    QAction* action = recent_->addAction(file, this, [this, file] { open(file); });
    action->setEnabled(QFileInfo::exists(file));
  }
  if (recent_->isEmpty()) recent_->addAction("Nothing yet")->setEnabled(false);
}

}  // namespace verp::view
