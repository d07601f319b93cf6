#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Where in the text of an XML file each element and attribute stands. tinyxml2 knows lines only,
/// and writes a file in its own way; an editor that leaves all else as it was needs the bytes.
namespace verp::edit {

struct Range {
  std::size_t begin = 0, end = 0;  ///< bytes; end is the first beyond
  std::size_t size() const { return end - begin; }
};

struct Attribute {
  std::string name, value;  ///< the value as a reader sees it: &lt; is <
  Range at;                 ///< from the name to behind the closing quote
  Range value_at;           ///< inside the quotes
};

struct Element {
  std::string name;
  std::vector<Attribute> attributes;
  Range whole;                  ///< from < to behind the last >
  Range content;                ///< between the tags; of <a/> empty and behind it
  bool closed_at_once = false;  ///< <a/>
  int line = 1;
  int parent = -1;            ///< index; -1: the root
  std::vector<int> children;  ///< indices, in the order of the text

  const Attribute* attribute(std::string_view wanted) const;
};

class Markup {
 public:
  /// Throws model::LoadError, in the name of that file, where the text is not well-formed.
  Markup(const std::string& text, const std::string& file);

  const std::vector<Element>& elements() const { return elements_; }
  const Element& operator[](int index) const { return elements_[std::size_t(index)]; }
  int root() const { return 0; }
  /// Where an element's own text stands, without spaces around it and comments beside it; empty
  /// and at its content's end if there is none. `of`: the text that was scanned.
  Range text_at(int index, std::string_view of) const;
  /// That text as a reader sees it.
  std::string text(int index, std::string_view of) const;

 private:
  std::vector<Element> elements_;
};

/// As it has to stand in an attribute or between tags.
std::string escaped(std::string_view value);
int line_at(std::string_view text, std::size_t byte);

}  // namespace verp::edit
