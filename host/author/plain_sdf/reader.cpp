#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/author/plain_sdf/links.hpp"
#include "host/author/plain_sdf/plain_sdf.hpp"
#include "host/robot/model/unread.hpp"

namespace verp::plain_sdf {
namespace {

/// A joint between two links.
struct Edge {
  std::size_t joint = 0;
  std::string parent, child;
  bool is_used = false;
};

/// From one list of links and joints to a tree of bodies.
class Reader {
 public:
  Reader(const Document& document, Flat& flat) : flat_(flat), reader_(document, flat, out_) {}

  mjcf::Robot read() {
    out_.name = flat_.name;
    if (flat_.links.empty()) flat_.at.fail("there is no <link> in it", "give a robot's SDF");
    find_edges();
    keep_joint_names();
    add_root(root());
    for (const Edge& each : edges_) {
      if (!each.is_used && places_.contains(each.parent) && places_.contains(each.child))
        flat_.lose("joints that close a loop: it is open", joint(each).name);
    }
    for (const FoundPart& link : flat_.links) {
      if (!places_.contains(link.name)) flat_.lose("links that no joint holds", link.name);
    }
    couple();
    tell();
    return std::move(out_);
  }

 private:
  const FoundPart& joint(const Edge& edge) const { return flat_.joints[edge.joint]; }

  void find_edges() {
    for (std::size_t i = 0; i < flat_.joints.size(); ++i) {
      const FoundPart& each = flat_.joints[i];
      const std::string parent = text_in(each.at, "parent"), child = text_in(each.at, "child");
      if (each.at.text("type") == "gearbox") {
        flat_.lose("gearboxes between joints", each.name);
      } else if (parent == "world" || child == "world") {
        flat_.lose("joints to the world: the robot stands free", each.name);
      } else {
        edges_.push_back({i, link_at(each, "parent"), link_at(each, "child")});
        if (edges_.back().parent == edges_.back().child)
          each.at.fail(
              "joint '" + each.name + "' holds link '" + edges_.back().child + "' to itself",
              "correct its <parent> or <child>");
      }
    }
  }

  std::string link_at(const FoundPart& joint, const char* end) const {
    const XmlElement at = *first(joint.at, end);
    return flat_.frames.link_of(joint.scope.whole(text_in(joint.at, end), ""), at);
  }

  static std::string last_of(const std::string& whole) {
    const std::size_t at = whole.rfind("::");
    return at == whole.npos ? whole : whole.substr(at + 2);
  }

  /// The last part of a nested name, where that is the only one.
  std::string plain(const std::string& whole) const {
    if (last_parts_.count(last_of(whole)) == 1) return last_of(whole);
    std::string all = whole;
    for (std::size_t i = all.find("::"); i != all.npos; i = all.find("::")) all.replace(i, 2, "_");
    return all;
  }

  /// Links make way: owners write joints' names.
  void keep_joint_names() {
    for (const auto* parts : {&flat_.links, &flat_.joints}) {
      for (const FoundPart& each : *parts) last_parts_.insert(last_of(each.name));
    }
    for (const FoundPart& each : flat_.joints) {
      if (!moves(each.at)) continue;
      std::string name = plain(each.name);
      while (!names_.insert(name).second) name += "_";
      joint_names_[each.name] = name;
    }
  }

  /// A fixed joint is called like its link and "_fixed".
  std::string free_name(const std::string& whole) {
    const std::string wished = plain(whole);
    std::string name = wished;
    for (int i = 2; names_.contains(name) || names_.contains(name + "_fixed"); ++i)
      name = i == 2 ? wished + "_link" : fmt::format("{}_link_{}", wished, i);
    names_.insert(name);
    return name;
  }

  std::set<std::string> tree_of(const std::string& link) const {
    std::set<std::string> found = {link};
    for (bool grew = true; grew;) {
      grew = false;
      for (const Edge& each : edges_) {
        if (found.contains(each.parent) == found.contains(each.child)) continue;
        found.insert(each.parent), found.insert(each.child);
        grew = true;
      }
    }
    return found;
  }

  /// The first link that is no child, in the tree with most joints.
  const FoundPart& root() const {
    std::set<std::string> seen;
    const FoundPart* best = nullptr;
    std::ptrdiff_t most = -1;
    for (const FoundPart& link : flat_.links) {
      if (seen.contains(link.name)) continue;
      const std::set<std::string> tree = tree_of(link.name);
      seen.insert(tree.begin(), tree.end());
      const auto count = std::count_if(edges_.begin(), edges_.end(), [&](const Edge& each) {
        return tree.contains(each.child) && moves(joint(each).at);
      });
      if (count <= most) continue;
      most = count;
      best = &root_of(tree, link);
    }
    return *best;
  }

  const FoundPart& root_of(const std::set<std::string>& tree, const FoundPart& fallback) const {
    for (const FoundPart& link : flat_.links) {
      const bool is_child = std::any_of(edges_.begin(), edges_.end(),
                                        [&](const Edge& each) { return each.child == link.name; });
      if (tree.contains(link.name) && !is_child) return link;
    }
    return fallback;
  }

  const FoundPart& link_named(const std::string& name) const {
    return *std::find_if(flat_.links.begin(), flat_.links.end(),
                         [&](const FoundPart& each) { return each.name == name; });
  }

