#include "host/apps/view/signal_tree.hpp"

#include <QHeaderView>
#include <QLineEdit>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <map>

namespace verp::view {

SignalTree::SignalTree(QWidget* parent)
    : QWidget(parent), search_(new QLineEdit(this)), tree_(new QTreeWidget(this)) {
  tree_->setObjectName("signals");
  search_->setObjectName("search");
  search_->setPlaceholderText("Find a signal");
  search_->setClearButtonEnabled(true);
  tree_->setHeaderLabels({"Signal", "Value", ""});
  tree_->setUniformRowHeights(true);
  tree_->setIndentation(14);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  tree_->header()->setSectionResizeMode(1, QHeaderView::Fixed);
  tree_->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  tree_->header()->resizeSection(1, 68);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 0, 0);
  layout->addWidget(search_);
  layout->addWidget(tree_);
  connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) { find(text); });
  connect(tree_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    const QVariant number = item->data(0, Qt::UserRole);
    if (column == 0 && number.isValid() && ticked) {
      ticked(number.toInt(), item->checkState(0) == Qt::Checked);
    }
  });
}

void SignalTree::set_signals(const std::vector<Signal>& all) {
  const QSignalBlocker quiet(tree_);
  tree_->clear();
  items_.clear();
  std::map<QString, QTreeWidgetItem*> groups;
  for (std::size_t i = 0; i < all.size(); ++i) {
    QTreeWidgetItem* parent = tree_->invisibleRootItem();
    QString path;
    for (const QString& part : QString::fromStdString(all[i].group).split('/')) {
      path += "/" + part;
      QTreeWidgetItem*& group = groups[path];
      if (group == nullptr) group = new QTreeWidgetItem(parent, {part});
      parent = group;
    }
    auto* item = new QTreeWidgetItem(
        parent, {QString::fromStdString(all[i].name), "", QString::fromStdString(all[i].unit)});
    item->setData(0, Qt::UserRole, int(i));
    item->setCheckState(0, Qt::Unchecked);
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    items_.push_back(item);
  }
  for (const char* open : {"/Joints", "/ZMP"}) {
    if (groups.count(open) > 0) groups[open]->setExpanded(true);
  }
}

void SignalTree::set_values(const std::vector<float>& values) {
  const QSignalBlocker quiet(tree_);
  for (std::size_t i = 0; i < items_.size() && i < values.size(); ++i) {
    const QTreeWidgetItem* parent = items_[i]->parent();
    if (parent != nullptr && !parent->isExpanded()) continue;
    items_[i]->setText(1, std::isfinite(values[i]) ? QString::number(double(values[i]), 'f', 3)
                                                   : QString::fromUtf8("–"));
  }
}

void SignalTree::set_ticked(const std::vector<int>& numbers) {
  for (QTreeWidgetItem* item : items_) {
    const int number = item->data(0, Qt::UserRole).toInt();
    const bool on = std::find(numbers.begin(), numbers.end(), number) != numbers.end();
    item->setCheckState(0, on ? Qt::Checked : Qt::Unchecked);
  }
}

void SignalTree::find(const QString& text) {
  for (QTreeWidgetItem* item : items_) {
    QString path = item->text(0);
    for (auto* parent = item->parent(); parent != nullptr; parent = parent->parent()) {
      path = parent->text(0) + " " + path;
    }
    item->setHidden(!text.isEmpty() && !path.contains(text, Qt::CaseInsensitive));
  }
  // Hides groups without visible items, leaves first.
  const std::function<bool(QTreeWidgetItem*)> seen = [&](QTreeWidgetItem* item) {
    if (item->childCount() == 0) return !item->isHidden();
    bool any = false;
    for (int i = 0; i < item->childCount(); ++i) any = seen(item->child(i)) || any;
    item->setHidden(!any);
    if (any && !text.isEmpty()) item->setExpanded(true);
    return any;
  };
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) seen(tree_->topLevelItem(i));
}

}  // namespace verp::view
