#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/pictures/commands.hpp"
#include "host/apps/pictures/film.hpp"
#include "host/apps/pictures/picture_options.hpp"
#include "host/apps/pictures/studio.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/process/child.hpp"
#include "host/show/render/renderer.hpp"
#include "host/show/scene/camera.hpp"
#include "host/show/scene/trails.hpp"

namespace verp::pictures {
namespace {

/// Follows the robot without its sway.
class SteadyCamera {
 public:
  scene::Camera follow(scene::Camera wanted) {
    constexpr double kShare = 0.06;  // of the way, per picture
    if (last_) {
      wanted.eye_m = last_->eye_m + kShare * (wanted.eye_m - last_->eye_m);
      wanted.target_m = last_->target_m + kShare * (wanted.target_m - last_->target_m);
    }
    last_ = wanted;
    return wanted;
  }

 private:
  std::optional<scene::Camera> last_;
};

/// Sends pictures to an ffmpeg process. The file appears when it is complete.
class Encoder {
 public:
  /// .mp4, .gif or .webp. Throws ToolError without ffmpeg.
  Encoder(const std::string& file, render::Size size, int frames_per_s);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// Throws ToolError with ffmpeg's last line if it has ended.
  void add(const render::Image& image);
  void finish();

 private:
  [[noreturn]] void fail();

  const std::string file_;
  files::NewFile made_;
  files::TemporaryDirectory folder_;
  int pipe_ = -1;
  std::unique_ptr<process::Child> ffmpeg_;
};

namespace fs = std::filesystem;
using cli::ToolError;

std::vector<std::string> words(const std::string& file, const std::string& part, render::Size size,
                               int frames_per_s) {
  std::vector<std::string> all = {"ffmpeg",
                                  "-nostdin",
                                  "-loglevel",
                                  "error",
                                  "-y",
                                  "-f",
                                  "rawvideo",
                                  "-pix_fmt",
                                  "rgb24",
                                  "-s",
                                  fmt::format("{}x{}", size.width, size.height),
                                  "-r",
                                  std::to_string(frames_per_s),
                                  "-i",
                                  "-",
                                  "-threads",
                                  "2"};
  const auto add = [&](std::initializer_list<const char*> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  if (file.ends_with(".gif")) {
    add({"-filter_complex",
         "split[a][b];[a]palettegen=max_colors=96:stats_mode=diff[p];"
         "[b][p]paletteuse=dither=bayer:bayer_scale=5:diff_mode=rectangle",
         "-loop", "0", "-f", "gif"});
  } else if (file.ends_with(".webp")) {
    add({"-c:v", "libwebp_anim", "-q:v", "72", "-compression_level", "5", "-loop", "0", "-f",
         "webp"});
  } else {
    add({"-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-movflags", "+faststart", "-f",
         "mp4"});
  }
  all.push_back(part);
  return all;
}

Encoder::Encoder(const std::string& file, render::Size size, int frames_per_s)
    : file_(file), made_(file) {
  if (made_.trouble().any())
    throw ToolError(cli::kBadInput, file + ": " + made_.trouble().text() + " with -o");
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "pipe");
  pipe_ = ends[1];
  process::Command command{.words = words(file, made_.part().string(), size, frames_per_s),
                           .input = {.descriptor = ends[0]},
                           .output = {.file = folder_.path() / "said"}};
  try {
    ffmpeg_ = std::make_unique<process::Child>(command);
  } catch (const std::system_error& error) {
    ::close(ends[0]);
    ::close(pipe_);
    throw ToolError(cli::kNoDevice, fmt::format("no videos without ffmpeg ({}): apt-get install "
                                                "ffmpeg",
                                                error.code().message()));
  }
  ::close(ends[0]);
}

Encoder::~Encoder() {
  if (pipe_ < 0) return;
  ::close(pipe_);
  ffmpeg_.reset();
}

void Encoder::add(const render::Image& image) {
  const auto* from = reinterpret_cast<const char*>(image.rgb.data());
  std::size_t left = image.rgb.size();
  while (left > 0) {
    const ssize_t written = ::write(pipe_, from, left);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    from += written;
    left -= static_cast<std::size_t>(written);
  }
}

void Encoder::finish() {
  ::close(pipe_);
  pipe_ = -1;
  if (ffmpeg_->wait() != 0) fail();
  const files::Trouble trouble = made_.keep();
  if (trouble.any()) throw ToolError(cli::kBadInput, file_ + ": " + trouble.text() + " with -o");
}

void Encoder::fail() {
  ffmpeg_->wait();
  std::string line, last;
  for (std::ifstream said(folder_.path() / "said"); std::getline(said, line);) {
    if (!line.empty()) last = line;
  }
  throw ToolError(cli::kRunFailed, fmt::format("{}: ffmpeg failed: {}", file_,
                                               last.empty() ? "it says nothing" : last));
}

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
