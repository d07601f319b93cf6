#pragma once
#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "host/robot/model/world.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// Lines, strict numbers, and included robots, which libsdformat does not see.
class WorldXml {
 public:
  /// Throws LoadError if unreadable, malformed, without exactly one <world>, or with an invalid
  /// number.
  explicit WorldXml(const std::string& path);

  const std::string& path() const { return path_; }
  XmlElement world() const { return XmlElement(path_, *world_); }
  /// Line of the named model, link, light, ...; else the world's.
  int line_of(const std::string& name) const;
  /// Line of the first known name in `message`; else the world's.
  int blame(const std::string& message) const;
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
