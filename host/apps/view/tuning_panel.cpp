#include "host/apps/view/tuning_panel.hpp"

#include <QDoubleSpinBox>
#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>
#include <QUndoCommand>
#include <QUndoStack>
#include <QVBoxLayout>
#include <algorithm>
#include <map>
#include <utility>

#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/params.hpp"

namespace verp::view {
namespace {

/// Drags of one box are one undo step.
class Change final : public QUndoCommand {
 public:
  Change(int id, float from, float to, std::function<void(int, float)> apply)
      : id_(id), from_(from), to_(to), apply_(std::move(apply)) {
    setText(QString::fromStdString(model::tuning_names()[std::size_t(id)]));
  }
  void undo() override { apply_(id_, from_); }
  void redo() override { apply_(id_, to_); }
  int id() const override { return id_; }
  bool mergeWith(const QUndoCommand* next) override {
    to_ = static_cast<const Change*>(next)->to_;
    return true;
  }

 private:
  int id_;
  float from_, to_;
  std::function<void(int, float)> apply_;
};

/// "cycle_s" -> "cycle", "s".
std::pair<QString, QString> words(const QString& field) {
  static const std::pair<const char*, const char*> kUnits[] = {
      {"_rad", "rad"}, {"_m", "m"}, {"_s", "s"}, {"_v", "V"}, {"_c", "°C"}};
  for (const auto& [end, unit] : kUnits) {
    if (field.endsWith(end)) {
      return {field.chopped(int(qstrlen(end))).replace('_', ' '), unit};
    }
  }
  return {QString(field).replace('_', ' '), ""};
}

int decimals(const Range& range) {
  const float wide = range.high - range.low;
  return wide > 20 ? 1 : wide > 1 ? 3 : 4;
}

}  // namespace

TuningPanel::TuningPanel(QUndoStack& undo, QWidget* parent)
    : QWidget(parent), undo_(undo), hint_(new QLabel(this)) {
  auto* tree = new QTreeWidget(this);
  tree->setObjectName("tuning");
  tree->setHeaderLabels({"Number", "Value", "Range"});
  tree->setIndentation(12);
  tree->header()->setStretchLastSection(false);
  tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  tree->header()->setSectionResizeMode(1, QHeaderView::Fixed);
  tree->header()->resizeSection(1, 112);
  tree->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  std::map<QString, QTreeWidgetItem*> groups;
  for (int id = 0; id < kTuningCount; ++id) {
    const QString name = QString::fromStdString(model::tuning_names()[std::size_t(id)]);
    QTreeWidgetItem*& group = groups[name.section('.', 0, 0)];
    if (group == nullptr) group = new QTreeWidgetItem(tree, {name.section('.', 0, 0)});
    const Range& range = kTuningRanges[id];
    const auto [label, unit] = words(name.section('.', 1));
    auto* item = new QTreeWidgetItem(
        group, {label, "", QString("%1 to %2").arg(double(range.low)).arg(double(range.high))});
    item->setToolTip(0, name);
    auto* box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setFrame(false);
    box->setDecimals(decimals(range));
    box->setRange(double(range.low), double(range.high));
    box->setSingleStep(double(range.high - range.low) / 100);
    box->setSuffix(unit.isEmpty() ? "" : " " + unit);
    box->setKeyboardTracking(false);
    tree->setItemWidget(item, 1, box);
    connect(box, &QDoubleSpinBox::valueChanged, this, [this, id](double v) { edited(id, v); });
    boxes_.push_back(box);
  }
  tree->expandAll();
  hint_->setObjectName("hint");
  hint_->setWordWrap(true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 0);
  layout->addWidget(hint_);
  layout->addWidget(tree, 1);
}

void TuningPanel::set_robot(const Tuning& own, bool live) {
  own_ = asked_ = own;
  hint_->setText(live ? "Changes act at once and are recorded. Bold: not the robot's own."
                      : "As the trace has them at the instant shown.");
  for (QDoubleSpinBox* box : boxes_) box->setReadOnly(!live);
  for (QDoubleSpinBox* box : boxes_) {
    box->setButtonSymbols(live ? QAbstractSpinBox::UpDownArrows : QAbstractSpinBox::NoButtons);
  }
  for (int id = 0; id < kTuningCount; ++id) set_box(id, tuning_value(own, id));
  seen_ = own;
}

void TuningPanel::set_box(int id, float value) {
  QDoubleSpinBox& box = *boxes_[std::size_t(id)];
  set_tuning_value(asked_, id, value);
  const QSignalBlocker quiet(box);
  box.setValue(double(value));
  mark(id);
}

/// Shows only numbers that changed: a requested change takes effect later.
void TuningPanel::show_tuning(const Tuning& tuning) {
  for (int id = 0; id < kTuningCount; ++id) {
    const float value = tuning_value(tuning, id);
    if (value == tuning_value(seen_, id)) continue;
    set_tuning_value(seen_, id, value);
    if (value != tuning_value(asked_, id)) set_box(id, value);
  }
}

void TuningPanel::mark(int id) {
  const bool changed = tuning_value(asked_, id) != tuning_value(own_, id);
  QFont font = boxes_[std::size_t(id)]->font();
  font.setBold(changed);
  boxes_[std::size_t(id)]->setFont(font);
}

void TuningPanel::edited(int id, double value) {
  const Range& range = kTuningRanges[id];
  const float to = std::clamp(static_cast<float>(value), range.low, range.high);
  undo_.push(new Change(id, tuning_value(asked_, id), to, [this](int which, float now) {
    set_box(which, now);
    if (wanted) wanted(which, now);
  }));
}

}  // namespace verp::view
