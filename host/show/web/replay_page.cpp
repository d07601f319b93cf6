#include "host/show/web/replay_page.hpp"

#include <fmt/format.h>

#include <vector>

#include "host/os/files/whole.hpp"
#include "host/show/scene/build.hpp"
#include "host/show/scene/from_trace.hpp"
#include "host/show/web/scene_json.hpp"
#include "host/show/web/viewer.hpp"

namespace verp::web {
namespace {

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

Replay replay_of(const std::filesystem::path& trace) {
  const std::string three = files::read(kThreeJs).value_or("");
  if (three.empty()) {
    return {"",
            "no 3D replay in the page: three.js is not installed (apt-get install libjs-three)"};
  }
  const scene::TracePlayer player(trace);
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
