#pragma once
#include <map>
#include <string>

#include "host/author/plain_sdf/document.hpp"

namespace verp::plain_sdf {

/// Where an element looks up names: a model's, or those of the model that it is merged into.
struct Scope {
  std::string prefix;  ///< "arm::"; empty: the robot's
  std::string model;   ///< the frame that __model__ is

  /// The whole name of a frame; `fallback` for none.
  std::string whole(const std::string& name, const std::string& fallback) const;
};

/// A link, joint, frame or model, by its whole name.
struct Frame {
  XmlElement at;
  std::string base;  ///< frame that the pose is given in
  Transform pose = Transform::Identity();
  std::string rides_on = {};   ///< frame that carries it; empty: it is a link
  std::string placement = {};  ///< frame of this model that the pose places; empty: its own
};

/// The frames of one robot. Places are in its model's frame, with all joints at zero.
class Frames {
 public:
  explicit Frames(const XmlElement& robot) : robot_(robot) {}

  /// False: the name is taken.
  bool add(const std::string& name, Frame frame) { return frames_.emplace(name, frame).second; }
  void carry(const std::string& name, const std::string& on) { frames_.at(name).rides_on = on; }
  bool has(const std::string& name) const { return frames_.contains(name); }

  /// Each throws LoadError at `at` for a name that no frame has, and at a frame of a loop.
  Transform place(const std::string& name, const XmlElement& at) const;
  std::string link_of(const std::string& name, const XmlElement& at) const;

 private:
  const Frame& find(const std::string& name, const XmlElement& at) const;
  Transform place_in(const std::string& root, const std::string& name, const XmlElement& at,
                     std::size_t depth) const;

  XmlElement robot_;
  std::map<std::string, Frame> frames_;
  mutable std::map<std::string, Transform> known_;
};

inline constexpr const char* kModel = "__model__";

}  // namespace verp::plain_sdf
