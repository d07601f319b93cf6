#include <fmt/format.h>
#include <sys/resource.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QSettings>
#include <QSurfaceFormat>
#include <QTemporaryDir>
#include <QtTest/QTest>
#include <cmath>
#include <cstring>
#include <vector>

#include "host/apps/view/main_window.hpp"
#include "host/apps/view/theme.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/robot/model/params.hpp"
#include "host/show/render/edges.hpp"
#include "host/show/render/offscreen_context.hpp"
#include "host/show/scene/camera.hpp"

// `frames`: CPU time of the renderer, and a robot camera's distance from 64 samples. `window`:
// frame rate of the real window and the twin's speed beside it. One JSON line each, for one robot
// and for four. Four also run at 2 ms: one core barely manages 1 ms.
namespace verp::view {
namespace {

constexpr render::Size kSize{640, 480};
constexpr double kApart_m = 0.5;

double cpu_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

session::WalkPlan plan_at(double left_m) {
  session::WalkPlan plan;
  plan.entity = model::load_robot(model::find_model("generic21"), "");
  plan.params = model::make_params(plan.entity);
  plan.velocity.vx_tenth_mm_s = 1000;
  plan.walk_s = 600;
  plan.twin.start_m.y() = left_m;
  return plan;
}

void bench_frames(int robots, bool antialias, int frames) {
  render::OffscreenContext context;
  render::Renderer renderer;
  scene::Scene scene = scene::studio();
  scene::Snapshot now;
  for (int i = 0; i < robots; ++i) {
    const session::WalkPlan plan = plan_at(kApart_m * i);
    scene::add_robot(scene, plan.entity);
    now.robots.push_back(scene::standing(plan.entity, plan.twin.start_m));
    now.robots.back().goal_rad = now.robots.back().joint_rad;
  }
  renderer.set_scene(scene);
  render::Effects effects = render::Effects::explained();
  effects.antialias = antialias;
  effects.quick = !antialias;
  const auto camera = scene::view("three-quarter", scene, now, 0, 4.0 / 3);
  renderer.image(now, *camera, kSize, effects);
  const double before_s = cpu_s();
  QElapsedTimer wall;
  wall.start();
  for (int i = 0; i < frames; ++i) renderer.image(now, *camera, kSize, effects);
  const double wall_s = 1e-3 * static_cast<double>(wall.elapsed());
  fmt::print(
      "{{\"what\":\"frames\",\"robots\":{},\"antialias\":{},\"cpu_ms\":{:.1f},"
      "\"frames_per_s\":{:.1f}}}\n",
      robots, antialias, 1e3 * (cpu_s() - before_s) / frames, frames / wall_s);
}

/// Mean distance of colours, of 255.
double rms_apart(const render::Image& image, const render::Image& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const double apart = double(image.rgb[i]) - truth.rgb[i];
    sum += apart * apart;
  }
  return std::sqrt(sum / double(image.rgb.size()));
}

render::Image averaged(const render::Image& large, int times) {
  render::Image out{{large.size.width / times, large.size.height / times}, {}};
  for (int y = 0; y < out.size.height; ++y) {
    for (int x = 0; x < 3 * out.size.width; ++x) {
      int sum = 0;
      for (int v = 0; v < times; ++v) {
        for (int u = 0; u < times; ++u)
          sum += large.rgb[std::size_t(
              3 * ((times * y + v) * large.size.width + times * (x / 3) + u) + x % 3)];
      }
      out.rgb.push_back(std::uint8_t((sum + times * times / 2) / (times * times)));
    }
  }
  return out;
}

/// In the furnished room: one sample per pixel, edges smoothed, and four samples.
void bench_camera() {
  constexpr int kPictures = 24, kTimes = 8;
  constexpr render::Size kCamera{320, 240};
  const session::WalkPlan plan = plan_at(0);
  const model::World room = model::load_world(model::find_world("demo"));
  scene::Scene scene = scene::surroundings(&room);
  scene::add_robot(scene, plan.entity);
  scene::Snapshot now;
  now.robots.push_back(scene::standing(plan.entity, plan.twin.start_m));
  render::OffscreenContext context;
  render::Renderer renderer;
  renderer.set_scene(scene);
  const auto eye = scene::view("head", scene, now, 0, 4.0 / 3);
  const auto turned = [&](int i) {
    scene::Camera camera = *eye;
    const auto turn = Eigen::AngleAxisd(2 * M_PI * i / kPictures, scene::Vec3::UnitZ());
    camera.target_m = camera.eye_m + turn * (camera.target_m - camera.eye_m);
    camera.up = turn * (camera.up + 0.05 * std::sin(double(i)) * scene::Vec3::UnitY());
    return camera;
  };
  render::Effects effects;
  effects.quick = true;
  effects.shadows = effects.antialias = false;
  std::vector<render::Image> truth;
  for (int i = 0; i < kPictures; ++i)
    truth.push_back(averaged(
        renderer.image(now, turned(i), {kTimes * kCamera.width, kTimes * kCamera.height}, effects),
        kTimes));
  for (const char* kind : {"one sample", "edges smoothed", "four samples"}) {
    effects.antialias = *kind == 'f';
    renderer.image(now, turned(0), kCamera, effects);
    double cost_s = 0, apart = 0;
    for (int i = 0; i < kPictures; ++i) {
      const double before_s = cpu_s();
      render::Image image = renderer.image(now, turned(i), kCamera, effects);
      if (*kind == 'e') render::smooth_edges(image);
      cost_s += cpu_s() - before_s;
      apart += rms_apart(image, truth[std::size_t(i)]);
    }
    fmt::print(
        "{{\"what\":\"camera\",\"robots\":1,\"kind\":\"{}\",\"cpu_ms\":{:.1f},\"apart\":{:.2f}}}\n",
        kind, 1e3 * cost_s / kPictures, apart / kPictures);
  }
}

void bench_window(int robots, std::uint32_t step_us, int seconds) {
  QTemporaryDir folder;
  QSettings settings(folder.filePath("view.ini"), QSettings::IniFormat);
  MainWindow window(settings, [](const std::string&) { return RunSetup{}; });
  RunSetup setup;
  setup.run.world.step_us = step_us;
  for (int i = 0; i < robots; ++i) setup.run.plans.push_back(plan_at(kApart_m * i));
  window.show();
  window.watch(std::move(setup));
  window.resize(window.size() + QSize(kSize.width, kSize.height) - window.scene().size());
  LiveRun& live = *window.player()->live();
  if (!QTest::qWaitFor([&] { return live.status().ticks > 100; }, 60000)) return;
  const std::uint64_t drawn = window.scene().drawn();
  const double simulated_s = live.status().simulated_s, before_s = cpu_s();
  QElapsedTimer wall;
  wall.start();
  QTest::qWait(1000 * seconds);
  const double wall_s = 1e-3 * static_cast<double>(wall.elapsed());
  fmt::print(
      "{{\"what\":\"window\",\"robots\":{},\"step_us\":{},\"size\":\"{}x{}\",\"frames_per_s\":{:."
      "1f},"
      "\"real_time_factor\":{:.3f},\"cores\":{:.2f}}}\n",
      robots, step_us, window.scene().width(), window.scene().height(),
      static_cast<double>(window.scene().drawn() - drawn) / wall_s,
      (live.status().simulated_s - simulated_s) / wall_s, (cpu_s() - before_s) / wall_s);
  std::fflush(stdout);
  window.close();
  window.finish();
}

int run(int argc, char** argv) {
  const bool frames = argc == 2 && std::strcmp(argv[1], "frames") == 0;
  const bool shown = argc == 2 && std::strcmp(argv[1], "window") == 0;
  if (!frames && !shown) {
    fmt::print(stderr, "usage: window_bench frames|window\n");
    return 2;
  }
  if (frames) {
    for (const int robots : {1, 4}) {
      for (const bool antialias : {false, true}) bench_frames(robots, antialias, 20);
    }
    bench_camera();
    return 0;
  }
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  QSurfaceFormat::setDefaultFormat(format);
  QApplication application(argc, argv);
  apply_theme(application, false);
  for (const auto& [robots, step_us] : {std::pair{1, 1000U}, {4, 1000U}, {4, 2000U}})
    bench_window(robots, step_us, 8);
  return 0;
}

}  // namespace
}  // namespace verp::view

int main(int argc, char** argv) {
  try {
    return verp::view::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "window_bench: {}\n", error.what());
    return 3;
  }
}
