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

/// Editor of a robot's file, with `verp check` during typing. A change is the smallest edit of the
/// text, and goes on the undo stack.
class EditorPanel final : public QWidget {
 public:
  explicit EditorPanel(QUndoStack& undo, QWidget* parent = nullptr);
  ~EditorPanel() override;

  /// These return empty or the reason. Refuses while there are unsaved changes.
  std::string open(const std::string& file, bool may_be_new = false);
  /// Also returns where the text was put.
  std::string save();
  /// Writes unsaved text beside the file; returns its place.
  std::string put_aside() const { return document_ ? document_->put_aside() : ""; }
  bool changed() const { return document_ && document_->changed(); }
  const edit::Document* document() const { return document_ ? &*document_ : nullptr; }
  void select(const std::string& path);
  std::string selected() const;  ///< path; may be empty

  std::function<void(const std::string& text)> said;
  std::function<void(const model::Entity& robot)> edited;  ///< a sound robot, after each change
  std::function<void(const std::string& link)> chosen;     ///< the link of the selected part
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
