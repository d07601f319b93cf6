#include "host/apps/view/state_panel.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <limits>
#include <map>

#include "host/apps/view/theme.hpp"
#include "host/trace/record/fields.hpp"

namespace verp::view {
namespace {

std::vector<std::pair<std::string, std::string>> fields_of(const StatePanel::Tick& tick) {
  std::vector<std::pair<std::string, std::string>> all;
  const auto add = [&all](const std::string& group, auto fields) {
    for (auto& [path, text] : fields) all.emplace_back(group + "." + path, std::move(text));
  };
  add("state", record::print_fields(tick.state));
  add("inputs", record::print_fields(tick.inputs));
  add("outputs", record::print_fields(tick.outputs));
  return all;
}

}  // namespace

StatePanel::StatePanel(QWidget* parent)
    : QWidget(parent), tree_(new QTreeWidget(this)), how_(new QLabel(this)) {
  setObjectName("state");
  tree_->setObjectName("state_tree");
  tree_->setHeaderLabels({"Field", "Value", "Recorded"});
  tree_->setUniformRowHeights(true);
  tree_->setIndentation(14);
  tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  how_->setObjectName("state_how");
  how_->setWordWrap(true);
  auto* buttons = new QHBoxLayout;
  const auto add = [&](const char* text, const char* name, const char* tip, int ticks) {
    auto* button = new QPushButton(text);
    button->setObjectName(name);
    button->setToolTip(tip);
    button->setFocusPolicy(Qt::NoFocus);
    buttons->addWidget(button);
    connect(button, &QPushButton::clicked, this, [this, ticks] {
      if (stepped) stepped(ticks);
    });
    return button;
  };
  const char* const tip =
      "The controller goes on from this tick with the recorded inputs, and with the numbers that "
      "you change under Tuning";
  steps_ = {add("+1 tick", "step_1", tip, 1), add("+10", "step_10", tip, 10),
            add("+100", "step_100", tip, 100),
            add("To the end", "step_end", tip, std::numeric_limits<int>::max())};
  back_ = add("Record", "step_back", "Back to what was recorded", 0);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 0);
  layout->addLayout(buttons);
  layout->addWidget(how_);
  layout->addWidget(tree_, 1);
  show_none("");
}

void StatePanel::show_none(const QString& why) {
  rows_.clear();
  tree_->clear();
  different_ = 0;
  for (QPushButton* button : steps_) button->setEnabled(false);
  back_->setEnabled(false);
  how_->setText(why);
}

void StatePanel::say(const QString& how) {
  how_->setText(how.isEmpty() ? "As recorded" : how);
  back_->setEnabled(!how.isEmpty());
  for (QPushButton* button : steps_) button->setEnabled(true);
}

void StatePanel::make_rows(const Fields& fields) {
  std::map<QString, QTreeWidgetItem*> groups;
  for (const auto& [path, text] : fields) {
    QTreeWidgetItem* parent = tree_->invisibleRootItem();
    QString so_far;
    const QString words = QString::fromStdString(path);
    const QStringList parts = QString(words).replace("[", ".[").split('.');
    for (qsizetype i = 0; i + 1 < parts.size(); ++i) {
      so_far += "." + parts[i];
      QTreeWidgetItem*& group = groups[so_far];
      if (group == nullptr) group = new QTreeWidgetItem(parent, {parts[i]});
      parent = group;
    }
    rows_.push_back({words, new QTreeWidgetItem(parent, {parts.last()})});
  }
  groups[".state"]->setExpanded(true);
}

/// Also marks all parents.
void StatePanel::mark(QTreeWidgetItem& item, bool differs) {
  for (QTreeWidgetItem* each = &item; each != nullptr; each = each->parent()) {
    for (const int column : {0, 1}) {
      each->setForeground(column, differs ? theme().bad : theme().text);
    }
  }
}

void StatePanel::show_tick(const Tick& now, const Tick* recorded) {
  const Fields fields = fields_of(now),
               others = recorded != nullptr ? fields_of(*recorded) : Fields();
  if (rows_.empty()) make_rows(fields);
  for (const Row& row : rows_) mark(*row.item, false);
  different_ = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    QTreeWidgetItem& item = *rows_[i].item;
    const bool differs = recorded != nullptr && fields[i].second != others[i].second;
    different_ += differs ? 1 : 0;
    item.setText(1, QString::fromStdString(fields[i].second));
    item.setText(2, differs ? QString::fromStdString(others[i].second) : "");
  }
  for (const Row& row : rows_) {
    if (!row.item->text(2).isEmpty()) mark(*row.item, true);
  }
}

QString StatePanel::value(const QString& path) const {
  for (const Row& row : rows_) {
    if (row.path == path) return row.item->text(1);
  }
  return "";
}

}  // namespace verp::view
