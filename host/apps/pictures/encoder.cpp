#include "host/apps/pictures/encoder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "host/apps/cli/exit_status.hpp"

namespace verp::pictures {
namespace {

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

}  // namespace

Encoder::Encoder(const std::string& file, render::Size size, int frames_per_s)
    : file_(file), part_(file + ".part") {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "pipe");
  pipe_ = ends[1];
  process::Command command{.words = words(file, part_, size, frames_per_s),
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
  std::error_code error;
  fs::remove(part_, error);
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
  std::error_code error;
  if (ffmpeg_->wait() != 0) fail();
  fs::rename(part_, file_, error);
  if (error) {
    throw ToolError(cli::kBadInput, fmt::format("{}: cannot be written ({}); choose another place "
                                                "with -o",
                                                file_, error.message()));
  }
}

void Encoder::fail() {
  ffmpeg_->wait();
  std::string line, last;
  for (std::ifstream said(folder_.path() / "said"); std::getline(said, line);) {
    if (!line.empty()) last = line;
  }
  std::error_code error;
  fs::remove(part_, error);
  throw ToolError(cli::kRunFailed, fmt::format("{}: ffmpeg failed: {}", file_,
                                               last.empty() ? "it says nothing" : last));
}

}  // namespace verp::pictures
