#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "host/author/import/skeleton.hpp"

/// Robots of our own with the habits of CAD exporters. Their names have no meaning.
namespace verp::import {

struct Habits {
  double yaw_rad = 0;  ///< of the whole robot in its file
  int leg_joints = 6;  ///< 5: without ankle roll; 7: with toes
  bool has_hip_yaw = true;
  double knee_lower_rad = 0, knee_upper_rad = 2.4;
  double sole_ahead_m = 0.01;  ///< middle of the sole, from the ankle
  double moments_times = 1;    ///< a unit beside kg m2
  double sole_pitch_rad = 0;   ///< where all joints are at zero
  double sole_width_m = 0.06;
  bool feet_are_meshes = false;  ///< which nobody has
  bool feet_are_drawn = true;
  bool has_rods = false;  ///< beside each leg, drawn only, down to the height of its foot
  std::string meshes = "package://nowhere";
  bool has_wide_ankles = false;  ///< a block on each sole, wider than that
  bool has_low_shanks = false;   ///< a block on each, lower than the sole
  bool has_no_stops = false;     ///< continuous joints
  bool has_right_leg = true;
  bool has_rear_legs = false;
  bool has_waist = false;  ///< which carries both arms; their elbows cannot be at zero
  bool has_ears = false;   ///< on a head that turns and nods
  std::string in_names = "";
  std::string more = "";  ///< elements of the robot
  double leg_kg = 0.1;    ///< of each link but the foot
  double foot_kg = 0.1;   ///< below 0: without <inertial>
  double larger = 1, heavier = 1;
  double effort_n_m = 0, speed_rad_s = 0;  ///< of all limits
  std::string dynamics = "";               ///< element of each joint that turns
  double flatter = 1;  ///< least moment over the others: below 0 or above 2 no body has them
};

class Maker {
 public:
  explicit Maker(const Habits& habits) : h_(habits) {}

  std::string urdf() {
    text_ = "<robot name=\"Part Studio 1\">\n<link name=\"root\"/>\n";
    joint("root", "p1", "fixed", {0, 0, 0.3}, {0, 0, 0}, h_.yaw_rad);
    link("p1", 1.2, "<box size=\"0.08 0.12 0.15\"/>", {0, 0, 0});
    for (const int side : {1, -1}) {
      if (side > 0 || h_.has_right_leg) leg(side);
      if (h_.has_rear_legs) rear_leg(side);
      if (h_.has_waist) continue;
      joint("p1", arm(side), "revolute", {0, 0.085 * side, 0.06}, {0, 1, 0});
      link(arm(side), 0.2, "<box size=\"0.03 0.03 0.14\"/>", {0, 0, -0.07});
    }
    if (h_.has_waist) waist();
    if (h_.has_ears) head();
    return text_ + h_.more + "</robot>\n";
  }

 private:
  static std::string arm(int side) { return side > 0 ? "p2" : "p3"; }

