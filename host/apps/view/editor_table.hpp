#pragma once
#include <QAbstractTableModel>
#include <functional>
#include <string>
#include <vector>

#include "host/author/edit/document.hpp"

namespace verp::view {

class EditorTable final : public QAbstractTableModel {
 public:
  using QAbstractTableModel::QAbstractTableModel;

  /// Copies the texts; does not keep the document.
  void show_part(const edit::Document& document, int element);
  void clear();
  /// Path of the wrong value; may be empty.
  void mark(const std::string& path);
  const std::string& path(int row) const { return rows_[std::size_t(row)].path; }
  int row_of(const std::string& path) const;  ///< -1: none

  std::function<void(const std::string& path, const std::string& value)> wanted;

  int rowCount(const QModelIndex& = {}) const override { return int(rows_.size()); }
  int columnCount(const QModelIndex& = {}) const override { return 3; }
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

 private:
  struct Row {
    std::string path, name, value, unit;
  };
  void add(const edit::Document& document, int element, const std::string& base);

  std::vector<Row> rows_;
  std::string marked_;
};

}  // namespace verp::view
