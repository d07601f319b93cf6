#include "host/show/web/replay_page.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/os/files/base64.hpp"
#include "host/os/files/whole.hpp"
#include "host/show/scene/build.hpp"
#include "host/show/scene/from_trace.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/show/web/viewer.hpp"

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

/// First robot for viewer.js: tree, shapes, and frames as float32 in base64. Frame: body pose,
/// joint angles, marks. `with_air`: the scene's floor, sky and lights replace the page's.
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

constexpr double kFrame_s = 0.03;           // as long as a gait state
constexpr std::size_t kMostFrames = 20000;  // ten minutes; then skips frames

constexpr const char* kStyle = R"(
.replay { position:relative; padding:0; overflow:hidden; }
.replay canvas { display:block; width:100%; aspect-ratio:16/9; touch-action:none; cursor:grab; }
.replay .bar { display:flex; gap:.6rem; align-items:center; flex-wrap:wrap; padding:.6rem .9rem; font-size:.9rem; }
.replay .bar input[type=range] { flex:1 1 12rem; } .replay .bar label { white-space:nowrap; }
.replay .said { position:absolute; left:.9rem; top:.7rem; font:600 .85rem/1.4 ui-monospace, monospace; color:#39424c; pointer-events:none; white-space:pre; }
.replay button, .replay select { font:inherit; padding:.15rem .6rem; }
)";

constexpr const char* kControls = R"(<div class="said"></div><canvas></canvas><div class="bar">
<button type="button" class="play" aria-label="play or pause">Pause</button>
<input type="range" class="time" min="0" max="1" step="any" value="0" aria-label="time">
<select class="speed" aria-label="speed"><option value="0.1">0.1x</option><option value="0.25">0.25x</option><option value="0.5">0.5x</option><option value="1" selected>1x</option><option value="2">2x</option></select>
<label><input type="checkbox" class="marks" checked> CoM, ZMP, forces, steps</label>
<label><input type="checkbox" class="follow" checked> follow</label></div>
)";

constexpr const char* kThreeJs =
    "/usr/share/javascript/three/three.min.js";  // Debian's libjs-three

std::vector<scene::Snapshot> frames_of(const scene::TracePlayer& player) {
  const double period_s = player.trace().period_s();
  const auto wanted = static_cast<std::size_t>(std::max(1.0, std::round(kFrame_s / period_s)));
  const std::size_t every = std::max(wanted, player.size() / kMostFrames + 1);
  std::vector<scene::Snapshot> frames;
  for (std::size_t i = 0; i < player.size(); i += every) frames.push_back(player.at(i));
  return frames;
}

}  // namespace

Replay replay_of(const std::filesystem::path& trace, const model::Entity* robot) {
  const std::string three = files::read(kThreeJs).value_or("");
  if (three.empty()) {
    return {"",
            "no 3D replay in the page: three.js is not installed (apt-get install libjs-three)"};
  }
  const scene::TracePlayer player(trace, robot);
  scene::Scene scene = scene::surroundings(player.world());
  scene::add_robot(scene, player.entity(), scene::Meshes::kNone);
  std::string html =
      fmt::format("<section class=\"replay\" id=\"replay\"><style>{}</style>\n", kStyle);
  html += kControls;
  html += "<script>" + three + "</script>\n<script type=\"application/json\" class=\"run\">";
  html += scene_json(scene, frames_of(player), player.world() != nullptr);
  html += "</script>\n<script>";
  html += kViewerScript;
  html += "</script></section>\n";
  return {html, player.note()};
}

std::string page_of(const std::string& title, const std::string& html) {
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
             "name=\"viewport\" "
             "content=\"width=device-width, initial-scale=1\"><title>{0}</title><style>body {{ "
             "margin:0; "
             "font:16px/1.5 system-ui, sans-serif; }} h1 {{ font-size:1.1rem; margin:.6rem .9rem; "
             "}} "
             ".replay canvas {{ height:calc(100vh - 6.5rem); aspect-ratio:auto; "
             "}}</style></head><body>"
             "<h1>{0}</h1>\n",
             title) +
         html + "</body></html>\n";
}

}  // namespace verp::web
