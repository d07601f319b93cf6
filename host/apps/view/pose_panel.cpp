#include "host/apps/view/pose_panel.hpp"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QVBoxLayout>
#include <cmath>

namespace verp::view {
namespace {

constexpr double kSteps_rad = 1000;  // slider steps per radian
constexpr double kDegrees = 180 / 3.14159265358979323846;

}  // namespace

PosePanel::PosePanel(QWidget* parent)
    : QWidget(parent),
      posing_(new QCheckBox("Hold the robot in the air", this)),
      legs_(new QLabel(this)) {
  setObjectName("pose");
  posing_->setObjectName("posing");
  auto* stand = new QPushButton("Stand", this);
  auto* hint = new QLabel(
      "No physics here. Move joints below, or drag a foot, a hand or any link with Shift.", this);
  hint->setObjectName("hint");
  hint->setWordWrap(true);
  legs_->setObjectName("reach");
  legs_->setWordWrap(true);
  auto* top = new QHBoxLayout;
  top->addWidget(posing_, 1);
  top->addWidget(stand);
  auto* scroll = new QScrollArea(this);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  joints_ = new QWidget;
  grid_ = new QGridLayout(joints_);
  grid_->setContentsMargins(0, 0, 6, 0);
  grid_->setVerticalSpacing(3);
  grid_->setColumnStretch(1, 1);
  scroll->setWidget(joints_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(top);
  layout->addWidget(hint);
  layout->addWidget(legs_);
  layout->addWidget(scroll, 1);
  connect(posing_, &QCheckBox::toggled, this, [this] {
    if (changed) changed();
  });
  connect(stand, &QPushButton::clicked, this, [this] {
    if (!hand_) return;
    hand_->stand();
    show_hand();
  });
}

void PosePanel::set_robot(std::shared_ptr<const scene::Entity> entity, const Params& params) {
  entity_ = std::move(entity);
  params_ = params;
  hand_ = std::make_unique<PoseHand>(*entity_, params_);
  while (QLayoutItem* item = grid_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  sliders_.clear();
  angles_.clear();
  for (std::size_t j = 0; j < entity_->joints.size(); ++j) {
    const model::Joint& joint = entity_->joints[j];
    auto* slider = new QSlider(Qt::Horizontal);
    slider->setObjectName("joint_" + QString::fromStdString(joint.name));
    slider->setRange(int(std::ceil(kSteps_rad * joint.lower_rad)),
                     int(std::floor(kSteps_rad * joint.upper_rad)));
    slider->setToolTip(QString("%1° to %2°")
                           .arg(kDegrees * joint.lower_rad, 0, 'f', 0)
                           .arg(kDegrees * joint.upper_rad, 0, 'f', 0));
    auto* angle = new QLabel;
    angle->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    angle->setMinimumWidth(56);
    const int row = int(j);
    grid_->addWidget(new QLabel(QString::fromStdString(joint.name)), row, 0);
    grid_->addWidget(slider, row, 1);
    grid_->addWidget(angle, row, 2);
    sliders_.push_back(slider);
    angles_.push_back(angle);
    connect(slider, &QSlider::valueChanged, this, [this, row](int value) {
      hand_->set_joint(row, value / kSteps_rad);
      posing_->setChecked(true);
      show_hand();
    });
  }
  grid_->setRowStretch(int(sliders_.size()), 1);
  show_hand();
}

bool PosePanel::posing() const {
  return posing_->isChecked();
}

void PosePanel::set_posing(bool posing) {
  posing_->setChecked(posing);
}

void PosePanel::show_hand() {
  for (std::size_t j = 0; j < sliders_.size(); ++j) {
    const double angle_rad = hand_->joint_rad()[j];
    const QSignalBlocker quiet(sliders_[j]);
    if (!sliders_[j]->isSliderDown()) {
      sliders_[j]->setValue(int(std::lround(kSteps_rad * angle_rad)));
    }
    angles_[j]->setText(QString::fromUtf8("%1°").arg(kDegrees * angle_rad, 0, 'f', 1));
  }
  QStringList lines;
  for (int side = 0; side < kFeet; ++side) {
    lines << QString("%1 foot: %2 (%3)")
                 .arg(side == 0 ? "Left" : "Right", QString::fromStdString(hand_->reach(side)),
                      QString::fromStdString(hand_->solver(side)));
  }
  if (!hand_->link_reach().empty())
    lines << QString::fromStdString(link_ + ": " + hand_->link_reach());
  legs_->setText(lines.join("\n"));
  if (changed) changed();
}

Picture PosePanel::picture() const {
  return hand_ ? std::make_shared<const scene::Snapshot>(hand_->snapshot()) : nullptr;
}

scene::Vec3 PosePanel::sole_world_m(int side) const {
  return hand_->snapshot().robots.front().link_world.front() * hand_->sole_body_m(side);
}

void PosePanel::drag_foot(int side, const scene::Vec3& sole_world_m) {
  const scene::Transform body = hand_->snapshot().robots.front().link_world.front();
  hand_->move_foot(side, body.inverse() * sole_world_m);
  show_hand();
}

scene::Vec3 PosePanel::in_link_m(int node, const scene::Vec3& at_world_m) const {
  const auto now = hand_->snapshot();
  return now.robots.front().link_world.at(std::size_t(node)).inverse() * at_world_m;
}

void PosePanel::drag_link(int node, const scene::Vec3& point_link_m,
                          const scene::Vec3& to_world_m) {
  const scene::Transform body = hand_->snapshot().robots.front().link_world.front();
  link_ = entity_->nodes.at(std::size_t(node)).name;
  hand_->move_link(node, point_link_m, body.inverse() * to_world_m);
  show_hand();
}

}  // namespace verp::view
