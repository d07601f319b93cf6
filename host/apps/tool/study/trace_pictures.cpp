#include "host/apps/tool/study/trace_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/png.hpp"
#include "host/os/files/whole.hpp"
#include "host/study/report/files.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

/// /camera/image/compressed at 1.24 s: camera_image_0001.240.
std::string name_of(const record::RecordedPicture& recorded) {
  constexpr std::string_view kCompressed = "/compressed";
  std::string name = recorded.topic.substr(1);
  if (name.ends_with(kCompressed)) name.resize(name.size() - kCompressed.size());
  std::replace(name.begin(), name.end(), '/', '_');
  return fmt::format("{}_{:08.3f}", name, 1e-9 * static_cast<double>(recorded.time_ns));
}

std::string pgm(const record::ros::Picture& picture) {
  std::string out = fmt::format("P5\n{} {}\n65535\n", picture.width, picture.height);
  for (std::size_t i = 0; i + 1 < picture.data.size(); i += 2) {
    out += picture.data[i + 1];
    out += picture.data[i];
  }
  return out;
}

std::pair<std::string, std::string> as_file(const record::ros::Picture& picture) {
  if (picture.encoding == "png") return {".png", picture.data};
  if (picture.encoding == "jpeg") return {".jpg", picture.data};
  if (picture.encoding != "rgb8") return {".pgm", pgm(picture)};
  const auto* rgb = reinterpret_cast<const std::uint8_t*>(picture.data.data());
  return {".png", png_of_rgb(picture.width, picture.height, {rgb, picture.data.size()})};
}

void write_file(const fs::path& file, const std::string& bytes) {
  const files::Trouble trouble = files::replace(file, bytes);
  if (trouble.any()) throw cli::ToolError(cli::kRunFailed, file.string() + ": " + trouble.text());
}

}  // namespace

int write_pictures(const std::string& trace, const std::string& folder) {
  bool has_folder = false;  // a trace without pictures leaves none
  const std::size_t count =
      record::for_each_picture(trace, [&](const record::RecordedPicture& recorded) {
        if (!std::exchange(has_folder, true)) report::make_folder(folder, "-o");
        const auto [kind, bytes] = as_file(recorded.picture);
        write_file(fs::path(folder) / (name_of(recorded) + kind), bytes);
      });
  if (count == 0) {
    throw cli::ToolError(cli::kBadInput,
                         trace +
                             ": has no pictures; `verp walk --cameras --record F.mcap` keeps "
                             "what the robot's cameras see");
  }
  cli::answer(fmt::format("{}: {} pictures\n", folder, count));
  return cli::kGood;
}

}  // namespace verp::tool
