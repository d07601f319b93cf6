#pragma once
#include <tinyxml2.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/robot/model/xml_source.hpp"

/// MuJoCo's XML: includes, classes of defaults, units. SI outside.
namespace verp::mjcf {

using model::Mat3;
using model::Transform;
using model::Vec3;
using model::XmlElement;

struct Compiler {
  bool degrees = true;
  std::string euler = "xyz";    ///< small letters turn with the body, capitals do not
  std::string mesh_folder;      ///< from the main file
  bool strips_paths = false;    ///< of meshes
  bool all_from_geoms = false;  ///< <inertial> is not read
  double total_mass_kg = -1;    ///< masses are scaled to it; below 0: they are not
};

class Document;

/// An element with the class that its body gives it. Each reader of a malformed number throws
/// LoadError at the element.
class Item {
 public:
  Item(const Document& document, const XmlElement& element, std::string child_class)
      : document_(&document), element_(element), class_(std::move(child_class)) {}

  const XmlElement& element() const { return element_; }
  std::string name() const { return element_.text("name", ""); }
  /// The element's own, else its class's.
  std::optional<std::string> find(const char* attribute) const;
  std::string text(const char* attribute, const std::string& fallback = "") const;
  double number(const char* attribute, double fallback) const;
  /// Empty: not given.
  std::vector<double> numbers(const char* attribute, std::size_t least, std::size_t most) const;
  Vec3 vector(const char* attribute, const Vec3& fallback) const;
  /// true, false, or neither for "auto" and nothing.
  std::optional<bool> flag(const char* attribute) const;
  /// Place and turn: pos, and one of quat, axisangle, euler, xyaxes, zaxis.
  Transform pose() const;

 private:
  Mat3 rotation() const;
  Mat3 turned_by_euler(const std::vector<double>& angles) const;

  const Document* document_;
  XmlElement element_;
  std::string class_;
};

class Document {
 public:
  /// Throws LoadError for a file that is not there, not well formed, or no <mujoco>.
  explicit Document(const std::string& path);

  const std::string& path() const { return files_.front()->path; }
  XmlElement root() const;
  const Compiler& compiler() const { return compiler_; }
  /// Files that an <include> names and that are not there.
  const std::vector<std::string>& missing() const { return missing_; }
  /// With those of included files in place of each <include>.
  std::vector<XmlElement> children(const XmlElement& element) const;
  /// All elements `name` of all sections `section`, of `section/name`.
  std::vector<XmlElement> all(const char* section) const;
  /// A default; `chosen`: a class; empty: the one of all elements. Throws LoadError at `element` if
  /// there is none of that name.
  std::optional<std::string> preset(const XmlElement& element, const std::string& chosen,
                                    const char* attribute) const;

 private:
  struct File {
    std::string path;
    tinyxml2::XMLDocument xml;
  };
  struct Class {
    std::string parent;
    std::map<std::string, std::map<std::string, std::string>> values;  ///< by element, attribute
  };

  const File& read(const std::string& path);
  void read_includes(const XmlElement& element, int depth);
  void read_defaults(const XmlElement& section, const std::string& parent);
  void read_compiler(const XmlElement& element);

  std::vector<std::unique_ptr<File>> files_;
  std::map<const tinyxml2::XMLElement*, const File*> included_;  ///< by the <include>
  std::vector<std::string> missing_;
  std::map<std::string, Class> classes_;
  std::string main_ = "main";  ///< class of elements without one
  Compiler compiler_;
};

}  // namespace verp::mjcf
