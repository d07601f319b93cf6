#include "host/apps/view/editor_table.hpp"

#include <QTimer>

#include "host/apps/view/theme.hpp"
#include "host/author/edit/names.hpp"
#include "host/author/edit/units.hpp"

namespace verp::view {

void EditorTable::show_part(const edit::Document& document, int element) {
  beginResetModel();
  rows_.clear();
  add(document, element, document.path(element));
  endResetModel();
}

void EditorTable::clear() {
  beginResetModel();
  rows_.clear();
  endResetModel();
}

void EditorTable::add(const edit::Document& document, int element, const std::string& base) {
  const edit::Element& own = document.markup()[element];
  const std::string path = document.path(element);
  const std::string inner = path == base ? "" : path.substr(base == "model" ? 0 : base.size() + 1);
  const auto put = [&](const std::string& whole, const std::string& name,
                       const std::string& value) {
    rows_.push_back({whole, name, value, edit::unit_of(whole)});
  };
  for (const edit::Attribute& each : own.attributes) {
    put(path + "@" + each.name, inner + (inner.empty() ? "" : "@") + each.name, each.value);
  }
  if (own.children.empty() && !document.text_of(element).empty())
    put(path, inner, document.text_of(element));
  for (const int child : own.children) {
    const std::string& name = document.markup()[child].name;
    const bool another = element == document.model() || name == "verp:servo" || name == "sensor";
    if (!another) add(document, child, base);
  }
}

void EditorTable::mark(const std::string& path) {
  marked_ = path;
  // Only marks: new values would reset a cell during typing.
  if (!rows_.empty()) emit dataChanged(index(0, 0), index(rowCount() - 1, 0));
}

int EditorTable::row_of(const std::string& path) const {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (rows_[row].path == path) return int(row);
  }
  return -1;
}

QVariant EditorTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const Row& row = rows_[std::size_t(index.row())];
  if (role == Qt::ForegroundRole && !marked_.empty() && row.path == marked_) return theme().bad;
  if (role == Qt::ToolTipRole) return QString::fromStdString(row.path);
  if (role != Qt::DisplayRole && role != Qt::EditRole) return {};
  const std::string& text = index.column() == 0   ? row.name
                            : index.column() == 1 ? row.value
                                                  : row.unit;
  return QString::fromStdString(text);
}

QVariant EditorTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  return QString(section == 0 ? "Number or word" : section == 1 ? "Value" : "Unit");
}

bool EditorTable::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid() || role != Qt::EditRole || index.column() != 1) return false;
  const Row row = rows_[std::size_t(index.row())];
  const std::string text = value.toString().toStdString();
  // The change rebuilds all rows: wait until the cell is closed.
  if (text != row.value) {
    QTimer::singleShot(0, this, [this, path = row.path, text] {
      if (wanted) wanted(path, text);
    });
  }
  return true;
}

Qt::ItemFlags EditorTable::flags(const QModelIndex& index) const {
  const Qt::ItemFlags usual = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  return index.column() == 1 ? usual | Qt::ItemIsEditable : usual;
}

}  // namespace verp::view
