#include "host/apps/view/editor_panel.hpp"

#include <QComboBox>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSplitter>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QTimer>
#include <QTreeView>
#include <QUndoStack>
#include <QVBoxLayout>

#include "host/apps/view/editor_table.hpp"
#include "host/apps/view/editor_tree.hpp"
#include "host/apps/view/theme.hpp"
#include "host/author/edit/names.hpp"
#include "host/author/edit/parts.hpp"
#include "host/robot/model/load.hpp"

namespace verp::view {
namespace {

constexpr int kTyping_ms = 250;  // waits for a pause, as a check takes some 10 ms

class Typing final : public QStyledItemDelegate {
 public:
  Typing(std::function<void(int, const QString&)> typed, QObject* parent)
      : QStyledItemDelegate(parent), typed_(std::move(typed)) {}
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem&,
                        const QModelIndex& index) const override {
    auto* line = new QLineEdit(parent);
    line->setFrame(false);
    connect(line, &QLineEdit::textEdited, this,
            [this, row = index.row()](const QString& text) { typed_(row, text); });
    return line;
  }

 private:
  std::function<void(int, const QString&)> typed_;
};

}  // namespace

class EditorPanel::Change final : public QUndoCommand {
 public:
  Change(EditorPanel& panel, edit::Edit edit) : panel_(panel), edit_(std::move(edit)) {
    setText(QString::fromStdString(edit_.what));
  }
  void undo() override { panel_.apply(edit_.reversed()); }
  void redo() override { panel_.apply(edit_); }

 private:
  EditorPanel& panel_;
  edit::Edit edit_;
};

