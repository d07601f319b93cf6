#pragma once
#include <QTreeWidget>
#include <functional>
#include <vector>

#include "host/apps/view/run/signals.hpp"

class QLineEdit;

namespace verp::view {

/// Signals with a check box and the current value.
class SignalTree final : public QWidget {
 public:
  explicit SignalTree(QWidget* parent = nullptr);

  void set_signals(const std::vector<Signal>& all);
  void set_values(const std::vector<float>& values);
  void set_ticked(const std::vector<int>& numbers);

  std::function<void(int signal, bool ticked)> ticked;

 private:
  void find(const QString& text);

  QLineEdit* search_;
  QTreeWidget* tree_;
  std::vector<QTreeWidgetItem*> items_;
};

}  // namespace verp::view
