#include "host/author/plain_sdf/gather.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "host/robot/model/unread.hpp"

namespace verp::plain_sdf {
namespace {

constexpr int kMostDepth = 32;  // of models in models
constexpr std::array kTypes = {"revolute", "fixed",     "continuous", "prismatic", "ball",
                               "screw",    "universal", "gearbox",    "revolute2"};

class Gatherer {
 public:
  Gatherer(Document& document, Flat& flat) : document_(document), out_(flat) {}

  void add_contents(const XmlElement& model, const Scope& scope, int depth) {
    if (depth == kMostDepth) model.fail("models nest without an end", "remove the innermost");
    for (const XmlElement& each : model.children()) {
      const std::string kind = each.name();
      if (kind == "link") {
        add_link(each, scope);
      } else if (kind == "joint") {
        add_joint(each, scope);
      } else if (kind == "frame") {
        add_frame(each, scope);
      } else if (kind == "model") {
        add_model(each, nullptr, scope, depth);
      } else if (kind == "include") {
        add_include(each, scope, depth);
      } else {
        tell(each);
      }
    }
  }

 private:
  void add(const std::string& name, Frame frame) {
    const XmlElement at = frame.at;
    if (!out_.frames.add(name, std::move(frame)))
      at.fail("a second link, joint or frame is named '" + name + "'", "rename one");
  }

  static Frame placed(const XmlElement& at, const Scope& scope, const std::string& fallback) {
    return {at, scope.whole(frame_of_pose(at), fallback), pose_in(at)};
  }

  void add_link(const XmlElement& link, const Scope& scope) {
    const std::string name = scope.prefix + name_of(link);
    add(name, placed(link, scope, scope.model));
    out_.links.push_back({name, link, scope});
    for (const XmlElement& each : link.children("sensor")) tell(each);
    model::find_unread(link, out_.lost);
  }

  /// Before SDF 1.7 a joint may be named like a link; nothing refers to it then.
  void add_joint(const XmlElement& joint, const Scope& scope) {
    const std::string name = scope.prefix + name_of(joint);
    const std::string type = joint.text("type");
    if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end())
      joint.fail("there is no joint type '" + type + "'", "write revolute, or fixed");
    const auto same = [&](const FoundPart& each) { return each.name == name; };
    if (std::any_of(out_.joints.begin(), out_.joints.end(), same))
      joint.fail("a second joint is named '" + name + "'", "rename one");
    end_of(joint, "parent");
    const std::string child = end_of(joint, "child");
    Frame frame = placed(joint, scope, scope.whole(child, scope.model));
    frame.rides_on = scope.whole(child, scope.model);
    out_.frames.add(name, std::move(frame));
    out_.joints.push_back({name, joint, scope});
    for (const XmlElement& each : joint.children("sensor")) tell(each);
    model::find_unread(joint, out_.lost);
  }

  static std::string end_of(const XmlElement& joint, const char* end) {
    const std::string link = text_in(joint, end);
    if (link.empty())
      joint.fail("joint '" + name_of(joint) + "' has no <" + end + ">", "name a link in it");
    return link;
  }

  void add_frame(const XmlElement& frame, const Scope& scope) {
    const std::string on = scope.whole(frame.text("attached_to", ""), scope.model);
    Frame own = placed(frame, scope, on);
    own.rides_on = on;
    add(scope.prefix + name_of(frame), std::move(own));
  }

  void add_include(const XmlElement& include, const Scope& scope, int depth) {
    const auto model = document_.included(include);
    if (!model) return out_.lose("files that it includes are not there", text_in(include, "uri"));
    for (const XmlElement& each : include.children("plugin")) tell(each);
    add_model(*model, &include, scope, depth);
  }

  void add_model(const XmlElement& model, const XmlElement* include, const Scope& scope,
                 int depth) {
    std::string name = model.text("name", "");
    if (include != nullptr && !text_in(*include, "name").empty()) name = text_in(*include, "name");
    if (name.empty()) model.fail("a model in a model has no name", "add name=\"...\"");
    const bool merges = include != nullptr &&
                        (include->text("merge", "") == "true" || include->text("merge", "") == "1");
    Scope inner;
    inner.prefix = merges ? scope.prefix : scope.prefix + name + "::";
    inner.model = scope.prefix + (merges ? "_merged__" + name + "__model__" : name);
    const bool moved = include != nullptr && first(*include, "pose");
    Frame frame = placed(moved ? *include : model, scope, scope.model);
    std::string placement = model.text("placement_frame", "");
    if (include != nullptr && !text_in(*include, "placement_frame").empty())
      placement = text_in(*include, "placement_frame");
    frame.placement = inner.whole(placement, "");
    add(inner.model, std::move(frame));
    const std::size_t before = out_.links.size();
    add_contents(model, inner, depth + 1);
    const std::string canonical = inner.whole(model.text("canonical_link", ""), "");
    const std::size_t own = std::min(before, out_.links.size() - 1);
    out_.frames.carry(inner.model, !canonical.empty()   ? canonical
                                   : out_.links.empty() ? scope.model
                                                        : out_.links[own].name);
  }

  void tell(const XmlElement& each) {
    if (each.name() == "pose") return;
    if (each.name() != "sensor") return model::tell_unread(parent_of(each), each, out_.lost);
    if (each.text("type", "") != "imu")
      out_.lose("sensors", each.text("name", "") + " (" + each.text("type", "") + ")");
  }

  static XmlElement parent_of(const XmlElement& each) {
    return {each.file(), *each.raw().Parent()->ToElement()};
  }

  Document& document_;
  Flat& out_;
};

}  // namespace

std::string name_of(const XmlElement& element) {
  return element.text("name");
}

bool moves(const XmlElement& joint) {
  const std::string type = joint.text("type");
  return type == "revolute" || type == "continuous" || type == "prismatic" || type == "universal" ||
         type == "revolute2";
}

std::size_t Flat::moving_joints() const {
  return static_cast<std::size_t>(
      std::count_if(joints.begin(), joints.end(), [](const auto& each) { return moves(each.at); }));
}

Flat flatten(Document& document, const XmlElement& model, const XmlElement* include) {
  Flat out(model);
  const bool moved = include != nullptr && first(*include, "pose");
  out.name = include != nullptr ? text_in(*include, "name") : "";
  if (out.name.empty()) out.name = model.text("name", "robot");
  out.pose = pose_in(moved ? *include : model);
  Gatherer(document, out).add_contents(model, Scope{"", kModel}, 0);
  const std::string canonical = model.text("canonical_link", "");
  if (!out.links.empty()) {
    out.frames.add(kModel, {model, kModel});
    out.frames.carry(kModel, canonical.empty() ? out.links.front().name : canonical);
  }
  return out;
}

}  // namespace verp::plain_sdf
