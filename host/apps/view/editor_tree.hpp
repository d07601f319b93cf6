#pragma once
#include <QAbstractItemModel>
#include <string>

#include "host/author/edit/document.hpp"

namespace verp::view {

/// An index holds its element's number.
class EditorTree final : public QAbstractItemModel {
 public:
  using QAbstractItemModel::QAbstractItemModel;

  /// Kept until the next call; may be null.
  void set_document(const edit::Document* document);
  int element(const QModelIndex& index) const {
    return index.isValid() ? int(index.internalId()) : -1;
  }
  QModelIndex index_of(int element) const;
  /// Marks the part that `verp check` refuses.
  void mark(const std::string& path);

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& child) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex&) const override { return 1; }
  QVariant data(const QModelIndex& index, int role) const override;

 private:
  bool is_part(int element) const;
  std::vector<int> parts_of(int element) const;

  const edit::Document* document_ = nullptr;
  std::string marked_;
};

}  // namespace verp::view
