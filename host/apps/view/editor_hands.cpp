#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QUndoStack>
#include <sstream>

#include "host/apps/view/editor_panel.hpp"
#include "host/author/edit/meshes/import.hpp"
#include "host/author/edit/names.hpp"
#include "host/author/edit/parts.hpp"

namespace verp::view {

QWidget* EditorPanel::make_adder() {
  auto* box = new QWidget(this);
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  kind_ = new QComboBox(box);
  kind_->setObjectName("editor_kind");
  for (const std::string& kind : edit::kinds()) kind_->addItem(QString::fromStdString(kind));
  words_ = new QLineEdit(box);
  words_->setObjectName("editor_words");
  const auto hint = [this] {
    const QString words =
        QString::fromStdString(edit::words_of(kind_->currentText().toStdString()));
    words_->setPlaceholderText(words.split(' ').join("=… ") + "=…");
    words_->setToolTip("NAME=VALUE, a blank between: " + words);
  };
  hint();
  connect(kind_, &QComboBox::currentTextChanged, this, hint);
  connect(words_, &QLineEdit::returnPressed, this, [this] { add(); });
  auto* button = new QPushButton("Add", box);
  button->setObjectName("editor_add");
  connect(button, &QPushButton::clicked, this, [this] { add(); });
  row->addWidget(kind_);
  row->addWidget(words_, 1);
  row->addWidget(button);
  return box;
}

QWidget* EditorPanel::make_buttons() {
  auto* box = new QWidget(this);
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  int count = 0;
  const auto put = [&](const char* text, const char* name, const char* tip, auto pressed) {
    auto* button = new QPushButton(text, box);
    button->setObjectName(name);
    button->setToolTip(tip);
    connect(button, &QPushButton::clicked, this, pressed);
    grid->addWidget(button, count / 4, count % 4);
    ++count;
  };
  const auto of_part = [this](auto make) {
    return [this, make] {
      const int part = element();
      if (part >= 0) change([&](const edit::Document& document) { return make(document, part); });
    };
  };
  put("Delete", "editor_delete", "The part, and what hangs on it",
      of_part([](const edit::Document& d, int part) { return edit::remove(d, part); }));
  put("Duplicate", "editor_duplicate", "The part, and what hangs on it, once more",
      of_part([](const edit::Document& d, int part) {
        std::string name = edit::key_of(d.markup()[part]);
        int number = 2;
        while (d.text().find("\"" + name + "_" + std::to_string(number) + "\"") !=
               std::string::npos)
          ++number;
        return edit::duplicate(d, part, name + "_" + std::to_string(number));
      }));
  put("Mirror", "editor_mirror",
      "The part, and what hangs on it, on the other side: left is right, y is -y",
      of_part([](const edit::Document& d, int part) { return edit::mirror(d, part); }));
  put("Import…", "editor_import",
      "A mesh (STL, OBJ, DAE, glTF) as the link that is selected, or as a new one",
      [this] { import(); });
  put("New…", "editor_new", "Begin a robot with an empty file", [this] { start_new(); });
  put("Save", "editor_save", "Only the lines that were edited change", [this] {
    const std::string why = save();
    if (said) said(why.empty() ? "Saved " + document_->file().string() : why);
  });
  put("Walk it", "editor_walk", "Run the robot as it is edited, saved or not", [this] {
    if (document_ && walk) walk(document_->file().string(), document_->text());
  });
  unit_ = new QComboBox(box);
  unit_->addItems({"m", "mm", "cm", "in"});
  unit_->setToolTip("Unit of a mesh that is imported");
  grid->addWidget(unit_, count / 4, count % 4);
  return box;
}

void EditorPanel::add() {
  edit::Words words;
  std::istringstream typed(words_->text().toStdString());
  for (std::string word; typed >> word;) {
    const std::size_t at = word.find('=');
    words[word.substr(0, at)] = at == word.npos ? "" : word.substr(at + 1);
  }
  const int before = undo_.index();
  change([&](const edit::Document& document) {
    return edit::add(document, kind_->currentText().toStdString(), words);
  });
  if (undo_.index() != before) words_->clear();
}

void EditorPanel::import() {
  if (!document_) return;
  const QString file = QFileDialog::getOpenFileName(
      this, "Import a mesh", {}, "Meshes (*.stl *.obj *.dae *.gltf *.glb);;All files (*)");
  if (file.isEmpty()) return;
  change([&](const edit::Document& document) {
    edit::ImportOptions options;
    const QString unit = unit_->currentText();
    options.unit_m = unit == "mm" ? 0.001 : unit == "cm" ? 0.01 : unit == "in" ? 0.0254 : 1;
    options.fit = "smallest";
    const edit::Imported made = edit::import_mesh(file.toStdString(), document.file(), options);
    const int part = element();
    const bool is_link = part >= 0 && edit::kind_of(document, part) == edit::Kind::kLink;
    if (said) said(made.told);
    return edit::put_mesh(document,
                          is_link ? document.attribute(part, "name")
                                  : QFileInfo(file).completeBaseName().toStdString(),
                          made.body, "");
  });
}

void EditorPanel::start_new() {
  const QString file =
      QFileDialog::getSaveFileName(this, "A new robot's file", "robot.sdf", "Robots (*.sdf)");
  if (file.isEmpty()) return;
  const std::string why = open(file.toStdString(), true);
  if (!why.empty() && said) said(why);
}

}  // namespace verp::view
