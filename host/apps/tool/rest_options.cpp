#include <CLI/CLI.hpp>

#include "host/apps/cli/command.hpp"
#include "host/apps/tool/live_stream.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/apps/tool/walk_map.hpp"

/// The first-walk program knows these options but lacks the features.
namespace verp::tool {

void declare_live(CLI::App& app, LiveOptions& options) {
  app.add_option_function<std::uint16_t>(
         "--live",
         [&options](std::uint16_t port) {
           options.on = true;
           options.port = port;
         },
         "stream to Foxglove, Lichtblick or PlotJuggler on this PC while it happens, on this port "
         "(0: any free one)")
      ->expected(0, 1)
      ->type_name("PORT")
      ->check(CLI::Validator(
          [](std::string& text) {
            const std::string wrong = cli::whole_number_between(0, 65535)(text);
            return wrong.empty() ? "" : wrong + "; a MODEL stands before --live";
          },
          "0..65535"))
      ->default_str(std::to_string(options.port));
  app.add_flag("--live-wait", options.waits, "begin when a viewer has subscribed to something")
      ->needs("--live");
  app.add_option("--live-origin", options.origins,
                 "a web page that may watch besides those of this PC and Foxglove's, as a browser "
                 "tells it: https://HOST")
      ->needs("--live")
      ->check(CLI::Validator(
          [](std::string& text) {
            const std::size_t scheme = text.find("://");
            const bool web = text.starts_with("http://") || text.starts_with("https://");
            return web && text.size() > scheme + 3 && text.find('/', scheme + 3) == text.npos
                       ? ""
                       : text + " is no origin; give https://HOST or http://HOST:PORT, no path";
          },
          "URL"));
}

void declare_controller(CLI::App& app, std::string& folder) {
  app.add_option("--controller", folder,
                 "folder of a controller of your own (verp new controller): it is built, and "
                 "moves the joints while the robot stands or walks");
}

void declare(CLI::App& app, MapOptions& options) {
  CLI::Option* map =
      app.add_option("--map", options.kind,
                     "push: the hardest push that it walks on after, at 16 phases of its gait from "
                     "all sides; stand: that it stands after; stability: which velocities it walks "
                     "at, and what comes of them")
          ->check(CLI::IsMember({"push", "stand", "stability"}));
  app.add_option("--map-grid", options.grid,
                 "how fine a map is: directions of pushes (8), or velocities on each axis (9)")
      ->check(cli::whole_number_between(1, kMostOnMapAxis))
      ->needs(map);
  for (const char* other :
       {"--seeds", "--sweep-step", "--record", "--record-state", "--on", "--push", "--stand",
        "--get-up", "--start", "--cameras", "--real-time"}) {
    map->excludes(other);
  }
}

}  // namespace verp::tool
