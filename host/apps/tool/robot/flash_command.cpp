#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/flash_run.hpp"
#include "host/boards/flash/images.hpp"
#include "host/boards/flash/recipe.hpp"
#include "host/os/files/temporary_directory.hpp"

namespace verp::tool {
namespace {

struct FlashWords {
  FlashOptions flash;
  std::string controller;  ///< empty: the core's
  std::string image;
  bool code = false, json = false;
};

/// Builds the image that this robot takes, and no other: a controller may fit into one only. The
/// folder of the image.
std::string build_with_controller(const FlashWords& words, cli::Progress& progress) {
  if (!words.flash.sensor.empty()) {
    throw cli::ToolError(cli::kBadInput, "verp flash: --image " + words.flash.sensor +
                                             " runs no controller; leave out --controller");
  }
  const flash::Recipe& recipe = flash::find_recipe(words.flash.board);
  const files::TemporaryDirectory folder;
  const std::string image = flash::loop_image(recipe, bus_of(words.flash, recipe, folder.path()));
  return build_firmware_of(words.controller, words.flash.board, image, progress);
}

int run_flash(FlashWords words) {
  const bool data = !words.flash.params.empty() || !words.flash.actions.empty();
  if (words.image != "loop") words.flash.sensor = words.image;
  words.flash.code = words.code || !data || !words.controller.empty();
  cli::Progress progress(!words.json);
  if (!words.controller.empty()) {
    setenv("VERP_FIRMWARE_DIR", build_with_controller(words, progress).c_str(), 1);
  }
  const FlashAnswer result = flash_board(words.flash, progress, [&](const std::string& text) {
    if (words.json) {
      cli::complain(text);
    } else {
      cli::answer(text);
      std::fflush(stdout);
    }
  });
  cli::print_answer(words.json, result.json, result.text);
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_flash(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "flash");
  auto words = std::make_shared<FlashWords>();
  declare_target(*app, words->flash);
  app->add_option("--params", words->flash.params,
                  "write this robot instead of the firmware: a Params image (FILE.bin, see verp "
                  "export), or, with its actions, a robot of common/robots or an SDF file");
  app->add_option("--bus", words->flash.bus,
                  "name of the robot's bus to use (default: its first), which decides which "
                  "firmware: for serial servos, or for drives on CAN; without --params it is a bus "
                  "of generic21");
  app->add_option("--actions", words->flash.actions,
                  "write these: a FILE.bin of verp action export, or what a run that failed has "
                  "kept (it names the file). A robot that --params makes brings its own; none "
                  "leaves those on the board as they are");
  app->add_option(
         "--image", words->image,
         "loop: the controller (default); sensor, foot: the robot's IMU or foot as a device on "
         "its servo bus, with id, rate and scales of the robot of --params")
      ->check(CLI::IsMember({"loop", "sensor", "foot"}));
  app->add_flag("--code", words->code, "with --params or --actions: the firmware as well");
  declare_controller(*app, words->controller);
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            cli::catch_interrupts();
            return run_flash(*words);
          }};
}

}  // namespace verp::tool
