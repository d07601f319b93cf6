#pragma once
#include <tinyxml2.h>

#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

/// Line numbers, which libsdformat drops, and strict numbers.
namespace verp::model {

class XmlElement {
 public:
  XmlElement(const std::string& file, const tinyxml2::XMLElement& element)
      : file_(&file), element_(&element) {}

  std::string name() const { return element_->Name(); }
  int line() const { return element_->GetLineNum(); }
  const std::string& file() const { return *file_; }
  const tinyxml2::XMLElement& raw() const { return *element_; }
  std::vector<XmlElement> children() const;
  std::vector<XmlElement> children(const char* name) const;

  [[noreturn]] void fail(const std::string& message, const std::string& fix) const;

  /// Throws LoadError for any other attribute, inner element or text.
  void allow(std::initializer_list<const char*> attributes,
             std::initializer_list<const char*> elements = {}) const;
  bool has(const char* attribute) const { return element_->Attribute(attribute) != nullptr; }
  /// Throw LoadError if missing (without a fallback) or malformed.
  std::string text(const char* attribute) const;
  std::string text(const char* attribute, const std::string& fallback) const;
  double number(const char* attribute) const;
  double number(const char* attribute, double fallback) const;
  double number_within(const char* attribute, double low, double high, const char* unit) const;
  double number_within(const char* attribute, double low, double high, const char* unit,
                       double fallback) const;
  int integer(const char* attribute, int lowest, int highest) const;
  int integer(const char* attribute, int lowest, int highest, int fallback) const;
  Vec3 vector(const char* attribute) const;  ///< metres

 private:
  const std::string* file_;  // lives in XmlSource
  const tinyxml2::XMLElement* element_;
};

/// A robot's file with all included files.
class XmlSource {
 public:
  /// Checks existence, well-formed XML and standard elements' numbers. Throws LoadError.
  explicit XmlSource(const std::string& path) : XmlSource(path, std::nullopt) {}
  /// A text that would be in that file.
  XmlSource(const std::string& path, const std::optional<std::string>& text);

  const std::string& path() const { return files_.front()->path; }
  /// Throws LoadError unless there is exactly one.
  XmlElement model() const;
  /// The file of an <include>, found from any working directory; empty: not found.
  std::string included(const std::string& uri) const;
  /// The main file's text, or the given one. Each <uri> of an <include> has a name instead that no
  /// file has, which included() knows.
  std::string text_with_names() const;
  /// The <robot> elements of included URDF files.
  std::vector<XmlElement> urdfs() const;

  /// Those and the <model> elements of all files.
  std::vector<XmlElement> tops() const;

  struct Place {
    std::string file;
    int line = 1;
  };
  /// Place of the named link, joint, frame, ...
  std::optional<Place> find(const std::string& name) const;
  /// Place of the first defined name in `message` (quoted, bracketed or after a colon); else the
  /// model's.
  Place blame(const std::string& message) const;

 private:
  struct File {
    std::string path;
    tinyxml2::XMLDocument document;
  };
  std::string read(const std::string& path, const std::optional<std::string>& text = {});
  void include(const File& file, const tinyxml2::XMLElement& element);
  void inspect(const File& file, const tinyxml2::XMLElement& element);

  std::vector<std::unique_ptr<File>> files_;
  std::vector<std::string> open_;  ///< main file, then includes to the current one
  std::map<std::string, Place> names_;
  std::map<std::string, std::string> included_;  ///< by its <uri>
  std::string text_;                             ///< of the main file
};

}  // namespace verp::model
