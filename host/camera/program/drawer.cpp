#include "host/camera/program/drawer.hpp"

#include <algorithm>
#include <cmath>

#include "host/model/load.hpp"
#include "host/model/load_world.hpp"
#include "host/render/files.hpp"
#include "host/scene/build.hpp"

namespace verp::camera {
namespace {

/// As a camera has it: no marks; and no shadows, which cost more than all the rest of a picture
/// of 320x240 where the PC's processor draws (7 of 11 ms), 30 times a second.
render::Effects effects() {
  render::Effects effects;
  effects.quick = true;
  effects.shadows = false;
  return effects;
}

/// Noise in parts of white, onto 8 bits: what a sensor's chip does last. A sum of four uniform
/// numbers, which one draw of 64 bits has, is as good as a bell here: 230,000 are drawn a picture.
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

/// 16UC1: millimetres, 0 where nothing is between the camera's planes.
std::string depth_mm(const model::CameraSensor& camera, sim::Random& random,
                     const std::vector<float>& depth_m) {
  std::vector<std::uint16_t> out;
  out.reserve(depth_m.size());
  const bool noisy = camera.noise_stddev != 0 || camera.noise_mean != 0;
  for (const float depth : depth_m) {
    const auto true_m = static_cast<double>(depth);
    // Drawn whether there is something or not: what one pixel sees changes no other.
    const double noise_m = noisy ? camera.noise_mean + camera.noise_stddev * random.normal() : 0;
    const double mm = 1000 * (true_m + noise_m);
    const bool there = true_m >= camera.near_m && true_m <= camera.far_m && mm >= 0.5;
    out.push_back(there && mm < 65535.5 ? static_cast<std::uint16_t>(std::lround(mm))
                                        : std::uint16_t{0});
  }
  return bytes_of(out);
}

/// Its own lens, which the scene shows, is behind the point from which it sees.
void drop_lenses(const std::vector<model::CameraSensor>& cameras, scene::Scene& scene) {
  std::erase_if(scene.items, [&](const scene::Item& item) {
    return item.robot == 0 &&
           std::any_of(cameras.begin(), cameras.end(), [&](const model::CameraSensor& camera) {
             return item.name == camera.name + " rim" || item.name == camera.name + " glass";
           });
  });
}

scene::Scene scene_of(const Stage& stage, std::vector<model::CameraSensor>& cameras) {
  std::optional<model::World> world;
  if (!stage.world_file.empty()) world = model::load_world(stage.world_file);
  scene::Scene scene = scene::surroundings(world ? &*world : nullptr);
  for (const std::string& file : stage.robot_files) {
    const model::Entity entity = model::load_robot_on_any_bus(file, "");
    if (scene.robots.empty()) cameras = entity.cameras;
    scene::add_robot(scene, entity);
  }
  drop_lenses(cameras, scene);
  return scene;
}

}  // namespace

Drawer::Drawer(const Stage& stage) : seed_(stage.seed), scene_(scene_of(stage, cameras_)) {
  for (const model::CameraSensor& camera : cameras_) views_.emplace_back(camera);
  renderer_.set_scene(scene_);
}

std::vector<Picture> Drawer::draw(const Moment& moment, std::uint32_t camera) {
  scene::Snapshot now;
  now.t_s = static_cast<double>(moment.time_us) * 1e-6;
  for (const auto& links : moment.link_world) now.robots.emplace_back().link_world = links;
  now.body_world = moment.body_world;
  const model::CameraSensor& sensor = cameras_.at(camera);
  const scene::Camera from = views_[camera].camera(
      now.robots.front().link_world.at(static_cast<std::size_t>(sensor.node)));
  constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15ULL;
  sim::Random random(seed_ + kSpread * moment.time_us, sim::Draw::kCamera,
                     static_cast<int>(camera));
  std::vector<Picture> out;
  if (sensor.has_colour()) out.push_back(colour(now, from, camera, random));
  if (sensor.kind != model::CameraSensor::Kind::kColour)
    add_measured(now, from, camera, random, out);
  for (Picture& picture : out) {
    picture.camera = camera;
    picture.time_us = moment.time_us;
    picture.width = static_cast<std::uint32_t>(sensor.width_px);
    picture.height = static_cast<std::uint32_t>(sensor.height_px);
  }
  return out;
}

Picture Drawer::colour(const scene::Snapshot& now, const scene::Camera& from, std::uint32_t camera,
                       sim::Random& random) {
  const View& view = views_[camera];
  render::Image image = view.seen(renderer_.image(now, from, view.drawn(), effects()));
  add_noise(cameras_[camera], random, image);
  Picture picture;
  picture.encoding = "png";
  picture.data = render::png_of(image);
  return picture;
}

void Drawer::add_measured(const scene::Snapshot& now, const scene::Camera& from,
                          std::uint32_t camera, sim::Random& random, std::vector<Picture>& out) {
  const View& view = views_[camera];
  const render::Measured measured =
      view.seen(renderer_.measure(now, from, view.drawn(), effects()));
  Picture& picture = out.emplace_back();
  if (cameras_[camera].has_depth()) {
    picture.encoding = "16UC1";
    picture.data = depth_mm(cameras_[camera], random, measured.depth_m);
  } else {
    picture.encoding = "mono16";
    picture.data = bytes_of(measured.label);
  }
}

}  // namespace verp::camera
