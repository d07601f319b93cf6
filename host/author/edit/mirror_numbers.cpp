#include "host/author/edit/mirror_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/robot/model/number.hpp"

namespace verp::edit {
namespace {

/// Changes the sign and keeps the notation.
std::string negated(const std::string& number) {
  const auto value = model::parse_number(number);
  if (value && *value == 0) return number;
  if (number.starts_with('-')) return number.substr(1);
  return "-" + number.substr(number.starts_with('+') ? 1 : 0);
}

/// Negates some numbers of a row and keeps the blanks.
std::string negated(const std::string& row, const std::vector<std::size_t>& which) {
  std::string out;
  std::size_t number = 0;
  for (std::size_t at = 0; at < row.size(); ++number) {
    const std::size_t begin = std::min(row.find_first_not_of(" \t\r\n", at), row.size());
    const std::size_t end = std::min(row.find_first_of(" \t\r\n", begin), row.size());
    out += row.substr(at, begin - at);
    const std::string own = row.substr(begin, end - begin);
    const bool other = std::find(which.begin(), which.end(), number) != which.end();
    out += other && !own.empty() ? negated(own) : own;
    at = end;
  }
  return out;
}

/// A joint's axis: SDF's <axis><xyz> or URDF's <axis xyz>; x if URDF leaves it out.
std::vector<double> axis_of(const Document& document, int joint) {
  const int axis = document.child(joint, "axis");
  std::string text;
  if (axis >= 0)
    text = document.is_urdf() ? document.attribute(axis, "xyz") : document.child_text(axis, "xyz");
  const auto values = model::parse_numbers(text);
  if (values && values->size() == 3) return *values;
  return document.is_urdf() ? std::vector<double>{1, 0, 0} : std::vector<double>{0, 0, 1};
}

class Mirror {
 public:
  Mirror(const Document& document, const std::set<std::string>& changes,
         const std::set<std::string>& joints)
      : document_(document), changes_(changes), joints_(joints) {}

  std::vector<Splice> take() { return std::move(splices_); }

  void visit(int index) {
    const Element& element = document_.markup()[index];
    const bool is_joint = element.parent == document_.model() && element.name == "joint";
    if (is_joint) changes_sign_ = angle_changes_sign(document_, index);
    if (element.name.starts_with("verp:")) {
      own(element);
    } else if (document_.is_urdf()) {
      urdf(element);
    } else {
      sdf(index, element);
    }
    for (const int child : element.children) visit(child);
  }

 private:
  void put(Range at, const std::string& after) {
    const std::string before = document_.text().substr(at.begin, at.size());
    if (before != after) splices_.push_back({at.begin, before, after});
  }
  void negate(const Element& element, const char* name, const std::vector<std::size_t>& which) {
    const Attribute* found = element.attribute(name);
    if (found != nullptr) put(found->value_at, negated(found->value, which));
  }
  std::vector<std::size_t> axis_signs() const {
    return changes_sign_ ? std::vector<std::size_t>{1} : std::vector<std::size_t>{0, 2};
  }

  void swap(const Element& element, const char* low, const char* high) {
    const Attribute *lower = element.attribute(low), *upper = element.attribute(high);
    if (lower == nullptr && upper == nullptr) return;
    if (lower == nullptr || upper == nullptr) one_limit(element);
    put(lower->value_at, negated(upper->value));
    put(upper->value_at, negated(lower->value));
  }
  [[noreturn]] void one_limit(const Element& element) const {
    throw model::LoadError(document_.file().string(), element.line,
                           "one limit is open, and its mirror image the other", "give both limits");
  }

  void own(const Element& element) {
    negate(element, "centre", {1});
    negate(element, "com", {1});
    const Attribute* joint = element.attribute(element.name == "verp:joint" ? "name" : "joint");
    if (joint == nullptr || !joints_.contains(joint->value)) return;
    if (changes_.contains(joint->value)) {
      negate(element, "rad", {0});
      swap(element, "lower_rad", "upper_rad");
    } else if (element.name == "verp:servo") {
      turn(element);
    }
  }

  /// A mirrored servo's horn is on the other side.
  void turn(const Element& servo) {
    if (const Attribute* there = servo.attribute("direction")) {
      return put(there->value_at, there->value == "-1" ? "1" : "-1");
    }
    splices_.push_back({servo.attributes.back().at.end, "", " direction=\"-1\""});
  }

  void urdf(const Element& element) {
    if (element.name == "origin") {
      negate(element, "xyz", {1});
      negate(element, "rpy", {0, 2});
    } else if (element.name == "axis") {
      negate(element, "xyz", axis_signs());
    } else if (element.name == "inertia") {
      negate(element, "ixy", {0});
      negate(element, "iyz", {0});
    } else if (element.name == "limit" && changes_sign_) {
      swap(element, "lower", "upper");
    } else if (element.name == "mesh") {
      if (element.attribute("scale") != nullptr) return negate(element, "scale", {1});
      splices_.push_back({element.attributes.back().at.end, "", " scale=\"1 -1 1\""});
    }
  }

  void sdf(int index, const Element& element) {
    const Range at = document_.markup().text_at(index, document_.text());
    const auto put_text = [&](const std::vector<std::size_t>& which) {
      put(at, negated(document_.text().substr(at.begin, at.size()), which));
    };
    if (element.name == "pose") {
      put_text({1, 3, 5});  // y, roll, yaw; quaternion: y, qx, qz
    } else if (element.name == "xyz") {
      put_text(axis_signs());
    } else if (element.name == "ixy" || element.name == "iyz") {
      put_text({0});
    } else if (element.name == "limit" && changes_sign_) {
      limit(index);
    } else if (element.name == "mesh") {
      const int scale = document_.child(index, "scale");
      if (scale < 0) splices_.push_back({element.content.end, "", "<scale>1 -1 1</scale>"});
    } else if (element.name == "scale") {
      put_text({1});
    }
  }

  void limit(int index) {
    const int lower = document_.child(index, "lower"), upper = document_.child(index, "upper");
    if (lower < 0 && upper < 0) return;
    if (lower < 0 || upper < 0) one_limit(document_.markup()[index]);
    put(document_.markup().text_at(lower, document_.text()), negated(document_.text_of(upper)));
    put(document_.markup().text_at(upper, document_.text()), negated(document_.text_of(lower)));
  }

  const Document& document_;
  const std::set<std::string>&changes_, &joints_;
  bool changes_sign_ = false;
  std::vector<Splice> splices_;
};

}  // namespace

bool angle_changes_sign(const Document& document, int joint) {
  const auto axis = axis_of(document, joint);
  return std::abs(axis[1]) <= std::max(std::abs(axis[0]), std::abs(axis[2]));
}

std::vector<Splice> mirrored_numbers(const Document& document, int element,
                                     const std::set<std::string>& sign_changes,
                                     const std::set<std::string>& joints) {
  Mirror mirror(document, sign_changes, joints);
  mirror.visit(element);
  return mirror.take();
}

}  // namespace verp::edit
