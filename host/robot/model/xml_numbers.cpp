#include "host/robot/model/xml_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "host/robot/model/bounds.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/number.hpp"

namespace verp::model {
namespace {

// Far beyond any known robot, but within float32's 24 bits. At 10 m these resolve 1 um; mass times
// length squared stays near 1e5, so a sum of 30 links keeps the others' digits.
struct Numbers {
  std::size_t count;  // 0: any
  double low, high;
  const char* unit = "";
  bool is_pose = false;         // position, then angles
  bool may_be_endless = false;  // inf, -inf: no limit
  bool is_whole = false;        // libsdformat reads 1e9 as 1
  bool is_scale = false;        // zero leaves nothing
};
constexpr double kLargest = std::numeric_limits<float>::max();
constexpr Numbers kFree = {1, -kLargest, kLargest};  // of sensors: the controller never sees it
constexpr Numbers kCount = {1, 0, 1e9, "", false, false, true};
constexpr Numbers kMass = {1, 0, kMostMass_kg, " kg"};
constexpr Numbers kInertia = {1, -1e5, 1e5, " kg m2"};  // greatest mass at the greatest distance
constexpr Numbers kSize = {1, 0, kMostLength_m, " m"};
constexpr Numbers kSizes = {0, 0, kMostLength_m, " m"};
constexpr Numbers kPosition = {3, -kMostLength_m, kMostLength_m, " m"};
constexpr Numbers kDirection = {3, -kMostAngle, kMostAngle};
constexpr Numbers kLimit = {1, -kLargest, kLargest};  // from 1e16: no limit
constexpr Numbers kPose = {0, -kMostAngle, kMostAngle, "", true};
constexpr Numbers kScale = {0, -1e6, 1e6, "", false, false, false, true};
// the servo's limit also applies
constexpr Numbers kPower = {1, -kLargest, kLargest, "", false, true};
constexpr Numbers kResistance = {1, -100, 100};  // joint's, N m and N m s/rad

// SDF leaves; from mu1 on, those in a URDF's <gazebo>.
const std::map<std::string_view, Numbers> kSdfNumbers = {
    {"mass", kMass},
    {"ixx", kInertia},
    {"iyy", kInertia},
    {"izz", kInertia},
    {"ixy", kInertia},
    {"ixz", kInertia},
    {"iyz", kInertia},
    {"xyz", kDirection},
    {"lower", kLimit},
    {"upper", kLimit},
    {"velocity", kPower},
    {"effort", kPower},
    {"damping", kResistance},
    {"friction", kResistance},
    {"size", kSizes},
    {"radius", kSize},
    {"length", kSize},
    {"mu", {1, 0, kMostFriction}},
    {"mu2", {1, 0, kMostFriction}},
    {"kp", {1, 1, kMostStiffness_n_m, " N/m"}},
    {"kd", {1, 0, kMostDamping_n_s_m, " N s/m"}},
    {"pose", kPose},
    {"scale", kScale},
    {"update_rate", kFree},
    {"min", kFree},
    {"max", kFree},
    {"resolution", kFree},
    {"width", kCount},
    {"height", kCount},
    {"horizontal_fov", kFree},
    {"near", kFree},
    {"far", kFree},
    {"fx", kFree},
    {"fy", kFree},
    {"cx", kFree},
    {"cy", kFree},
    {"k1", kFree},
    {"k2", kFree},
    {"k3", kFree},
    {"p1", kFree},
    {"p2", kFree},
    {"stddev", kFree},
    {"mean", kFree},
    {"bias_mean", kFree},
    {"bias_stddev", kFree},
    {"samples", kCount},
    {"min_angle", kFree},
    {"max_angle", kFree},
    {"mu1", {1, 0, kMostFriction}},
    {"maxVel", kFree},
    {"minDepth", kFree},
    {"maxContacts", kFree},
    {"stopCfm", kFree},
    {"stopErp", kFree},
    {"stopKp", kFree},
    {"stopKd", kFree},
    {"springStiffness", kFree},
    {"springReference", kFree},
    {"fudgeFactor", kFree},
    {"dampingFactor", kFree},
    {"laserRetro", kFree}};

// Attributes of URDF, as ATTRIBUTE or ELEMENT.ATTRIBUTE.
const std::map<std::string, Numbers, std::less<>> kUrdfNumbers = {
    {"xyz", kPosition},         {"rpy", kDirection},      {"ixx", kInertia},
    {"iyy", kInertia},          {"izz", kInertia},        {"ixy", kInertia},
    {"ixz", kInertia},          {"iyz", kInertia},        {"lower", kLimit},
    {"upper", kLimit},          {"effort", kPower},       {"velocity", kPower},
    {"mass.value", kMass},      {"sphere.radius", kSize}, {"cylinder.radius", kSize},
    {"cylinder.length", kSize}, {"box.size", kSizes},     {"mesh.scale", kScale}};

const Numbers* urdf_numbers(const std::string& element, const std::string& attribute) {
  auto found = kUrdfNumbers.find(element + "." + attribute);
  if (found == kUrdfNumbers.end()) found = kUrdfNumbers.find(attribute);
  return found == kUrdfNumbers.end() ? nullptr : &found->second;
}

void check(const std::string& file, int line, const std::string& what, const std::string& text,
           const Numbers& wanted) {
  if (wanted.may_be_endless && is_infinity(text)) return;
  const auto values = parse_numbers(text);
  const std::size_t count = wanted.count;
  if (!values || (count != 0 && values->size() != count)) {
    throw LoadError(
        file, line,
        what + " is not " +
            (count > 1 ? std::to_string(count) + " finite numbers" : "a finite number") + ": '" +
            text + "'",
        "write digits with a decimal point, like 0.125");
  }
  if (wanted.is_whole && text.find_first_not_of("0123456789 \t\r\n") != text.npos)
    throw LoadError(file, line, what + " is not a whole number: '" + text + "'",
                    "write digits only, like 320");
  const auto is_zero = [](double value) { return std::abs(value) < 1e-9; };
  if (wanted.is_scale && std::any_of(values->begin(), values->end(), is_zero))
    throw LoadError(file, line, what + " is zero: '" + text + "'",
                    "write 1 for the file's own size");
  if (wanted.is_pose && values->size() == 7 &&
      std::all_of(values->begin() + 3, values->end(), is_zero))
    throw LoadError(file, line, "its quaternion is zero", "write x y z w, like 0 0 0 1");
  for (std::size_t i = 0; i < values->size(); ++i) {
    const Numbers& bounds = wanted.is_pose && i < 3 ? kPosition : wanted;
    require_within(file, line, what, (*values)[i], bounds.low, bounds.high, bounds.unit);
  }
}

}  // namespace

void check_leaf(const std::string& file, int line, const std::string& element,
                const std::string& text, bool is_urdf) {
  const auto wanted = kSdfNumbers.find(element);
  if (wanted == kSdfNumbers.end()) return;
  // An empty pose is no pose; <friction> is also a container. Other empty elements would mean
  // libsdformat's default: 1 kg for an empty <mass>.
  if (text.empty() && (wanted->second.is_pose || element == "friction")) return;
  const bool one = wanted->second.count == 1;
  if (is_urdf && !one) return;
  check(file, line, "<" + element + ">", text, is_urdf ? kFree : wanted->second);
}

void check_urdf_attribute(const std::string& file, int line, const std::string& element,
                          const std::string& attribute, const std::string& text) {
  const Numbers* const wanted = urdf_numbers(element, attribute);
  if (wanted != nullptr) check(file, line, "<" + element + "> " + attribute, text, *wanted);
}

void require_numbers(const std::string& file, int line, const std::string& what,
                     const std::string& text, std::size_t count) {
  check(file, line, what, text, count == 3 ? kPosition : kFree);
}

}  // namespace verp::model
