#pragma once
#include <QWidget>
#include <array>
#include <vector>

#include "host/show/scene/snapshot.hpp"

class QLabel;
class QListWidget;

namespace verp::view {

/// Modes, faults, and a log of changes.
class SafetyPanel final : public QWidget {
 public:
  explicit SafetyPanel(QWidget* parent = nullptr);

  void show_robot(double t_s, const scene::RobotView& robot);
  void clear();

 private:
  void log(double t_s, const QString& text);

  std::vector<QLabel*> modes_, faults_;
  QListWidget* log_;
  int mode_ = -1;
  std::uint32_t bits_ = 0;
  double t_s_ = 0;
};

}  // namespace verp::view