  void leg(int side) {
    const Vec3 axes[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0},
                         {0, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const Vec3 places[] = {{0, 0.037 * side, -0.09}, {0, 0, -0.01}, {0, 0, 0},       {0, 0, -0.093},
                           {0, 0, -0.093},           {0, 0, 0},     {0.04, 0, -0.02}};
    std::string above = "p1";
    for (int k = 0; k < h_.leg_joints; ++k) {
      const std::string below = fmt::format("{}_{}", side > 0 ? "p4" : "p5", k);
      const char* const type = k > 0 || h_.has_hip_yaw ? "revolute" : "fixed";
      joint(above, below, type, places[k], axes[k], 0, k == 3 ? h_.knee_lower_rad : -1.6,
            k == 3 ? h_.knee_upper_rad : 1.6);
      const bool foot = k == std::min(h_.leg_joints, 6) - 1;
      const std::string shape = h_.feet_are_meshes
                                    ? "<mesh filename=\"" + h_.meshes + "/foot.stl\"/>"
                                    : fmt::format("<box size=\"0.1 {} 0.01\"/>", h_.sole_width_m);
      link(below, foot ? h_.foot_kg : h_.leg_kg, foot ? shape : "",
           {foot ? h_.sole_ahead_m : 0.0, 0, foot ? -0.025 : 0.0}, foot);
      if (foot && h_.has_wide_ankles) add_block(text_, -0.005);
      if (k == 3 && h_.has_low_shanks) add_block(text_, -0.12);
      above = below;
    }
    if (h_.has_rods) rods(side);
  }

  void rear_leg(int side) {
    std::string above = "p1";
    for (int k = 0; k < 3; ++k) {
      const std::string below = fmt::format("{}_{}", side > 0 ? "p11" : "p12", k);
      joint(above, below, "revolute", {k == 0 ? -0.2 : 0, k == 0 ? 0.04 * side : 0, -0.095},
            {0, 1, 0});
      link(below, 0.1, "", {0, 0, 0});
      above = below;
    }
  }

  /// Two bars with a joint at each end, as beside NimbRo's thighs and shanks.
  void rods(int side) {
    std::string above = side > 0 ? "p4_1" : "p5_1";
    for (int k = 0; k < 4; ++k) {
      const std::string below = fmt::format("{}_{}", side > 0 ? "p9" : "p10", k);
      joint(above, below, "revolute", {k == 0 ? 0.03 : 0, 0, k % 2 == 1 ? -0.0932 : 0}, {0, 1, 0});
      text_ += "<link name=\"" + below + "\"/>\n";
      above = below;
    }
  }

  void waist() {
    joint("p1", "p6", "revolute", {0, 0, 0.03}, {0, 0, 1});
    link("p6", 0.3, "", {0, 0, 0.03});
    for (const int side : {1, -1}) {
      joint("p6", arm(side), "revolute", {0, 0.085 * side, 0.03}, {0, 1, 0});
      link(arm(side), 0.1, "", {0, 0, -0.03});
      joint(arm(side), arm(side) + "e", "revolute", {0, 0, -0.07}, {0, 1, 0}, 0, -1.6, -0.1);
      link(arm(side) + "e", 0.1, "", {0, 0, -0.03});
    }
  }

  void head() {
    joint("p1", "p7", "revolute", {0, 0, 0.1}, {0, 0, 1});
    link("p7", 0.1, "", {0, 0, 0});
    joint("p7", "p8", "revolute", {0, 0, 0.01}, {0, 1, 0});
    link("p8", 0.1, "", {0, 0, 0});
    for (const int side : {1, -1}) {
      joint("p8", arm(side) + "r", "revolute", {0, 0.03 * side, 0.02}, {0, 1, 0});
      link(arm(side) + "r", 0.01, "", {0, 0, 0});
    }
  }

  /// On a foot at -0.005 its lower face is 1 cm above that of the sole.
  static void add_block(std::string& link, double z_m) {
    const std::string block = fmt::format(
        "<collision><origin xyz=\"0 0 {}\"/><geometry><box size=\"0.04 0.1 0.03\"/></geometry>"
        "</collision>",
        z_m);
    link.insert(link.rfind("</link>"), block);
  }

  void joint(const std::string& above, const std::string& below, const std::string& type,
             const Vec3& at, const Vec3& axis, double yaw = 0, double lower = -1.6,
             double upper = 1.6) {
    const bool endless = h_.has_no_stops && type == "revolute";
    text_ += fmt::format(
        "<joint name=\"{}{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>"
        "<origin xyz=\"{} {} {}\" rpy=\"0 0 {}\"/><axis xyz=\"{} {} {}\"/>{}</joint>\n",
        "j" + below, h_.in_names, endless ? "continuous" : type, above, below, h_.larger * at.x(),
        h_.larger * at.y(), h_.larger * at.z(), yaw, axis.x(), axis.y(), axis.z(),
        type == "fixed" || endless
            ? ""
            : fmt::format("<limit lower=\"{}\" upper=\"{}\" effort=\"{}\" velocity=\"{}\"/>{}",
                          lower, upper, h_.effort_n_m, h_.speed_rad_s, h_.dynamics));
  }

  void link(const std::string& name, double mass, const std::string& shape, const Vec3& at,
            bool is_foot = false) {
    const double mass_kg = h_.heavier * mass;
    const double moment = 4e-4 * mass_kg * h_.larger * h_.larger * h_.moments_times;
    text_ += fmt::format(
        "<link name=\"{0}\"><inertial><origin xyz=\"{1} {2} {3}\"/><mass value=\"{4}\"/><inertia "
        "ixx=\"{5}\" iyy=\"{5}\" izz=\"{6}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>",
        name, h_.larger * at.x(), h_.larger * at.y(), h_.larger * at.z(), mass_kg, moment,
        moment * h_.flatter);
    if (mass < 0) text_.resize(text_.rfind("<inertial>"));
    for (const char* what : {"visual", "collision"}) {
      if (shape.empty() || (is_foot && !h_.feet_are_drawn && *what == 'v')) continue;
      text_ += fmt::format(
          "<{0}><origin xyz=\"{1} {2} {3}\" rpy=\"0 {5} 0\"/><geometry>{4}</geometry></{0}>", what,
          h_.larger * at.x(), h_.larger * at.y(), h_.larger * at.z(), scaled(shape),
          is_foot ? h_.sole_pitch_rad : 0.0);
    }
    text_ += "</link>\n";
  }

  std::string scaled(const std::string& shape) const {
    Vec3 size;
    if (std::sscanf(shape.c_str(), "<box size=\"%lf %lf %lf", &size[0], &size[1], &size[2]) != 3)
      return shape;
    size *= h_.larger;
    return fmt::format("<box size=\"{} {} {}\"/>", size.x(), size.y(), size.z());
  }

  Habits h_;
  std::string text_;
};

}  // namespace verp::import
