#pragma once
#include <QWidget>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/control/state.hpp"

class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace verp::view {

/// All fields of State, Inputs and Outputs at a tick. If a controller continues from there, its
/// values stand beside the recorded ones.
class StatePanel final : public QWidget {
 public:
  explicit StatePanel(QWidget* parent = nullptr);

  struct Tick {
    State state;
    Inputs inputs;
    Outputs outputs;
  };
  /// `recorded` is null for the record itself.
  void show_tick(const Tick& now, const Tick* recorded);
  void show_none(const QString& why);
  /// The comparison in words; may be empty.
  void say(const QString& how);

  /// Ticks to continue; 0: back to the record.
  std::function<void(int ticks)> stepped;

  int different() const { return different_; }
  /// Text of a field by its path ("state.gait.phase"); empty if there is no such field.
  QString value(const QString& path) const;

 private:
  struct Row {
    QString path;
    QTreeWidgetItem* item;
  };
  using Fields = std::vector<std::pair<std::string, std::string>>;
  void make_rows(const Fields& fields);
  void mark(QTreeWidgetItem& item, bool differs);

  QTreeWidget* tree_;
  QLabel* how_;
  std::vector<QPushButton*> steps_;
  QPushButton* back_;
  std::vector<Row> rows_;
  int different_ = 0;
};

}  // namespace verp::view
