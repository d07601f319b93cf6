#include "host/apps/pictures/picture_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/suggest.hpp"

namespace verp::pictures {

using cli::kBadInput;
using cli::ToolError;

namespace {

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

void declare_picture(CLI::App& app, PictureOptions& options, const std::string& file_help) {
  app.add_option("-o,--output", options.file, file_help)->required();
  app.add_option("--camera", options.camera,
                 "three-quarter, front, side, back, top, follow, head, or one that the robot has")
      ->capture_default_str();
  app.add_option("--size", options.size_text, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app.add_flag("--marks", options.marks,
               "CoM, ZMP measured and planned, support, contact forces, footsteps, trails");
  render::Effects& e = options.effects;
  app.add_flag("--axes", e.axes, "each link's frame");
  app.add_flag("--collisions", e.collisions, "the shapes of physics, over the others");
  app.add_flag("--goals", e.goals, "where the joints' goals have the robot, as a ghost");
  const auto without = [&](const char* flag, bool& effect, const char* what) {
    app.add_flag_callback(
        flag, [&effect] { effect = false; }, what);
  };
  without("--no-shadows", e.shadows, "no shadows");
  without("--no-antialias", e.antialias, "one sample a pixel");
  without("--no-fog", e.fog, "no fog");
  without("--no-textures", e.textures, "plain colours");
  without("--no-transparency", e.transparency, "all solid");
  without("--no-ground", e.ground, "no floor");
  without("--no-grid", e.ground_grid, "a plain floor");
}

render::Size size_of(const std::string& command, const PictureOptions& options) {
  constexpr int kMost = 8192;
  int width = 0, height = 0, end = 0;
  const std::string& text = options.size_text;
  const int read = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end);
  if (read != 2 || end != static_cast<int>(text.size()) || width < 16 || height < 16 ||
      width > kMost || height > kMost) {
    throw ToolError(kBadInput, fmt::format("{}: --size {}: give WIDTHxHEIGHT, each 16 to {}",
                                           command, text, kMost));
  }
  return {width, height};
}

render::Effects effects_of(const PictureOptions& options) {
  render::Effects effects = options.effects;
  if (!options.marks) return effects;
  const render::Effects all = render::Effects::explained();
  effects.com = all.com;
  effects.zmp = all.zmp;
  effects.support = all.support;
  effects.contacts = all.contacts;
  effects.footsteps = all.footsteps;
  effects.trails = all.trails;
  effects.rays = all.rays;
  return effects;
}

scene::Camera camera_of(const std::string& command, const PictureOptions& options,
                        const scene::Scene& scene, const scene::Snapshot& now, render::Size size) {
  const auto camera = scene::view(options.camera, scene, now, 0, 1.0 * size.width / size.height);
  if (camera) return *camera;
  throw ToolError(kBadInput, fmt::format("{}: --camera {}: there is no such view; give one of: {}",
                                         command, options.camera, list_of(view_names(scene))));
}

void require_place(const std::string& command, const std::string& file,
                   const std::vector<std::string>& endings) {
  if (std::none_of(endings.begin(), endings.end(),
                   [&](const std::string& ending) { return file.ends_with(ending); })) {
    throw ToolError(kBadInput, fmt::format("{}: -o {}: give a name that ends in {}", command, file,
                                           list_of(endings)));
  }
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return;
  throw ToolError(kBadInput, fmt::format("{}: -o {}: there is no folder {}; make it first", command,
                                         file, folder.string()));
}

}  // namespace verp::pictures
