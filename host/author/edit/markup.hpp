#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Byte ranges in an XML text. tinyxml2 knows only lines and reformats; an editor that keeps the
/// rest needs bytes.
namespace verp::edit {

struct Range {
  std::size_t begin = 0, end = 0;  ///< bytes; end is exclusive
  std::size_t size() const { return end - begin; }
};

struct Attribute {
  std::string name, value;  ///< unescaped: &lt; is <
  Range at;                 ///< name to closing quote
  Range value_at;           ///< inside the quotes
};

struct Element {
  std::string name;
  std::vector<Attribute> attributes;
  Range whole;                  ///< < to the last >
  Range content;                ///< between the tags; <a/>: empty, behind it
  bool closed_at_once = false;  ///< <a/>
  int line = 1;
  int parent = -1;            ///< index; -1: the root
  std::vector<int> children;  ///< indices, in text order

  const Attribute* attribute(std::string_view wanted) const;
};

class Markup {
 public:
  /// Throws model::LoadError for malformed text.
  Markup(const std::string& text, const std::string& file);

  const std::vector<Element>& elements() const { return elements_; }
  const Element& operator[](int index) const { return elements_[std::size_t(index)]; }
  int root() const { return 0; }
  /// Text without surrounding spaces and comments; else empty, at its content's end. `of`: scanned
  /// text.
  Range text_at(int index, std::string_view of) const;
  /// That text, unescaped.
  std::string text(int index, std::string_view of) const;

 private:
  std::vector<Element> elements_;
};

/// Escapes for an attribute or between tags.
std::string escaped(std::string_view value);
int line_at(std::string_view text, std::size_t byte);

}  // namespace verp::edit
