#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/pictures/commands.hpp"
#include "host/apps/pictures/film.hpp"
#include "host/apps/pictures/picture_options.hpp"
#include "host/apps/pictures/studio.hpp"
#include "host/show/render/files.hpp"
#include "host/show/scene/build.hpp"
#include "host/show/scene/trails.hpp"

namespace verp::pictures {
namespace {

using cli::kBadInput;
using cli::kRunFailed;
using cli::ToolError;

constexpr const char* kShot = "verp shot";

struct ShotOptions {
  tool::WalkOptions walk;
  PictureOptions picture;
  std::optional<double> at_s;
  bool depth = false, segmentation = false, states = false, json = false;
};

scene::Snapshot instant(const ShotOptions& options, Film& film, cli::Progress& progress) {
  scene::Snapshot found;
  if (!options.at_s && !is_trace(options.walk)) return film.start();
  const double at_s = options.at_s.value_or(film.end_s() / 2);
  bool shown = false;
  double last_s = 0;
  scene::Trails trails;
  film.play(options.picture.marks ? 0 : at_s, 0, [&](scene::Snapshot&& now) {
    progress.show(now.t_s / std::max(at_s, 1e-3), fmt::format("{:.1f} of {:g} s", now.t_s, at_s));
    trails.follow(now, film.entity());
    last_s = now.t_s;
    shown = now.t_s >= at_s - 1e-6;
    found = std::move(now);
    return !shown;
  });
  progress.clear();
  if (cli::interrupted()) throw ToolError(kRunFailed, "verp shot: interrupted; no picture");
  const bool last = is_trace(options.walk) && at_s <= film.end_s() && !found.robots.empty();
  if (shown || last) return found;
  throw ToolError(kBadInput, fmt::format("{}: --at {:g}: the run is over before; give less, or a "
                                         "longer walk with --for",
                                         kShot, at_s));
}

/// One snapshot per state of a cycle in mid-walk.
std::vector<scene::Snapshot> cycle(Film& film, cli::Progress& progress) {
  constexpr std::uint8_t kTransition = 2;
  std::vector<scene::Snapshot> states;
  int cycles = 0, last = -1;
  film.play(0, 0, [&](scene::Snapshot&& now) {
    progress.show(now.t_s / film.end_s(), fmt::format("{:.1f} s", now.t_s));
    const scene::RobotView& robot = now.robots.front();
    if (robot.phase != kTransition) {
      states.clear();
      return true;
    }
    if (robot.gait_state == last) return true;
    if (robot.gait_state < last) ++cycles;
    last = robot.gait_state;
    if (cycles >= 3 && robot.gait_state == states.size()) states.push_back(std::move(now));
    return states.size() < 16;
  });
  progress.clear();
  if (states.size() == 16) return states;
  throw ToolError(kRunFailed, fmt::format("{}: --states: there is no whole cycle of a walk here; "
                                          "give a longer one with --for",
                                          kShot));
}

cli::Json label_list(const scene::Scene& scene, const render::Measured& measured) {
  cli::Json list = cli::Json::array();
  std::vector<std::size_t> pixels(65536, 0);
  for (const std::uint16_t label : measured.label) ++pixels[label];
  for (std::size_t label = 1; label < pixels.size(); ++label) {
    if (pixels[label] == 0) continue;
    list.push_back({{"label", label},
                    {"name", scene::label_name(scene, static_cast<int>(label))},
                    {"rgb", colour_of(static_cast<int>(label))},
                    {"pixels", pixels[label]}});
  }
  return list;
}

void write_shot(const ShotOptions& options, const Film& film, const scene::Snapshot& now,
                Studio& studio, cli::Json& json) {
  const render::Size size = size_of(kShot, options.picture);
  const scene::Camera camera = camera_of(kShot, options.picture, film.scene(), now, size);
  const render::Effects effects = effects_of(options.picture);
  json["t_s"] = now.t_s;
  json["tick"] = now.tick;
  if (!options.depth && !options.segmentation) {
    return render::write_png(options.picture.file,
                             studio.renderer().image(now, camera, size, effects));
  }
  const render::Measured measured = studio.renderer().measure(now, camera, size, effects);
  if (options.depth) return render::write_depth_png(options.picture.file, measured);
  json["labels"] = label_list(film.scene(), measured);
  render::write_png(options.picture.file, coloured(measured));
}

int run_shot(const ShotOptions& options) {
  size_of(kShot, options.picture);
  require_place(kShot, options.picture.file, {".png"});
  const std::unique_ptr<Film> film = open_film(options.walk);
  Studio studio(*film);
  cli::Progress progress(!options.json);
  cli::Json json = {{"picture", options.picture.file}, {"camera", options.picture.camera}};
  if (options.states) {
    const std::vector<scene::Snapshot> states = cycle(*film, progress);
    const auto camera = [&](const scene::Snapshot& now, render::Size size) {
      return camera_of(kShot, options.picture, film->scene(), now, size);
    };
    render::write_png(options.picture.file,
                      studio.filmstrip(states, size_of(kShot, options.picture), camera,
                                       effects_of(options.picture)));
    json["states"] = states.size();
  } else {
    write_shot(options, *film, instant(options, *film, progress), studio, json);
  }
  cli::print_answer(options.json, json, options.picture.file + "\n");
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_shot(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "shot", "A picture of a robot, of a moment of its walk in the twin, or of a trace");
  auto options = std::make_shared<ShotOptions>();
  options->walk.command = kShot;
  declare_film(*app, options->walk);
  declare_picture(*app, options->picture, "the picture (.png)");
  app->add_option("--at", options->at_s,
                  "time in the run, s; without: a robot stands, of a trace its middle")
      ->check(cli::number_between(0, 86400, "s"));
  auto* depth = app->add_flag("--depth", options->depth, "distances: 16 bit grey, 1 mm a step");
  auto* parts = app->add_flag("--segmentation", options->segmentation,
                              "a colour for each link; --json names them");
  auto* states =
      app->add_flag("--states", options->states, "the 16 states of a cycle as a filmstrip");
  depth->excludes(parts)->excludes(states);
  parts->excludes(states);
  cli::add_json_flag(*app, options->json);
  return {app, [app, options] {
            cli::catch_interrupts();
            refuse_walk_of_trace(*app, options->walk);
            return run_shot(*options);
          }};
}

}  // namespace verp::pictures
