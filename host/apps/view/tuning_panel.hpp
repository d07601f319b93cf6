#pragma once
#include <QWidget>
#include <functional>
#include <vector>

#include "common/model/tuning.hpp"

class QDoubleSpinBox;
class QUndoStack;
class QLabel;

namespace verp::view {

/// Changes go on the undo stack.
class TuningPanel final : public QWidget {
 public:
  TuningPanel(QUndoStack& undo, QWidget* parent = nullptr);

  void set_robot(const Tuning& own, bool live);
  /// Numbers in effect.
  void show_tuning(const Tuning& tuning);

  std::function<void(int id, float value)> wanted;

 private:
  void edited(int id, double value);
  void set_box(int id, float value);
  void mark(int id);

  QUndoStack& undo_;
  QLabel* hint_;
  std::vector<QDoubleSpinBox*> boxes_;
  Tuning own_, asked_, seen_;  ///< seen_: last seen in effect
};

}  // namespace verp::view
