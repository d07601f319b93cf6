#include "host/author/import/wrapper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/os/files/markup_text.hpp"

namespace verp::import {
namespace {

using files::markup_text;

constexpr int kImuId = 120;

/// SDF's pose: metres, then turns about fixed x, y, z.
std::string pose_text(const Transform& pose) {
  const Eigen::Matrix3d r = pose.linear();
  const double pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  const double roll = std::atan2(r(2, 1), r(2, 2)), yaw = std::atan2(r(1, 0), r(0, 0));
  const auto number = [](double value) { return std::abs(value) < 5e-7 ? 0.0 : value; };
  const Vec3 at = pose.translation();
  return fmt::format("<pose>{:.6g} {:.6g} {:.6g} {:.7g} {:.7g} {:.7g}</pose>", number(at.x()),
                     number(at.y()), number(at.z()), number(roll), number(pitch), number(yaw));
}

class Writer {
 public:
  Writer(const Wrapper& wrapper, const Skeleton& skeleton, const Body& body)
      : w_(wrapper), s_(skeleton), b_(body) {}

  std::string write() {
    out_ = "<?xml version=\"1.0\" ?>\n";
    line(0,
         "<!-- Made by `verp import`. import.md beside it says what was read and what was guessed. "
         "-->");
    line(0, "<sdf version=\"1.9\" xmlns:verp=\"https://verp.dev/sdf/1\">");
    line(1, fmt::format("<model name=\"{}\">", markup_text(w_.name)));
    line(2, fmt::format("<include merge=\"true\"><uri>{}</uri></include>", markup_text(w_.uri)));
    frames();
    limbs();
    left_out();
    bus();
    poses();
    for (const auto& [name, value] : w_.tuning)
      line(2, fmt::format("<verp:tuning name=\"{}\" value=\"{:.4g}\"/>", name, value));
    line(1, "</model>");
    line(0, "</sdf>");
    return std::move(out_);
  }

 private:
  void line(int depth, const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + text + '\n';
  }
  const LinkPart& link(int index) const { return s_.links[static_cast<std::size_t>(index)]; }
  const Bone& bone(int index) const { return s_.bones[static_cast<std::size_t>(index)]; }
  bool is_probe() const { return w_.soles.empty(); }

  void frame(const char* name, int on, const Transform& in_body) {
    const Transform pose = link(on).pose.inverse() * w_.body * in_body;
    line(2, fmt::format("<frame name=\"{}\" attached_to=\"{}\">{}</frame>", name,
                        markup_text(link(on).name), pose_text(pose)));
  }

  static Transform at(const Vec3& place) { return Transform(Eigen::Translation3d(place)); }

  void box(const char* on, const Vec3& centre, const Vec3& size) {
    line(2,
         fmt::format("<verp:box frame=\"{}\" centre=\"{:.6g} {:.6g} {:.6g}\" size=\"{:.6g} {:.6g} "
                     "{:.6g}\" friction=\"0.8\"/>",
                     on, centre.x(), centre.y(), centre.z(), size.x(), size.y(), size.z()));
  }

  void frames() {
    const Transform pose = link(b_.trunk).pose.inverse() * w_.body;
    line(2, fmt::format("<verp:body link=\"{}\">{}</verp:body>", markup_text(link(b_.trunk).name),
                        pose_text(pose)));
    for (std::size_t side = 0; side < w_.soles.size(); ++side) {
      const Sole& sole = w_.soles[side];
      const char* const name = side == 0 ? "verp_l_sole" : "verp_r_sole";
      const double thick_m = std::max(0.002, sole.length_m / 16);
      frame(name, b_.legs[side].tip, sole.pose);
      box(name, {0, 0, thick_m / 2}, {sole.length_m, sole.width_m, thick_m});
    }
    if (!w_.trunk_box) return;
    frame("verp_trunk", b_.trunk, at(w_.trunk_box->center()));
    box("verp_trunk", Vec3::Zero(), w_.trunk_box->sizes());
  }

  void limbs() {
    if (is_probe()) return;
    const auto limb = [&](const std::string& name, int base, const std::string& tip) {
      line(2, fmt::format("<verp:limb name=\"{}\" base=\"{}\" tip=\"{}\"/>", name,
                          markup_text(link(base).name), tip));
    };
    limb("left_leg", b_.trunk, "verp_l_sole");
    limb("right_leg", b_.trunk, "verp_r_sole");
    int base = b_.trunk;
    for (const FoundLimb& each : b_.others) {  // the waist is the first of them
      limb(each.name, base, markup_text(link(each.tip).name));
      if (each.name == "waist") base = each.tip;
    }
  }

  bool is_foot(const LinkPart& part) const {
    const int at = static_cast<int>(&part - s_.links.data());
    for (const FoundLimb& leg : b_.legs) {
      for (const int below : s_.hanging_on(leg.tip)) {
        if (below == at) return true;
      }
    }
    return false;
  }

