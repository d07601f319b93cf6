#include "host/show/web/scene_json.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "host/os/files/base64.hpp"

namespace verp::web {
namespace {

using Json = nlohmann::json;
using scene::Vec2;
using scene::Vec3;

template <class Number>
std::string base64(const std::vector<Number>& values) {
  static_assert(sizeof(Number) == 4);
  return files::base64({reinterpret_cast<const char*>(values.data()), 4 * values.size()});
}

Json numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json pose_json(const scene::Transform& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Vec3 at = pose.translation();
  return {at.x(), at.y(), at.z(), q.x(), q.y(), q.z(), q.w()};
}

Json item_json(const scene::Item& item) {
  constexpr const char* kNames[] = {"box",   "sphere", "capsule",  "cylinder",
                                    "plane", "",       "triangles"};
  const scene::Material& m = item.material;
  const bool of_world = item.robot == scene::kWorld;
  Json json = {{"node", of_world ? -1 : item.node},
               {"body", of_world ? item.node : scene::kWorld},
               {"shape", kNames[static_cast<int>(item.shape)]},
               {"size", numbers(item.size_m)},
               {"round", item.round_m},
               {"pose", pose_json(item.pose)},
               {"rgba", {m.colour.r, m.colour.g, m.colour.b, m.colour.a}},
               {"glow", {m.glow.r, m.glow.g, m.glow.b}},
               {"rough", m.roughness},
               {"metal", m.metallic}};
  if (item.shape == scene::Shape::kTriangles && item.triangles) {
    std::vector<float> points;
    for (const Eigen::Vector3f& point : item.triangles->points)
      points.insert(points.end(), point.begin(), point.end());
    json["points"] = base64(points);
    json["corners"] = base64(item.triangles->indices);
  }
  return json;
}

Json rgb(const scene::Colour& c) {
  return {c.r, c.g, c.b};
}

Json air_json(const scene::Scene& scene) {
  Json lights = Json::array();
  for (const scene::Light& light : scene.lights) {
    lights.push_back({{"sun", light.kind == scene::Light::Kind::kSun},
                      {"at", numbers(light.position_m)},
                      {"toward", numbers(light.direction)},
                      {"rgb", rgb(light.colour)},
                      {"range", light.range_m},
                      {"shadows", light.shadows}});
  }
  return {{"floor", scene.ground.on ? rgb(scene.ground.light) : Json()},
          {"sky", rgb(scene.sky.horizon)},
          {"ambient", rgb(scene.ambient)},
          {"lights", lights}};
}

/// One frame: a row of viewer.js's columns.
class Row {
 public:
  explicit Row(std::vector<float>& out) : out_(out) {}
  void add(double value) { out_.push_back(static_cast<float>(value)); }
  void add(const Vec3& v) {
    for (const double value : v) add(value);
  }
  void add(const Eigen::Quaterniond& q) {  // x y z w
    for (const double value : q.coeffs()) add(value);
  }
  /// Unknown values are NaN.
  template <class Vector>
  void add(const std::optional<Vector>& v) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < Vector::SizeAtCompileTime; ++i) add(v ? (*v)[i] : kNone);
  }

 private:
  std::vector<float>& out_;
};

void add_frame(std::vector<float>& out, const scene::Snapshot& now, std::size_t joints) {
  Row row(out);
  const scene::RobotView& robot = now.robots.front();
  row.add(now.t_s);
  const scene::Transform& body = robot.link_world.front();
  row.add(Vec3(body.translation()));
  row.add(Eigen::Quaterniond(body.linear()));
  row.add(robot.phase);
  row.add(robot.gait_state);
  row.add(robot.com_world_m);
  row.add(robot.zmp_world_m);
  row.add(robot.zmp_planned_world_m);
  for (std::size_t side = 0; side < 2; ++side) {
    const bool has = side < robot.contacts.size();
    row.add(has ? robot.contacts[side].position_world_m : Vec3(Vec3::Zero()));
    row.add(has ? robot.contacts[side].force_world_n.z() : 0);
  }
  for (std::size_t j = 0; j < joints; ++j) row.add(robot.joint_rad[j]);
  for (const scene::Transform& moving : now.body_world) {
    row.add(Vec3(moving.translation()));
    row.add(Eigen::Quaterniond(moving.linear()));
  }
}

Json footstep_json(const std::vector<scene::Snapshot>& frames) {
  Json all = Json::array();
  for (const scene::Snapshot& now : frames) {
    Json steps = Json::array();
    for (const scene::Footstep& step : now.robots.front().footsteps) {
      const auto mm = [](double m) { return std::round(m * 1e4) / 1e4; };
      steps.push_back(
          {step.side, mm(step.at_world_m.x()), mm(step.at_world_m.y()), mm(step.yaw_rad)});
    }
    all.push_back(std::move(steps));
  }
  return all;
}

Json soles_json(const model::Entity& entity) {
  Json soles = Json::array();
  for (const char* name : {"left_leg", "right_leg"}) {
    for (const model::Limb& limb : entity.limbs) {
      if (limb.name != name) continue;
      soles.push_back(
          {limb.sole_min_m.x(), limb.sole_min_m.y(), limb.sole_max_m.x(), limb.sole_max_m.y()});
    }
  }
  return soles;
}

}  // namespace

std::string scene_json(const scene::Scene& scene, const std::vector<scene::Snapshot>& frames,
                       bool with_air) {
  const scene::Robot& robot = scene.robots.front();
  const model::Entity& entity = *robot.entity;
  double mass_kg = 0;
  for (const model::Node& node : entity.nodes) mass_kg += node.mass_kg;
  Json json = {{"name", robot.name},
               {"height", robot.height_m},
               {"weight", 9.81 * mass_kg},
               {"soles", soles_json(entity)},
               {"footsteps", footstep_json(frames)},
               {"joints", Json::array()},
               {"items", Json::array()}};
  for (const model::Joint& joint : entity.joints) {
    json["joints"].push_back({{"name", joint.name},
                              {"parent", joint.parent},
                              {"at", numbers(joint.origin_m)},
                              {"axis", numbers(joint.axis)}});
  }
  if (with_air) json["air"] = air_json(scene);
  json["bodies"] = frames.empty() ? 0 : frames.front().body_world.size();
  for (const scene::Item& item : scene.items) {
    if (!item.collision && item.shape != scene::Shape::kMesh)
      json["items"].push_back(item_json(item));
  }
  std::vector<float> values;
  for (const scene::Snapshot& now : frames) add_frame(values, now, entity.joints.size());
  json["frames"] = base64(values);
  json["count"] = frames.size();
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace verp::web
