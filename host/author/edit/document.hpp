#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/author/edit/markup.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::edit {

struct Splice {
  std::size_t at = 0;
  std::string before, after;
};

/// A change as the user sees it: splices in text order, not nested.
struct Edit {
  std::string what;  ///< "set mass of trunk"
  std::vector<Splice> splices;

  bool empty() const { return splices.empty(); }
  Edit reversed() const;
};

// Errors are model::LoadError: one line with the remedy.

class Document {
 public:
  /// Throws model::LoadError for an unreadable or malformed file. An empty file becomes an empty
  /// robot named after it; with `may_be_new` a missing one, too.
  static Document open(const std::filesystem::path& file, bool may_be_new = false);
  Document(std::filesystem::path file, std::string text);

  const std::filesystem::path& file() const { return file_; }
  const std::string& text() const { return text_; }
  const Markup& markup() const { return markup_; }
  bool is_urdf() const { return markup_[markup_.root()].name == "robot"; }
  /// The <model> or <robot>.
  int model() const;

  void apply(const Edit& edit);
  std::string with(const Edit& edit) const;

  bool changed() const { return !on_disk_ || *on_disk_ != text_; }
  /// Writes the whole text or nothing. Throws LoadError if it cannot write or another program
  /// changed the file, with the place of the text.
  void save();
  /// Writes the text beside the file; returns a note that says where.
  std::string put_aside() const;

  /// A path for find(): "link:trunk/inertial/mass".
  std::string path(int element) const;
  /// Throws LoadError with the candidates.
  int find(const std::string& path) const;
  std::optional<int> look_for(const std::string& path) const;
  std::string text_of(int element) const { return markup_.text(element, text_); }
  std::string child_text(int element, std::string_view child) const;
  std::string attribute(int element, std::string_view name) const;
  int child(int element, std::string_view name) const;  ///< -1: none
  /// The innermost element around a line.
  int at_line(int line) const;

 private:
  std::optional<int> step(int from, std::string_view segment) const;

  std::filesystem::path file_;
  std::string text_;
  std::optional<std::string> on_disk_;
  Markup markup_;
};

/// First complaint of `verp check`; empty: sound. A URDF alone: only XML and numbers.
struct Complaint {
  std::string file;
  int line = 1;
  std::string message, fix, part;
  bool unfinished = true;  ///< something is missing; false: it is wrong
  std::string line_of_text() const;
};
std::optional<Complaint> check(const Document& document);

/// As `diff -u`; may be empty.
std::string difference(const std::string& before, const std::string& after,
                       const std::string& file);

}  // namespace verp::edit