EditorPanel::EditorPanel(QUndoStack& undo, QWidget* parent)
    : QWidget(parent),
      undo_(undo),
      parts_(new EditorTree(this)),
      numbers_(new EditorTable(this)),
      tree_(new QTreeView(this)),
      table_(new QTableView(this)),
      file_(new QLabel("No file: open a robot, or begin a new one", this)),
      complaint_(new QLabel(this)),
      soon_(new QTimer(this)) {
  tree_->setObjectName("editor_parts");
  tree_->setModel(parts_);
  tree_->setHeaderHidden(true);
  table_->setObjectName("editor_numbers");
  table_->setModel(numbers_);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(22);
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  table_->horizontalHeader()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  table_->setItemDelegateForColumn(
      1, new Typing([this](int row, const QString& text) { preview(row, text); }, this));
  complaint_->setObjectName("editor_complaint");
  complaint_->setWordWrap(true);
  complaint_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  file_->setWordWrap(true);
  soon_->setSingleShot(true);
  soon_->setInterval(kTyping_ms);
  auto* split = new QSplitter(Qt::Vertical, this);
  split->addWidget(tree_);
  split->addWidget(table_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addWidget(file_);
  layout->addWidget(split, 1);
  layout->addWidget(complaint_);
  layout->addWidget(make_adder());
  layout->addWidget(make_buttons());
  connect(tree_->selectionModel(), &QItemSelectionModel::currentChanged, this,
          [this] { show_part(); });
  connect(soon_, &QTimer::timeout, this, [this] { look(); });
  numbers_->wanted = [this](const std::string& path, const std::string& value) {
    change([&](const edit::Document& document) {
      const std::string part = path.substr(0, path.rfind('@'));
      const int named = path.ends_with("@name") ? document.find(part) : -1;
      if (named >= 0 && edit::kind_of(document, named) != edit::Kind::kNone)
        return edit::rename(document, named, value);
      return edit::set(document, path, value);
    });
  };
}

EditorPanel::~EditorPanel() = default;

std::string EditorPanel::open(const std::string& file, bool may_be_new) {
  if (document_ && document_->file() == file) return "";
  if (changed())
    return document_->file().string() + ": has changes that are not saved; save or undo them first";
  try {
    edit::Document document = edit::Document::open(file, may_be_new);
    undo_.clear();
    parts_->set_document(nullptr);
    document_.emplace(std::move(document));
  } catch (const model::LoadError& error) {
    return error.what();
  }
  file_->setText(QString::fromStdString(file));
  apply({});
  return "";
}

std::string EditorPanel::save() {
  if (!document_) return "There is no file to save";
  try {
    document_->save();
  } catch (const model::LoadError& error) {
    return error.what();
  }
  file_->setText(QString::fromStdString(document_->file().string()));
  return "";
}

int EditorPanel::element() const {
  return document_ ? parts_->element(tree_->currentIndex()) : -1;
}

std::string EditorPanel::selected() const {
  return element() < 0 ? "" : document_->path(element());
}

void EditorPanel::select(const std::string& path) {
  if (!document_) return;
  const auto found = document_->look_for(path);
  if (!found) return;
  const QModelIndex index = parts_->index_of(*found);
  tree_->setCurrentIndex(index);
  tree_->scrollTo(index);
}

void EditorPanel::change(const Make& make) {
  if (!document_) return;
  try {
    edit::Edit edit = make(*document_);
    if (!edit.empty()) undo_.push(new Change(*this, std::move(edit)));
  } catch (const model::LoadError& error) {
    complaint_->setText(QString::fromUtf8(error.what()));
    complaint_->setStyleSheet("color: " + theme().bad.name());
    if (said) said(error.what());
  }
}

void EditorPanel::apply(const edit::Edit& edit) {
  const std::string at = selected();
  parts_->set_document(nullptr);
  document_->apply(edit);
  parts_->set_document(&*document_);
  const QString star = document_->changed() ? " (not saved)" : "";
  file_->setText(QString::fromStdString(document_->file().string()) + star);
  select(document_->look_for(at) ? at : "");
  show_part();
  typed_path_.clear();
  look();
}

void EditorPanel::show_part() {
  if (!document_) return;
  const int part = element();
  if (part < 0) return numbers_->clear();
  numbers_->show_part(*document_, part);
  int link = part;
  while (link >= 0 && document_->markup()[link].name != "link")
    link = document_->markup()[link].parent;
  if (link < 0 && document_->markup()[part].name == "joint") {
    const int child = document_->child(part, "child");
    if (chosen && child >= 0)
      chosen(document_->is_urdf() ? document_->attribute(child, "link")
                                  : document_->text_of(child));
  } else if (chosen) {
    chosen(link < 0 ? "" : document_->attribute(link, "name"));
  }
}

void EditorPanel::preview(int row, const QString& text) {
  typed_path_ = numbers_->path(row);
  typed_ = text.toStdString();
  soon_->start();
}

void EditorPanel::look() {
  if (!document_) return;
  soon_->stop();
  edit::Document seen = *document_;
  try {
    if (!typed_path_.empty()) seen.apply(edit::set(seen, typed_path_, typed_));
  } catch (const model::LoadError&) {
    return;  // reported when the text is entered
  }
  const auto complaint = edit::check(seen);
  tell(complaint);
  const bool shown_already = undo_.count() == 0;  // unchanged since it was opened
  if (!complaint && !seen.is_urdf() && typed_path_.empty() && edited && !shown_already) {
    edited(model::load_robot_text(seen.file().string(), seen.text()));
  }
}

void EditorPanel::tell(const std::optional<edit::Complaint>& complaint) {
  parts_->mark(complaint ? complaint->part : "");
  numbers_->mark(complaint ? complaint->part : "");
  if (!complaint) {
    complaint_->setStyleSheet("color: " + theme().good.name());
    return complaint_->setText(document_->is_urdf() ? "Numbers are sound" : "Sound");
  }
  complaint_->setStyleSheet("color: " +
                            (complaint->unfinished ? theme().warn : theme().bad).name());
  complaint_->setText(
      QString("%1, line %2: %3; %4")
          .arg(QString::fromStdString(complaint->part))
          .arg(complaint->line)
          .arg(QString::fromStdString(complaint->message), QString::fromStdString(complaint->fix)));
}

}  // namespace verp::view
