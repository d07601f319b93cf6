#pragma once
#include <QWidget>
#include <functional>
#include <optional>
#include <string>

#include "host/author/edit/change.hpp"
#include "host/robot/model/entity.hpp"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableView;
class QTimer;
class QTreeView;
class QUndoStack;

namespace verp::view {

class EditorTable;
class EditorTree;

/// A robot's file: its parts, their numbers with units, and what `verp check` says while one types.
/// Each change is the smallest of the text, and goes on the undo stack.
class EditorPanel final : public QWidget {
 public:
  explicit EditorPanel(QUndoStack& undo, QWidget* parent = nullptr);
  ~EditorPanel() override;

  /// Empty, or why it cannot be edited. Changes that are not saved are not lost: then it refuses.
  std::string open(const std::string& file, bool may_be_new = false);
  /// Empty, or why not, and where the text was put.
  std::string save();
  /// Puts what is not saved beside the file; says where.
  std::string put_aside() const { return document_ ? document_->put_aside() : ""; }
  bool changed() const { return document_ && document_->changed(); }
  const edit::Document* document() const { return document_ ? &*document_ : nullptr; }
  void select(const std::string& path);
  std::string selected() const;  ///< path; empty: none

  std::function<void(const std::string& text)> said;
  std::function<void(const model::Entity& robot)> edited;  ///< a sound robot, after each change
  std::function<void(const std::string& link)> chosen;     ///< a link, or what is on one
  std::function<void(const std::string& file, const std::string& text)> walk;

 private:
  class Change;
  using Make = std::function<edit::Edit(const edit::Document&)>;

  QWidget* make_buttons();
  QWidget* make_adder();
  void change(const Make& make);
  void apply(const edit::Edit& edit);
  void add();
  void import();
  void start_new();
  void show_part();
  void look();
  void preview(int row, const QString& text);
  void tell(const std::optional<edit::Complaint>& complaint);
  int element() const;

  QUndoStack& undo_;
  std::optional<edit::Document> document_;
  EditorTree* parts_;
  EditorTable* numbers_;
  QTreeView* tree_;
  QTableView* table_;
  QLabel *file_, *complaint_;
  QComboBox *kind_, *unit_, *fit_;
  QLineEdit* words_;
  QTimer* soon_;
  std::string typed_path_, typed_;
};

}  // namespace verp::view
