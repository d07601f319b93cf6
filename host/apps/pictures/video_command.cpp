#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/pictures/commands.hpp"
#include "host/apps/pictures/encoder.hpp"
#include "host/apps/pictures/film.hpp"
#include "host/apps/pictures/picture_options.hpp"
#include "host/apps/pictures/steady_camera.hpp"
#include "host/apps/pictures/studio.hpp"
#include "host/show/scene/trails.hpp"

namespace verp::pictures {
namespace {

using cli::kRunFailed;
using cli::ToolError;

constexpr const char* kVideo = "verp video";

struct VideoOptions {
  tool::WalkOptions walk;
  PictureOptions picture;
  double from_s = 0;
  std::optional<double> to_s;
  int frames_per_s = 25;
  double speed = 1;
};

int run_video(const VideoOptions& options) {
  const std::string& file = options.picture.file;
  const render::Size size = size_of(kVideo, options.picture);
  require_place(kVideo, file, {".mp4", ".gif", ".webp"});
  if (file.ends_with(".mp4") && (size.width % 2 != 0 || size.height % 2 != 0)) {
    throw ToolError(cli::kBadInput, fmt::format("{}: --size {}: MP4 has even sizes only", kVideo,
                                                options.picture.size_text));
  }
  const std::unique_ptr<Film> film = open_film(options.walk);
  Studio studio(*film);
  Encoder encoder(file, size, options.frames_per_s);
  cli::Progress progress(true);
  SteadyCamera steady;
  scene::Trails trails;
  int frames = 0;
  const double end_s = options.to_s.value_or(film->end_s());
  film->play(options.from_s, options.speed / options.frames_per_s, [&](scene::Snapshot&& now) {
    if (now.t_s > end_s) return false;
    trails.follow(now, film->entity());
    const scene::Camera camera =
        steady.follow(camera_of(kVideo, options.picture, film->scene(), now, size));
    encoder.add(studio.renderer().image(now, camera, size, effects_of(options.picture)));
    ++frames;
    progress.show((now.t_s - options.from_s) / std::max(end_s - options.from_s, 1e-3),
                  fmt::format("{}  {:.1f} s", file, now.t_s));
    return true;
  });
  progress.clear();
  if (cli::interrupted()) throw ToolError(kRunFailed, "verp video: interrupted; no video");
  if (frames == 0) {
    throw ToolError(cli::kBadInput,
                    fmt::format("{}: --from {:g}: the run is over before", kVideo, options.from_s));
  }
  encoder.finish();
  cli::answer(fmt::format("{}: {} pictures\n", file, frames));
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_video(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("video", "A video of a walk in the twin, or of a trace (MP4, GIF, WebP)");
  auto options = std::make_shared<VideoOptions>();
  options->walk.command = kVideo;
  options->walk.walk_s = 6;
  declare_film(*app, options->walk);
  declare_picture(*app, options->picture, "the video (.mp4, .gif or .webp)");
  app->add_option("--from", options->from_s, "where in the run it begins, s")
      ->check(cli::number_between(0, 86400, "s"))
      ->capture_default_str();
  app->add_option("--to", options->to_s, "where it ends, s; without: with the run")
      ->check(cli::number_between(0, 86400, "s"));
  app->add_option("--fps", options->frames_per_s, "pictures a second")
      ->check(cli::whole_number_between(1, 120))
      ->capture_default_str();
  app->add_option("--speed", options->speed, "2: twice as fast as it was")
      ->check(cli::number_between(0.01, 100, ""))
      ->capture_default_str();
  return {app, [app, options] {
            cli::catch_interrupts();
            refuse_walk_of_trace(*app, options->walk);
            if (options->to_s && *options->to_s <= options->from_s) {
              throw cli::ToolError(cli::kBadInput,
                                   fmt::format("{}: --to {:g}: it begins at --from {:g}; give "
                                               "more than that",
                                               kVideo, *options->to_s, options->from_s));
            }
            return run_video(*options);
          }};
}

}  // namespace verp::pictures
