#pragma once
#include <map>
#include <string>
#include <vector>

#include "host/author/plain_sdf/frames.hpp"

namespace verp::plain_sdf {

struct FoundPart {
  std::string name;  ///< whole
  XmlElement at;
  Scope scope;
};

/// A model with all that it nests and includes, in one list.
struct Flat {
  explicit Flat(const XmlElement& model) : at(model), frames(model) {}

  XmlElement at;
  std::string name;
  Transform pose = Transform::Identity();  ///< in its file or world
  Frames frames;
  std::vector<FoundPart> links, joints;
  std::map<std::string, std::vector<std::string>> lost;  ///< names, by what they are

  void lose(const std::string& what, const std::string& which) { lost[what].push_back(which); }
  std::size_t moving_joints() const;
};

/// Whether a joint of that type moves in a robot of VERP, or in one with sliding joints.
bool moves(const XmlElement& joint);
/// Throws LoadError for an element without a name.
std::string name_of(const XmlElement& element);

/// `include`: the element that includes the model; null: none.
Flat flatten(Document& document, const XmlElement& model, const XmlElement* include);

}  // namespace verp::plain_sdf
