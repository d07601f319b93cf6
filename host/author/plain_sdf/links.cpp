#include "host/author/plain_sdf/links.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/author/mjcf/solids.hpp"
#include "host/robot/model/number.hpp"

namespace verp::plain_sdf {
namespace {

constexpr double kNoLimit = 1e15;  // SDF's own word for it is 1e16

void read_moments(const XmlElement& inertial, mjcf::Inertial& own) {
  const auto inertia = first(inertial, "inertia");
  const auto at = [&](const char* name, double fallback) {
    return inertia ? number_in(*inertia, name, fallback) : fallback;
  };
  // An Eigen list that a refusal leaves unfinished ends the program where assertions are on.
  const double xx = at("ixx", 1), xy = at("ixy", 0), xz = at("ixz", 0), yy = at("iyy", 1),
               yz = at("iyz", 0), zz = at("izz", 1);
  own.inertia_kg_m2 << xx, xy, xz, xy, yy, yz, xz, yz, zz;
}

std::vector<double> colour_of(const XmlElement& visual) {
  const auto material = first(visual, "material");
  for (const char* const name : {"diffuse", "ambient"}) {
    const std::string text = material ? text_in(*material, name) : "";
    auto rgba = model::parse_numbers(text);
    if (!rgba || rgba->size() < 3) continue;
    rgba->resize(4, 1);
    return *rgba;
  }
  return {};
}

}  // namespace

Transform LinkReader::pose_on(const FoundPart& link, const XmlElement& part) const {
  const std::string frame = frame_of_pose(part);
  if (frame.empty()) return pose_in(part);
  const Transform at = flat_.frames.place(link.name, link.at);
  return at.inverse() * flat_.frames.place(link.scope.whole(frame, ""), part) * pose_in(part);
}

mjcf::Body LinkReader::body_of(const FoundPart& link) {
  mjcf::Body body;
  for (const XmlElement& each : link.at.children()) {
    if (each.name() == "collision" || each.name() == "visual") add_geom(link, each, body);
  }
  body.inertial = inertial_of(link, body);
  return body;
}

std::optional<mjcf::Inertial> LinkReader::inertial_of(const FoundPart& link,
                                                      const mjcf::Body& body) {
  const auto inertial = first(link.at, "inertial");
  if (!inertial) {
    flat_.lose("links without <inertial>: not SDF's 1 kg", link.name);
    return std::nullopt;
  }
  if (inertial->text("auto", "") == "true" || inertial->text("auto", "") == "1") {
    mjcf::Body solid = body;
    std::erase_if(solid.geoms, [](const mjcf::Geom& geom) { return !geom.touches; });
    return mjcf::inertial_of_geoms(solid, out_);
  }
  mjcf::Inertial own;
  if (!first(*inertial, "mass")) flat_.lose("links without <mass>: SDF's 1 kg", link.name);
  own.mass_kg = number_in(*inertial, "mass", 1);
  own.pose = pose_on(link, *inertial);
  read_moments(*inertial, own);
  return own;
}

void LinkReader::add_geom(const FoundPart& link, const XmlElement& part, mjcf::Body& body) {
  const auto geometry = first(part, "geometry");
  if (!geometry) return flat_.lose("shapes without <geometry>", part.text("name", ""));
  mjcf::Geom geom;
  geom.touches = part.name() == "collision";
  geom.is_seen = !geom.touches;
  geom.pose = pose_on(link, part);
  if (!read_shape(*geometry, geom)) {
    const auto* const shape = geometry->raw().FirstChildElement();
    const std::string kind = shape == nullptr ? "empty" : shape->Name();
    return flat_.lose("shapes of type " + kind, part.text("name", ""));
  }
  if (geom.is_seen) geom.rgba = colour_of(part);
  const auto inertial = first(link.at, "inertial");
  const double density = inertial ? number_in(*inertial, "density", 1000) : 1000;
  geom.density_kg_m3 = number_in(part, "density", density);
  body.geoms.push_back(geom);
}

bool LinkReader::read_shape(const XmlElement& geometry, mjcf::Geom& geom) {
  using Kind = mjcf::Geom::Kind;
  if (const auto mesh = first(geometry, "mesh")) {
    read_mesh(*mesh, geom);
  } else if (const auto box = first(geometry, "box")) {
    geom.kind = Kind::kBox;
    geom.size = vector_in(*box, "size", Vec3::Ones()) / 2;
  } else if (const auto sphere = first(geometry, "sphere")) {
    geom.kind = Kind::kSphere;
    geom.size = Vec3(number_in(*sphere, "radius", 1), 0, 0);
  } else if (const auto ellipsoid = first(geometry, "ellipsoid")) {
    geom.kind = Kind::kEllipsoid;
    geom.size = vector_in(*ellipsoid, "radii", Vec3::Ones());
  } else {
    const auto cylinder = first(geometry, "cylinder"), capsule = first(geometry, "capsule");
    if (!cylinder && !capsule) return false;
    const XmlElement& round = cylinder ? *cylinder : *capsule;
    geom.kind = cylinder ? Kind::kCylinder : Kind::kCapsule;
    geom.size = Vec3(number_in(round, "radius", 0.5), number_in(round, "length", 1) / 2, 0);
  }
  return true;
}

void LinkReader::read_mesh(const XmlElement& mesh, mjcf::Geom& geom) {
  const std::string uri = text_in(mesh, "uri");
  if (uri.empty()) mesh.fail("a <mesh> has no <uri>", "name its file");
  if (first(mesh, "submesh")) flat_.lose("<submesh>: the whole mesh is taken", uri);
  const std::string file = document_.picture(uri, mesh);
  if (file.empty()) flat_.lose("meshes that are not there", uri);
  geom.kind = mjcf::Geom::Kind::kMesh;
  geom.mesh = fmt::format("mesh_{}", out_.meshes.size());
  out_.meshes[geom.mesh] = {file.empty() ? uri : file, vector_in(mesh, "scale", Vec3::Ones())};
}

std::vector<Transform> LinkReader::imus_on(const FoundPart& link) const {
  std::vector<Transform> out;
  for (const XmlElement& sensor : link.at.children("sensor")) {
    if (sensor.text("type", "") == "imu") out.push_back(pose_on(link, sensor));
  }
  return out;
}

Transform LinkReader::place_of(const FoundPart& joint) const {
  const std::string base = joint.scope.whole(frame_of_pose(joint.at), "");
  const std::string child = joint.scope.whole(text_in(joint.at, "child"), kModel);
  return flat_.frames.place(base.empty() ? child : base, joint.at) * pose_in(joint.at);
}

Vec3 LinkReader::direction_of(const FoundPart& joint, const XmlElement& axis) const {
  const Vec3 own = vector_in(axis, "xyz", Vec3::UnitZ());
  const XmlElement at = first(axis, "xyz").value_or(axis);
  if (own.norm() < 1e-9) at.fail("the axis is zero", "write a direction, like 0 1 0");
  std::string frame = at.text("expressed_in", "");
  // Before SDF 1.5 axes were the model's; until 1.6 a flag said so.
  if (document_.version_of(axis) < 1.5 || flag_in(axis, "use_parent_model_frame")) frame = kModel;
  const Transform in =
      frame.empty() ? place_of(joint) : flat_.frames.place(joint.scope.whole(frame, ""), at);
  return in.linear() * own.normalized();
}

mjcf::Joint LinkReader::joint_of(const FoundPart& joint, const char* name) {
  mjcf::Joint out;
  out.slides = joint.at.text("type") == "prismatic";
  const auto found = first(joint.at, name);
  if (!found) joint.at.fail("joint '" + joint.name + "' has no <" + name + ">", "add it");
  out.axis = direction_of(joint, *found);
  const XmlElement limit = first(*found, "limit").value_or(*found);
  const XmlElement dynamics = first(*found, "dynamics").value_or(*found);
  const double lower = free_number_in(limit, "lower", -kNoLimit);
  const double upper = free_number_in(limit, "upper", kNoLimit);
  const bool has_lower = lower > -kNoLimit, has_upper = upper < kNoLimit;
  out.has_stops = (has_lower || has_upper) && joint.at.text("type") != "continuous";
  out.lower = has_lower ? lower : upper - 2 * std::numbers::pi;
  out.upper = has_upper ? upper : lower + 2 * std::numbers::pi;
  const auto positive = [](double value) { return value > 0 && value < kNoLimit ? value : 0; };
  out.motor.torque_n_m = positive(free_number_in(limit, "effort", 0));
  out.motor.no_load_rad_s = positive(free_number_in(limit, "velocity", 0));
  out.motor.damping_n_m_s = positive(free_number_in(dynamics, "damping", 0));
  out.motor.friction_n_m = positive(free_number_in(dynamics, "friction", 0));
  return out;
}

}  // namespace verp::plain_sdf
