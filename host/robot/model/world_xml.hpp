#pragma once
#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "host/robot/model/world.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// The XML of a world's file: its lines, its numbers read strictly, and the robots that it
/// includes, which libsdformat is not asked about.
class WorldXml {
 public:
  /// Throws LoadError: not readable, malformed, no or several <world>, a number that is none.
  explicit WorldXml(const std::string& path);

  const std::string& path() const { return path_; }
  XmlElement world() const { return XmlElement(path_, *world_); }
  /// Of the model, link, light, ... of that name; the world's if there is none.
  int line_of(const std::string& name) const;
  /// Of the first name in `message` that is one; the world's else.
  int blame(const std::string& message) const;
  /// The file as it is, with nothing where robots are included: same lines.
  const std::string& text_without_robots() const { return text_; }
  std::vector<WorldRobot> robots() const;

 private:
  void inspect(const tinyxml2::XMLElement& element);
  void blank_includes();

  std::string path_, text_;
  tinyxml2::XMLDocument document_;
  const tinyxml2::XMLElement* world_ = nullptr;
  std::map<std::string, int> lines_;
};

}  // namespace verp::model
