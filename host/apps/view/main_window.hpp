#pragma once
#include <QMainWindow>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "host/apps/view/run/gamepad.hpp"
#include "host/apps/view/run/linked.hpp"
#include "host/apps/view/run/player.hpp"
#include "host/apps/view/run/steering.hpp"
#include "host/apps/view/run/step_on.hpp"
#include "host/apps/view/run/trace_film.hpp"
#include "host/apps/view/scene_view.hpp"
#include "host/show/scene/build.hpp"

class QAction;
class QLabel;
class QPushButton;
class QSettings;
class QTimer;
class QUndoGroup;
class QUndoStack;

namespace verp::view {

class EditorPanel;
class PlotPanel;
class PosePanel;
class SafetyPanel;
class SignalTree;
class StatePanel;
class Transport;
class TuningPanel;

/// One robot in the twin or in a trace. Connects Player, which holds what it shows, and LiveRun,
/// which acts on the robot.
class MainWindow final : public QMainWindow {
 public:
  /// Makes the run of a robot by name or file; throws an exception with one line of text.
  using MakeRun = std::function<RunSetup(const std::string& model)>;
  MainWindow(QSettings& settings, MakeRun make_run);
  ~MainWindow() override;

  void watch(RunSetup setup);
  /// Throws record::TraceError.
  void watch(const std::filesystem::path& trace);
  /// Shows the controller at that link beside each robot opened later. Throws link::EndpointError.
  void link_to(const std::string& link);
  /// Steers by that joystick whenever it is plugged in.
  void steer_by(const std::string& gamepad);
  /// Opens a robot's file or a trace; the window shows failures.
  void open(const QString& file);

  Player* player() { return player_.get(); }
  SceneView& scene() { return *scene_; }
  PlotPanel& plots() { return *plots_; }
  PosePanel& pose() { return *pose_; }
  EditorPanel& editor() { return *editor_; }

  /// Why it closed by itself, or empty.
  const std::string& failure() const { return failure_; }
  /// Completes the run's record; returns the loss, or empty.
  std::string finish();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  void make_docks();
  void make_menus();
  void make_run_menu();
  void make_corner();
  void make_view_menu();
  void make_help_menu();
  void make_status();
  void restore();
  void show_film(const QString& name);
  scene::Scene scene_of_all();
  void make_editor();
  void show_edited(const scene::Entity& robot);
  void walk_edited(const std::string& file, const std::string& text);
  void choose_link(const std::string& link);
  void show_scene();
  LiveRun* live() const { return player_ ? player_->live() : nullptr; }
  void frame();
  void show_numbers(const scene::Snapshot& now);
  void drive(const std::function<void(Steering&)>& how);
  void stop(bool pressed);
  void get_up();
  void show_get_up(const scene::RobotView& robot);
  void pick_up();
  void hold(const SceneView::Hold& hold);
  void let_go(const SceneView::Hold& hold);
  session::Intervention push_of(const SceneView::Hold& at) const;
  void remember(const QString& file);
  void fill_recent();
  void save_trace();
  void poll_gamepad();
  void show_link();
  void show_state();
  void step_on(int ticks);
  Picture with_shadow(Picture now) const;
  void say(const QString& text);

  QSettings& settings_;
  const MakeRun make_run_;
  std::string link_;  ///< empty: no link
  std::shared_ptr<Linked> linked_;
  std::unique_ptr<Gamepad> gamepad_;
  std::unique_ptr<Player> player_;
  std::shared_ptr<const TraceFilm> trace_;     ///< null in a run
  std::unique_ptr<StepOn> shadow_;             ///< continues from a tick of the trace
  std::size_t state_index_ = ~std::size_t{0};  ///< tick shown in the panel
  std::shared_ptr<const Film> film_;
  std::shared_ptr<const scene::Entity> entity_;
  std::unique_ptr<Steering> steering_;
  std::shared_ptr<const scene::Entity> edited_;  ///< shown until time goes on
  std::string chosen_link_;                      ///< in the editor
  QUndoStack* undo_;
  QUndoGroup* undos_;
  SceneView* scene_;
  PlotPanel* plots_;
  SignalTree* signals_;
  SafetyPanel* safety_;
  TuningPanel* tuning_;
  PosePanel* pose_;
  EditorPanel* editor_ = nullptr;
  StatePanel* state_;
  Transport* transport_;
  QTimer* timer_;
  QPushButton *stop_, *up_;
  QAction *get_up_ = nullptr, *by_itself_ = nullptr;
  QMenu* recent_ = nullptr;
  QMenu* docks_ = nullptr;
  QLabel *mode_, *speed_, *faults_, *link_told_, *digest_;
  QByteArray first_layout_;
  std::string failure_, said_, happened_;
  std::set<std::string> told_;              ///< notes already reported
  std::optional<scene::Vec3> grip_link_m_;  ///< grip on a link other than a foot, in its frame
  std::optional<scene::Vec3> foot_from_m_;  ///< where the drag of the foot began
  int frames_ = 0;
};

}  // namespace verp::view
