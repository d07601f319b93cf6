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

/// All fields of State, Inputs and Outputs at a trace's tick, by name. While a controller continues
/// from there by itself, also the recorded values.
class StatePanel final : public QWidget {
 public:
  explicit StatePanel(QWidget* parent = nullptr);

  struct Tick {
    State state;
    Inputs inputs;
    Outputs outputs;
  };
  /// `recorded` is null while the record itself is shown.
  void show_tick(const Tick& now, const Tick* recorded);
  /// Shows why there is no tick.
  void show_none(const QString& why);
  /// Compares the continuing controller with the record; empty if there is no such controller.
  void say(const QString& how);

  /// Continues by so many ticks; 0: back to the record.
  std::function<void(int ticks)> stepped;

  int different() const { return different_; }
  /// The text of a field by its path ("state.gait.phase"); empty if there is none.
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
