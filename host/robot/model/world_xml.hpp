#pragma once
#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "host/robot/model/world.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// The XML of a world's file: its lines, its numbers read strictly, and its included robots, which
/// libsdformat does not see.
class WorldXml {
 public:
  /// Throws LoadError if the file is unreadable or malformed, has not exactly one <world>, or has
  /// an invalid number.
  explicit WorldXml(const std::string& path);

  const std::string& path() const { return path_; }
  XmlElement world() const { return XmlElement(path_, *world_); }
  /// Line of the named model, link, light, ...; the world's if there is none.
  int line_of(const std::string& name) const;
  /// Line of the first known name in `message`; otherwise the world's.
  int blame(const std::string& message) const;
  /// The file with included robots blanked out; the line numbers stay.
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
