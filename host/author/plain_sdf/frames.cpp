#include "host/author/plain_sdf/frames.hpp"

#include "host/robot/model/load_error.hpp"

namespace verp::plain_sdf {

std::string Scope::whole(const std::string& name, const std::string& fallback) const {
  if (name.empty()) return fallback;
  return name == kModel ? model : prefix + name;
}

const Frame& Frames::find(const std::string& name, const XmlElement& at) const {
  const auto found = frames_.find(name);
  if (found == frames_.end())
    at.fail("there is no link, joint, frame or model '" + name + "'", "name one that exists");
  return found->second;
}

Transform Frames::place_in(const std::string& root, const std::string& name, const XmlElement& at,
                           std::size_t depth) const {
  if (name == root) return Transform::Identity();
  const bool is_whole = root == kModel;
  if (const auto known = known_.find(name); is_whole && known != known_.end()) return known->second;
  const Frame& frame = find(name, at);
  if (depth > frames_.size())
    frame.at.fail("the pose of '" + name + "' is given in itself", "correct its relative_to");
  Transform out = place_in(root, frame.base, frame.at, depth + 1) * frame.pose;
  if (!frame.placement.empty())
    out = out * place_in(name, frame.placement, frame.at, depth + 1).inverse();
  if (is_whole) known_[name] = out;
  return out;
}

Transform Frames::place(const std::string& name, const XmlElement& at) const {
  return place_in(kModel, name, at, 0);
}

std::string Frames::link_of(const std::string& name, const XmlElement& at) const {
  std::string on = name;
  for (std::size_t depth = 0; depth <= frames_.size(); ++depth) {
    const Frame& frame = find(on, at);
    if (frame.rides_on.empty()) return on;
    on = frame.rides_on;
  }
  at.fail("'" + name + "' hangs on itself", "correct its attached_to");
}

}  // namespace verp::plain_sdf