  /// Below a frame that is upright, where the link is not.
  void add_root(const FoundPart& link) {
    const Transform at = flat_.frames.place(link.name, link.at);
    const model::Mat3 turn = flat_.pose.linear() * at.linear();
    const bool is_upright = (turn - model::Mat3::Identity()).norm() < 1e-9;
    if (!is_upright) {
      mjcf::Body base;
      base.name = free_name(flat_.name + "_frame");
      out_.bodies.push_back(base);
    }
    mjcf::Body body = reader_.body_of(link);
    body.name = free_name(link.name);
    body.parent = is_upright ? -1 : 0;
    if (!is_upright) body.pose.linear() = turn;
    add(link, std::move(body));
    for (std::size_t i = 0; i < order_.size(); ++i) add_below(std::string(order_[i]));  // it grows
  }

  void add(const FoundPart& link, mjcf::Body body) {
    const int place = static_cast<int>(out_.bodies.size());
    places_[link.name] = place;
    order_.push_back(link.name);
    out_.bodies.push_back(std::move(body));
    for (const Transform& pose : reader_.imus_on(link)) add_imu(place, pose);
  }

  void add_imu(int on, const Transform& pose) {
    mjcf::Body& body = out_.bodies[static_cast<std::size_t>(on)];
    if (pose.isApprox(Transform::Identity(), 1e-9)) {
      body.has_imu = true;
      return;
    }
    mjcf::Body chip;
    chip.name = free_name(body.name + "_imu");
    chip.parent = on;
    chip.pose = pose;
    chip.has_imu = true;
    out_.bodies.push_back(chip);
  }

  /// The nearest links first, so that a loop opens where it is longest.
  void add_below(const std::string& above) {
    for (Edge& each : edges_) {
      if (each.is_used || (each.parent != above && each.child != above)) continue;
      const bool is_reversed = each.child == above;
      const std::string& below = is_reversed ? each.parent : each.child;
      if (places_.contains(below)) continue;
      each.is_used = true;
      hang(link_named(below), above, joint(each), is_reversed ? -1 : 1);
    }
  }

  void hang(const FoundPart& link, const std::string& above, const FoundPart& by, double sign) {
    mjcf::Body body = reader_.body_of(link);
    body.name = free_name(link.name);
    body.parent = places_.at(above);
    const Transform place = flat_.frames.place(link.name, link.at);
    body.pose = flat_.frames.place(above, link.at).inverse() * place;
    const std::string type = by.at.text("type");
    if (type == "ball" || type == "screw")
      flat_.lose("joints of type " + type + ": fixed", by.name);
    if (moves(by.at)) {
      const Vec3 at_m = place.inverse() * reader_.place_of(by).translation();
      const bool turns_twice = type == "universal" || type == "revolute2";
      for (const char* const axis : {"axis", "axis2"}) {
        const bool is_second = std::string(axis) == "axis2";
        if (is_second && !turns_twice) break;
        mjcf::Joint own = reader_.joint_of(by, axis);
        own.name = joint_names_.at(by.name) + (is_second ? "_2" : "");
        own.at_m = at_m;
        own.axis = sign * (place.linear().transpose() * own.axis);
        body.joints.push_back(own);
      }
      if (sign < 0) std::reverse(body.joints.begin(), body.joints.end());
    }
    add(link, std::move(body));
  }

  /// <mimic>, which SDF has from 1.11 on.
  void couple() {
    for (const FoundPart& each : flat_.joints) {
      const auto axis = first(each.at, "axis");
      const auto mimic = axis ? first(*axis, "mimic") : std::nullopt;
      if (!mimic || !moves(each.at)) continue;
      const auto driver = joint_names_.find(each.scope.whole(mimic->text("joint", ""), ""));
      if (driver == joint_names_.end())
        mimic->fail("there is no joint '" + mimic->text("joint", "") + "'", "name one that moves");
      const double factor = free_number_in(*mimic, "multiplier", 1);
      out_.followers.push_back(
          {joint_names_.at(each.name), driver->second,
           free_number_in(*mimic, "offset", 0) - factor * free_number_in(*mimic, "reference", 0),
           factor});
    }
  }

  void tell() {
    for (std::string& each : model::lines_of(flat_.lost)) out_.left_out.push_back(std::move(each));
  }

  Flat& flat_;
  mjcf::Robot out_;
  LinkReader reader_;
  std::vector<Edge> edges_;
  std::multiset<std::string> last_parts_;
  std::set<std::string> names_;
  std::map<std::string, std::string> joint_names_;  ///< by the whole name
  std::map<std::string, int> places_;               ///< of links, in the bodies
  std::vector<std::string> order_;
};

void refuse_own(const XmlElement& model) {
  for (const XmlElement& each : model.children()) {
    if (!each.name().starts_with("verp:")) continue;
    each.fail("this is a robot of VERP already", "walk it as it is: verp walk " + model.file());
  }
}

/// The models of the file and of its worlds.
std::vector<Flat> models_of(Document& document) {
  std::vector<Flat> found;
  std::vector<XmlElement> places = document.root().children("world");
  places.push_back(document.root());
  for (const XmlElement& place : places) {
    for (const XmlElement& each : place.children()) {
      if (each.name() == "model") {
        refuse_own(each);
        found.push_back(flatten(document, each, nullptr));
      } else if (each.name() == "include") {
        if (const auto model = document.included(each))
          found.push_back(flatten(document, *model, &each));
      }
    }
  }
  if (found.empty()) document.root().fail("there is no <model> in it", "give a robot's SDF file");
  return found;
}

}  // namespace

mjcf::Robot read_robot(const std::string& path) {
  Document document(path);
  std::vector<Flat> models = models_of(document);
  const auto robot = std::max_element(
      models.begin(), models.end(),
      [](const Flat& a, const Flat& b) { return a.moving_joints() < b.moving_joints(); });
  for (const Flat& each : models) {
    if (&each != &*robot) robot->lose("models beside the robot", each.name);
  }
  return Reader(document, *robot).read();
}

}  // namespace verp::plain_sdf
