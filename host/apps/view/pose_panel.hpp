#pragma once
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "host/apps/view/run/film.hpp"
#include "host/apps/view/run/pose_hand.hpp"

class QCheckBox;
class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QSlider;

namespace verp::view {

/// For a robot held in the air: joint sliders, and the reach of a dragged foot.
class PosePanel final : public QWidget {
 public:
  explicit PosePanel(QWidget* parent = nullptr);

  void set_robot(std::shared_ptr<const scene::Entity> entity, const Params& params);
  bool posing() const;
  void set_posing(bool posing);
  PoseHand* hand() { return hand_.get(); }
  void drag_link(int node, const scene::Vec3& point_link_m, const scene::Vec3& to_world_m);
  void drag_foot(int side, const scene::Vec3& sole_world_m);
  scene::Vec3 sole_world_m(int side) const;
  scene::Vec3 in_link_m(int node, const scene::Vec3& at_world_m) const;
  Picture picture() const;

  std::function<void()> changed;  ///< the pose, or whether the robot is held

 private:
  void show_hand();

  std::shared_ptr<const scene::Entity> entity_;
  Params params_;
  std::unique_ptr<PoseHand> hand_;
  QCheckBox* posing_;
  QLabel* legs_;
  std::string link_;  ///< dragged last
  QWidget* joints_ = nullptr;
  QGridLayout* grid_ = nullptr;
  std::vector<QSlider*> sliders_;
  std::vector<QLabel*> angles_;
};

}  // namespace verp::view
