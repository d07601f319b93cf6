#include "host/show/camera/program/drawer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "host/robot/model/load.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/show/render/edges.hpp"
#include "host/show/render/files.hpp"
#include "host/show/scene/build.hpp"
#include "host/show/scene/camera.hpp"

namespace verp::camera {
namespace {

/// No marks. No shadows or multisampling: they cost most of a picture on the processor; edges are
/// smoothed afterwards.
render::Effects effects() {
  render::Effects effects;
  effects.quick = true;
  effects.shadows = false;
  effects.antialias = false;
  return effects;
}

/// Noise on the 8-bit values, fraction of white. Four uniform numbers of one draw are normal
/// enough: a picture needs 230,000.
void add_noise(const model::CameraSensor& camera, sim::Random& random, render::Image& image) {
  if (camera.noise_stddev == 0 && camera.noise_mean == 0) return;
  constexpr float kMean = 4 * 0.5F * 65535, kStddev = 37836.6F;  // 65536 * sqrt(4 / 12)
  const float mean = 255 * static_cast<float>(camera.noise_mean);
  const float stddev = 255 * static_cast<float>(camera.noise_stddev) / kStddev;
  for (std::uint8_t& value : image.rgb) {
    const std::uint64_t bits = random.bits();
    const std::uint64_t sum =
        (bits & 0xFFFF) + ((bits >> 16) & 0xFFFF) + ((bits >> 32) & 0xFFFF) + (bits >> 48);
    const float noisy =
        static_cast<float>(value) + mean + stddev * (static_cast<float>(sum) - kMean);
    value = static_cast<std::uint8_t>(std::clamp(noisy, 0.0F, 255.0F) + 0.5F);
  }
}

std::string bytes_of(const std::vector<std::uint16_t>& values) {
  return {reinterpret_cast<const char*>(values.data()), 2 * values.size()};
}

/// 16UC1: mm; 0: nothing between the planes.
std::string depth_mm(const model::CameraSensor& camera, sim::Random& random,
                     const std::vector<float>& depth_m) {
  std::vector<std::uint16_t> out;
  out.reserve(depth_m.size());
  const bool noisy = camera.noise_stddev != 0 || camera.noise_mean != 0;
  for (const float depth : depth_m) {
    const auto true_m = static_cast<double>(depth);
    // Pixels must not change each other's noise: always draw.
    const double noise_m = noisy ? camera.noise_mean + camera.noise_stddev * random.normal() : 0;
    const double mm = 1000 * (true_m + noise_m);
    const bool there = true_m >= camera.near_m && true_m <= camera.far_m && mm >= 0.5;
    out.push_back(there && mm < 65535.5 ? static_cast<std::uint16_t>(std::lround(mm))
                                        : std::uint16_t{0});
  }
  return bytes_of(out);
}

/// Lenses are drawn around the cameras' eyes and would hide the view.
scene::Scene without_lenses(scene::Scene scene, int robot,
                            const std::vector<model::CameraSensor>& cameras) {
  std::erase_if(scene.items, [&](const scene::Item& item) {
    return item.robot == robot &&
           std::any_of(cameras.begin(), cameras.end(), [&](const model::CameraSensor& camera) {
             return item.name == camera.name + " rim" || item.name == camera.name + " glass";
           });
  });
  return scene;
}

scene::Scene empty_scene(const std::string& world_file) {
  if (world_file.empty()) return scene::surroundings(nullptr);
  const model::World world = model::load_world(world_file);
  return scene::surroundings(&world);
}

scene::Camera standing_at(const Outside& from) {
  scene::Camera camera;
  const model::Vec3 way = from.target_m - from.eye_m;
  const double distance_m = way.norm();
  if (!(distance_m > 0) || !std::isfinite(distance_m))
    throw std::invalid_argument("the eye is where it looks at");
  camera.eye_m = from.eye_m;
  camera.target_m = from.target_m;
  // When it looks straight up or down, x is up in the picture.
  constexpr double kSteep = 0.9999;
  if (std::abs(way.z()) > kSteep * distance_m) camera.up = model::Vec3::UnitX();
  camera.vertical_fov_rad = from.vertical_fov_rad;
  camera.near_m = std::max(0.005, distance_m / 100);
  camera.far_m = distance_m + 80;
  return camera;
}

}  // namespace

Drawer::Drawer(const Stage& stage) : scene_(empty_scene(stage.world_file)) {
  for (const Stage::Robot& robot : stage.robots) add_robot(robot);
}

void Drawer::add_robot(const Stage::Robot& robot) {
  const model::Entity entity = model::load_robot_on_any_bus(robot.file, "");
  scene::add_robot(scene_, entity);
  Eyes& eyes = eyes_.emplace_back();
  eyes.seed = robot.seed;
  eyes.cameras = entity.cameras;
  for (const model::CameraSensor& camera : eyes.cameras) eyes.views.emplace_back(camera);
}

render::Renderer& Drawer::renderer_of(int robot) {
  const auto [place, is_new] = renderers_.try_emplace(robot);
  if (is_new) {
    place->second.set_scene(
        robot == scene::kWorld
            ? scene_
            : without_lenses(scene_, robot, eyes_.at(static_cast<std::size_t>(robot)).cameras));
  }
  return place->second;
}

std::vector<std::string> Drawer::label_names() const {
  std::vector<std::string> names;
  for (const scene::Item& item : scene_.items) {
    const auto label = static_cast<std::size_t>(scene::label_of(scene_, item));
    if (label == 0) continue;
    names.resize(std::max(names.size(), label));
    std::string& name = names[label - 1];
    if (name.empty()) name = scene::label_name(scene_, static_cast<int>(label));
  }
  return names;
}

scene::Snapshot Drawer::shown(const Moment& moment) const {
  scene::Snapshot now;
  now.t_s = static_cast<double>(moment.time_us) * 1e-6;
  for (std::size_t i = 0; i < moment.link_world.size(); ++i) {
    if (i < scene_.robots.size() &&
        moment.link_world[i].size() == scene_.robots[i].entity->nodes.size())
      now.robots.emplace_back().link_world = moment.link_world[i];
  }
  if (now.robots.size() != scene_.robots.size() || moment.robot >= now.robots.size())
    throw std::invalid_argument("that moment is of other robots");
  now.body_world = moment.body_world;
  return now;
}

std::vector<Picture> Drawer::draw(const Moment& moment, std::uint32_t camera) {
  const scene::Snapshot now = shown(moment);
  const Eyes& eyes = eyes_[moment.robot];
  const model::CameraSensor& sensor = eyes.cameras.at(camera);
  const scene::Camera from = eyes.views[camera].camera(
      now.robots[moment.robot].link_world.at(static_cast<std::size_t>(sensor.node)));
  constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15ULL;
  sim::Random random(eyes.seed + kSpread * moment.time_us, sim::Draw::kCamera,
                     static_cast<int>(camera));
  std::vector<Picture> out;
  if (sensor.has_colour()) out.push_back(colour(now, from, moment, camera, random));
  if (sensor.kind != model::CameraSensor::Kind::kColour)
    out.push_back(measured(now, from, moment, camera, random));
  for (Picture& picture : out) {
    picture.camera = camera;
    picture.time_us = moment.time_us;
    picture.width = static_cast<std::uint32_t>(sensor.width_px);
    picture.height = static_cast<std::uint32_t>(sensor.height_px);
  }
  return out;
}

Picture Drawer::draw(const Moment& moment, const Outside& from) {
  const scene::Snapshot now = shown(moment);
  const render::Size size{static_cast<int>(from.width), static_cast<int>(from.height)};
  const auto robot = static_cast<int>(moment.robot);
  std::optional<scene::Camera> camera;
  if (from.view.empty()) {
    camera = standing_at(from);
  } else {
    camera =
        scene::view(from.view, scene_, now, robot, static_cast<double>(size.width) / size.height);
  }
  if (!camera) {
    std::string names;
    for (const std::string& name : scene::view_names(scene_))
      names += (names.empty() ? "" : ", ") + name;
    throw std::invalid_argument("there is no view '" + from.view + "'; there are " + names);
  }
  render::Effects wanted;
  wanted.shadows = from.shadows;
  wanted.antialias = from.antialias;
  const render::Image image = renderer_of(scene::kWorld).image(now, *camera, size, wanted);
  return {.time_us = moment.time_us,
          .width = from.width,
          .height = from.height,
          .encoding = "rgb8",
          .data = {image.rgb.begin(), image.rgb.end()}};
}

Picture Drawer::colour(const scene::Snapshot& now, const scene::Camera& from, const Moment& moment,
                       std::uint32_t camera, sim::Random& random) {
  const Eyes& eyes = eyes_[moment.robot];
  const View& view = eyes.views[camera];
  render::Image drawn =
      renderer_of(static_cast<int>(moment.robot)).image(now, from, view.drawn(), effects());
  render::smooth_edges(drawn);
  render::Image image = view.seen(std::move(drawn));
  add_noise(eyes.cameras[camera], random, image);
  Picture picture;
  picture.encoding = moment.raw ? "rgb8" : "png";
  picture.data =
      moment.raw ? std::string(image.rgb.begin(), image.rgb.end()) : render::png_of(image);
  return picture;
}

Picture Drawer::measured(const scene::Snapshot& now, const scene::Camera& from,
                         const Moment& moment, std::uint32_t camera, sim::Random& random) {
  const Eyes& eyes = eyes_[moment.robot];
  const View& view = eyes.views[camera];
  const render::Measured measured = view.seen(
      renderer_of(static_cast<int>(moment.robot)).measure(now, from, view.drawn(), effects()));
  Picture picture;
  if (eyes.cameras[camera].has_depth()) {
    picture.encoding = "16UC1";
    picture.data = depth_mm(eyes.cameras[camera], random, measured.depth_m);
  } else {
    picture.encoding = "mono16";
    picture.data = bytes_of(measured.label);
    if (names_.empty()) names_ = label_names();
    picture.names = names_;
  }
  return picture;
}

}  // namespace verp::camera
