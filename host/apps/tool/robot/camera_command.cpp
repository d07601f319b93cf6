#include <CLI/CLI.hpp>
#include <memory>

#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/robot/camera_run.hpp"
#include "host/apps/tool/robot/setup_command.hpp"

namespace verp::tool {

cli::Subcommand add_bus_camera(CLI::App& bus) {
  CLI::App* app = bus.add_subcommand("camera", "what a camera of this PC sees (Linux, V4L2)");
  auto words = std::make_shared<CameraWords>();
  app->add_option("--device", words->device, "the camera")->capture_default_str();
  app->add_flag("--list", words->list, "what it can give, and no more");
  app->add_option("-o,--output", words->picture, "keep one picture (.png; .jpg of MJPG)");
  app->add_option("--record", words->record, "keep all pictures in this trace (.mcap)");
  app->add_flag("--compress", words->compress, "the trace's chunks by zstd");
  app->add_option("--size", words->size, "WIDTHxHEIGHT in pixels, else as it is");
  app->add_option("--format", words->format, "of its pictures; else the first that it has")
      ->check(CLI::IsMember({"YUYV", "RGB3", "GREY", "MJPG"}));
  app->add_option("--rate", words->rate_hz, "pictures a second, else as it is")
      ->transform(cli::number_between(0.1, 1000, "Hz"));
  app->add_option("--for", words->seconds, "how long, s")
      ->transform(cli::number_between(0.1, 3600, "s"))
      ->capture_default_str();
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            cli::catch_interrupts();
            return run_camera(*words);
          }};
}

}  // namespace verp::tool
