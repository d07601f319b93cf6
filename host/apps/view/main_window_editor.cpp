#include <unistd.h>

#include <QUndoGroup>
#include <QUndoStack>
#include <algorithm>
#include <filesystem>

#include "host/apps/view/editor_panel.hpp"
#include "host/apps/view/main_window.hpp"
#include "host/apps/view/pose_panel.hpp"
#include "host/os/files/whole.hpp"

namespace verp::view {
namespace {

constexpr scene::Colour kChosen{0.95F, 0.55F, 0.12F, 1};

/// A temporary file beside the robot's, for relative includes.
class Beside {
 public:
  Beside(const std::filesystem::path& file, const std::string& text)
      : path_(file.parent_path() /
              ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".sdf")) {
    const files::Trouble trouble = files::replace(path_, text);
    if (trouble.any())
      throw std::runtime_error(path_.string() + ", which the run is made from: " + trouble.text());
  }
  ~Beside() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace

void MainWindow::make_editor() {
  auto* stack = new QUndoStack(this);
  editor_ = new EditorPanel(*stack, this);
  undos_->addStack(undo_);
  undos_->addStack(stack);
  undos_->setActiveStack(undo_);
  // Undo takes back the latest change of both stacks. The stacks outlive the window.
  connect(stack, &QUndoStack::indexChanged, this, [this, stack] {
    if (stack->count() > 0) undos_->setActiveStack(stack);
  });
  connect(undo_, &QUndoStack::indexChanged, this, [this] {
    if (undo_->count() > 0) undos_->setActiveStack(undo_);
  });
  editor_->said = [this](const std::string& text) { say(QString::fromStdString(text)); };
  editor_->edited = [this](const model::Entity& robot) { show_edited(robot); };
  editor_->chosen = [this](const std::string& link) { choose_link(link); };
  editor_->walk = [this](const std::string& file, const std::string& text) {
    walk_edited(file, text);
  };
  scene_->taken = [this](const SceneView::Hold& at) {
    const auto& robot = edited_ ? edited_ : entity_;
    if (at.robot == 0 && robot) editor_->select("link:" + robot->nodes[std::size_t(at.node)].name);
  };
}

void MainWindow::show_edited(const scene::Entity& robot) {
  if (player_ && player_->playing()) player_->pause();
  pose_->set_posing(false);
  edited_ = std::make_shared<const scene::Entity>(robot);
  show_scene();
  auto now = std::make_shared<scene::Snapshot>();
  now->robots.push_back(scene::standing(*edited_));
  scene_->show_picture(std::move(now));
  scene_->say("As it is edited: no physics");
}

void MainWindow::walk_edited(const std::string& file, const std::string& text) {
  try {
    const Beside beside(file, text);
    RunSetup setup = make_run_(beside.path());
    setup.run.plans.front().entity.file = file;
    watch(std::move(setup));
  } catch (const std::exception& error) {
    say(QString::fromUtf8(error.what()));
  }
}

void MainWindow::choose_link(const std::string& link) {
  if (link == chosen_link_) return;
  chosen_link_ = link;
  if (edited_ || player_) show_scene();
}

void MainWindow::show_scene() {
  scene::Scene scene = edited_ ? scene::studio() : scene_of_all();
  if (edited_) scene::add_robot(scene, *edited_);
  const auto& nodes = (edited_ ? edited_ : entity_)->nodes;
  const auto chosen = std::find_if(nodes.begin(), nodes.end(), [&](const model::Node& node) {
    return node.name == chosen_link_;
  });
  for (scene::Item& item : scene.items) {
    if (item.robot == 0 && item.node == chosen - nodes.begin()) item.material.colour = kChosen;
  }
  scene_->set_scene(std::move(scene));
}

std::string MainWindow::finish() {
  const std::string lost =
      player_ && player_->live() != nullptr ? player_->live()->finish() : std::string();
  if (!editor_->changed()) return lost;
  return lost + (lost.empty() ? "" : "; ") + editor_->put_aside();
}

}  // namespace verp::view
