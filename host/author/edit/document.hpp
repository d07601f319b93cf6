#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/author/edit/markup.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::edit {

/// At a place of the text, what stood there and what stands there then.
struct Splice {
  std::size_t at = 0;
  std::string before, after;
};

/// A change of a text as a person thinks of it: several places, none within another, first to last.
struct Edit {
  std::string what;  ///< in words: "set mass of trunk"
  std::vector<Splice> splices;

  bool empty() const { return splices.empty(); }
  /// What takes it back.
  Edit reversed() const;
};

// What cannot be done as asked is a model::LoadError: one line with the remedy.

/// The text of a robot's file with what it means, and what was read from the disk.
class Document {
 public:
  /// Throws model::LoadError for a file that cannot be read or is not well-formed. One that is
  /// empty becomes an empty robot named after it; so does one that is not there, if it may be new.
  static Document open(const std::filesystem::path& file, bool may_be_new = false);
  Document(std::filesystem::path file, std::string text);

  const std::filesystem::path& file() const { return file_; }
  const std::string& text() const { return text_; }
  const Markup& markup() const { return markup_; }
  bool is_urdf() const { return markup_[markup_.root()].name == "robot"; }
  /// The element that holds links and joints: <model>, or <robot>.
  int model() const;

  void apply(const Edit& edit);
  /// The text that an edit would make.
  std::string with(const Edit& edit) const;

  bool changed() const { return !on_disk_ || *on_disk_ != text_; }
  /// Writes the text, whole or not at all. Throws LoadError when the file was changed by another
  /// program since, or cannot be written: it says where the text was put instead.
  void save();
  /// Puts the text beside the file; says into which.
  std::string put_aside() const;

  /// What one of the elements is called, for people and for find(): "link:trunk/inertial/mass".
  std::string path(int element) const;
  /// The element of a path; throws LoadError that lists what there is.
  int find(const std::string& path) const;
  /// The same; nothing if it names none.
  std::optional<int> look_for(const std::string& path) const;
  std::string text_of(int element) const { return markup_.text(element, text_); }
  /// A child's text, an attribute; empty if there is none.
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

/// What `verp check` says of a robot's text, and of which part. Nothing: it is sound. Of a URDF by
/// itself only its XML and numbers can be checked.
struct Complaint {
  std::string file;
  int line = 1;
  std::string message, fix, part;
  bool unfinished = true;  ///< of the whole: something may still be missing; false: it is wrong
  std::string line_of_text() const;
};
std::optional<Complaint> check(const Document& document);

/// The lines that differ, as `diff -u` writes them; empty: none.
std::string difference(const std::string& before, const std::string& after,
                       const std::string& file);

}  // namespace verp::edit