  bool is_weighed(const std::string& link) const {
    return std::any_of(w_.balls.begin(), w_.balls.end(),
                       [&](const Ball& ball) { return ball.link == link && ball.mass_kg > 0; });
  }

  bool reaches_below(const std::string& link) const {
    return std::find(w_.below_soles.begin(), w_.below_soles.end(), link) != w_.below_soles.end();
  }

  void drop(const char* what, const std::string& name, const char* reason) {
    line(2, fmt::format("<verp:drop what=\"{}\" name=\"{}\" reason=\"{}\"/>", what,
                        markup_text(name), reason));
  }

  void left_out() {
    for (const LinkPart& part : s_.links) {
      if (part.has_mesh_contact) {
        drop("collision", part.name, "contacts use boxes, not meshes");
      } else if (is_foot(part) && !is_probe() && part.has_contact) {
        drop("collision", part.name, "the sole is one box");
      } else if (part.has_contact && reaches_below(part.name)) {
        drop("collision", part.name, "it reaches below the soles");
      }
      if (part.mass_kg <= 0 && part.has_shape && !is_weighed(part.name))
        drop("massless_link", part.name, "the file gives it no mass");
    }
    for (const auto& [name, scale] : w_.inertia_scales) {
      line(2,
           fmt::format("<verp:inertia link=\"{}\" scale=\"{:.4g}\" reason=\"no body of this size "
                       "has the file's moments\"/>",
                       markup_text(name), scale));
    }
    for (const Ball& ball : w_.balls) {
      const std::string mass =
          ball.mass_kg > 0 ? fmt::format(" mass_kg=\"{:.4g}\"", ball.mass_kg) : "";
      line(2,
           fmt::format("<verp:inertia link=\"{}\" ball_m=\"{:.4g}\"{} reason=\"{}\"/>",
                       markup_text(ball.link), ball.radius_m, mass,
                       mass.empty() ? "no body has the file's moments" : "the file has no mass"));
    }
    for (const std::string& joint : w_.dropped_mimics)
      drop("mimic", joint, "the joint that it follows is fixed, or it is");
    for (const int each : w_.fixed) {
      line(2, fmt::format("<verp:fix joint=\"{}\" reason=\"walking does not need it\"/>",
                          markup_text(bone(each).name)));
    }
    for (const std::string& sensor : s_.sensors_to_drop)
      drop("sensor", sensor, "the twin has no such sensor, and walking does not need it");
    line(2, "<verp:no_collide link=\"*\" other=\"*\" reason=\"the maker's shapes overlap\"/>");
  }

  void bus() {
    for (const std::string& type : w_.own_types) line(2, type);
    if (w_.drops_friction) line(2, "<verp:friction from=\"servo\"/>");
    line(2, fmt::format("<verp:bus protocol=\"{}\">", w_.protocol));
    int id = 0;
    for (const ServoRow& row : w_.servos) {
      line(3, fmt::format("<verp:servo joint=\"{}\" id=\"{}\" type=\"{}\" lower_rad=\"{:.6g}\" "
                          "upper_rad=\"{:.6g}\"/>",
                          markup_text(bone(row.bone).name), ++id, row.type, row.lower_rad,
                          row.upper_rad));
    }
    line(2, "</verp:bus>");
    if (is_probe()) return;
    line(2, fmt::format("<verp:imu link=\"{}\" id=\"{}\" type=\"icm20648\"/>", imu_link(), kImuId));
  }

  std::string imu_link() const {
    const int imu = imu_of(s_, b_);
    return markup_text(link(imu < 0 ? b_.trunk : imu).name);
  }

  void poses() {
    if (w_.stand.empty()) return;
    for (const char* const pose : {"stand", "sit"}) {
      line(2, fmt::format("<verp:pose name=\"{}\">", pose));
      for (const auto& [joint, rad] : w_.stand)
        line(3, fmt::format("<verp:joint name=\"{}\" rad=\"{:.6g}\"/>", markup_text(joint), rad));
      line(2, "</verp:pose>");
    }
  }

  const Wrapper& w_;
  const Skeleton& s_;
  const Body& b_;
  std::string out_;
};

}  // namespace

int imu_of(const Skeleton& skeleton, const Body& body) {
  const std::vector<int> trunk = skeleton.turning_to(body.trunk);
  for (std::size_t i = 0; i < skeleton.links.size(); ++i) {
    if (!skeleton.links[i].has_imu) continue;
    const std::vector<int> way = skeleton.turning_to(static_cast<int>(i));
    const bool is_on_trunk = std::all_of(way.begin(), way.end(), [&](int bone) {
      return std::find(trunk.begin(), trunk.end(), bone) != trunk.end();
    });
    if (is_on_trunk) return static_cast<int>(i);
  }
  return -1;
}

std::string text_of(const Wrapper& wrapper, const Skeleton& skeleton, const Body& body) {
  return Writer(wrapper, skeleton, body).write();
}

}  // namespace verp::import
