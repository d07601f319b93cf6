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

/// All of State, Inputs and Outputs at the tick that is shown of a trace, by name; and, while a
/// controller goes on from there by itself, beside it what was recorded.
class StatePanel final : public QWidget {
 public:
  explicit StatePanel(QWidget* parent = nullptr);

  struct Tick {
    State state;
    Inputs inputs;
    Outputs outputs;
  };
  /// `recorded`: null while what is shown is the record itself.
  void show_tick(const Tick& now, const Tick* recorded);
  /// There is none to show: why.
  void show_none(const QString& why);
  /// How the controller that goes on stands to the record; empty: none does.
  void say(const QString& how);

  /// Go on by so many ticks; 0: back to the record.
  std::function<void(int ticks)> stepped;

  int different() const { return different_; }
  /// The text of a field, by its path ("state.gait.phase"); empty: there is none.
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
