#include "host/apps/view/editor_tree.hpp"

#include <QFont>
#include <algorithm>
#include <array>

#include "host/apps/view/theme.hpp"
#include "host/author/edit/names.hpp"

namespace verp::view {
namespace {

// Nested parts; other children are values.
constexpr std::array kInner = {"sensor", "collision", "visual", "verp:servo", "verp:joint"};

}  // namespace

void EditorTree::set_document(const edit::Document* document) {
  beginResetModel();
  document_ = document;
  endResetModel();
}

void EditorTree::mark(const std::string& path) {
  if (path == marked_) return;
  marked_ = path;
  if (document_ != nullptr && rowCount() > 0) {
    emit dataChanged(index(0, 0), index(rowCount() - 1, 0));
  }
}

bool EditorTree::is_part(int element) const {
  const edit::Element& own = document_->markup()[element];
  return own.parent == document_->model() ||
         std::find(kInner.begin(), kInner.end(), own.name) != kInner.end();
}

std::vector<int> EditorTree::parts_of(int element) const {
  std::vector<int> parts;
  for (const int each : document_->markup()[element].children) {
    if (is_part(each)) parts.push_back(each);
  }
  return parts;
}

QModelIndex EditorTree::index_of(int element) const {
  if (document_ == nullptr || element < 0 || element == document_->model()) return {};
  const int above = document_->markup()[element].parent;
  if (above < 0) return {};
  if (!is_part(element)) return index_of(above);
  const auto parts = parts_of(above);
  const auto at = std::find(parts.begin(), parts.end(), element);
  return createIndex(int(at - parts.begin()), 0, quintptr(element));
}

QModelIndex EditorTree::index(int row, int column, const QModelIndex& parent) const {
  if (document_ == nullptr || column != 0 || row < 0) return {};
  const auto parts = parts_of(parent.isValid() ? element(parent) : document_->model());
  return row < int(parts.size()) ? createIndex(row, 0, quintptr(parts[std::size_t(row)]))
                                 : QModelIndex();
}

QModelIndex EditorTree::parent(const QModelIndex& child) const {
  if (document_ == nullptr || !child.isValid()) return {};
  return index_of(document_->markup()[element(child)].parent);
}

int EditorTree::rowCount(const QModelIndex& parent) const {
  if (document_ == nullptr) return 0;
  return int(parts_of(parent.isValid() ? element(parent) : document_->model()).size());
}

QVariant EditorTree::data(const QModelIndex& index, int role) const {
  if (document_ == nullptr || !index.isValid()) return {};
  const edit::Element& own = document_->markup()[element(index)];
  if (role == Qt::DisplayRole) {
    const std::string kind = edit::short_name(own.name), key = edit::key_of(own);
    return QString::fromStdString(key.empty() ? kind : kind + " " + key);
  }
  const std::string path = document_->path(element(index));
  const bool bad = !marked_.empty() && (marked_ == path || marked_.starts_with(path + "/"));
  if (role == Qt::ForegroundRole && bad) return theme().bad;
  if (role == Qt::ToolTipRole)
    return QString("%1, line %2").arg(QString::fromStdString(path)).arg(own.line);
  return {};
}

}  // namespace verp::view
