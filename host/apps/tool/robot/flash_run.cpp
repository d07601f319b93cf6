#include "host/apps/tool/robot/flash_run.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <thread>

#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/robot/action_words.hpp"
#include "host/author/action/kept.hpp"
#include "host/boards/flash/emulation.hpp"
#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/flasher.hpp"
#include "host/boards/flash/images.hpp"
#include "host/os/files/shell_line.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/export.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

/// The robot for --bus if the command line names no robot, as in commands with a default MODEL.
constexpr const char* kUsualRobot = "generic21";

void write_piece(const fs::path& file, const void* bytes, std::size_t size) {
  const files::Trouble trouble = files::replace(file, {static_cast<const char*>(bytes), size});
  if (!trouble.any()) return;
  throw flash::FlashError(flash::FlashError::Kind::kBadFile,
                          file.string() + ": " + trouble.text() + " with VERP_FLASH_DIR");
}

/// Value of --actions that leaves the actions in the board's flash unchanged.
constexpr const char* kNoActions = "none";

struct RobotFiles {
  fs::path params;
  fs::path actions;  ///< empty: not written
};

/// Named files, or made from the robot of --params.
RobotFiles robot_files(const FlashOptions& options, const flash::MemoryMap& map,
                       const fs::path& folder) {
  const std::string& word = options.params;
  RobotFiles made;
  if (options.actions != kNoActions) made.actions = options.actions;
  if (word.empty()) return made;
  const fs::path path = word;
  const bool robot = path.extension() == ".sdf" || path.extension() == ".urdf";
  if (path.extension() == ".bin" || (!robot && fs::is_regular_file(path))) {
    if (!options.bus.empty()) {
      throw flash::FlashError(
          flash::FlashError::Kind::kUsage,
          fmt::format("--bus {}: {} is made for one bus already; leave out --bus, "
                      "or give --params the model",
                      options.bus, word));
    }
    made.params = path;
    return made;
  }
  const model::Entity entity = model::load_robot(model::find_model(word), options.bus);
  const ParamsImage image = model::make_image(entity);
  made.params = folder / "params.bin";
  write_piece(made.params, &image, sizeof image);
  if (!options.sensor.empty() || !options.actions.empty() || map.actions.bytes == 0) return made;
  const action::CompiledActions own = make_actions(entity, image.params, "");
  if (own.documents.empty()) return made;
  const std::vector<std::uint8_t> kept = action::kept_image(own, image.params);
  made.actions = folder / "actions.bin";
  write_piece(made.actions, kept.data(), kept.size());
  return made;
}

/// Checked pieces with addresses, and the image for the robot.
struct Cargo {
  std::vector<flash::Piece> pieces;
  BusProtocol protocol = BusProtocol::kDynamixel2;
  std::string image;
};

Cargo load(const FlashOptions& options, const flash::Recipe& recipe, const flash::MemoryMap& map,
           const fs::path& folder, bool code) {
  Cargo cargo;
  const RobotFiles files = robot_files(options, map, folder);
  std::optional<Params> robot;
  if (!files.params.empty()) {
    robot = flash::check_params(files.params, map);
    cargo.pieces.push_back(
        {std::string("robot ") + robot->name, fs::absolute(files.params), map.params});
    cargo.protocol = robot->bus_protocol;
  } else if (!options.bus.empty()) {
    cargo.protocol = model::load_robot(model::find_model(kUsualRobot), options.bus).protocol;
  }
  cargo.image = options.sensor.empty()
                    ? flash::loop_image(recipe, cargo.protocol)
                    : flash::sensor_image(recipe, options.sensor, robot ? &*robot : nullptr);
  if (code) {
    const fs::path file = flash::code_image(recipe, cargo.image);
    flash::check_code(file, map);
    cargo.pieces.insert(cargo.pieces.begin(),
                        {"code " + cargo.image, fs::absolute(file), map.code});
  }
  if (!files.actions.empty()) {
    const int count = flash::check_actions(files.actions, map, robot ? &*robot : nullptr);
    cargo.pieces.push_back(
        {fmt::format("{} actions", count), fs::absolute(files.actions), map.actions});
  }
  return cargo;
}

/// Only a robot or only firmware was written: what the chip must already hold.
std::string beside(const FlashOptions& options, const Cargo& cargo) {
  if (!options.params.empty() && !options.code) {
    return fmt::format("; this robot takes firmware {}, which --code writes too", cargo.image);
  }
  if (!options.code || !options.params.empty()) return "";
  if (!options.sensor.empty()) return "; its robot is the one in its flash, which --params writes";
  return cargo.protocol == BusProtocol::kCia402
             ? "; it drives a robot on CAN, with any other start_fault is 8"
             : "; it drives a robot on a serial bus, on CAN start_fault is 8";
}

cli::Json to_json(const std::vector<flash::Piece>& pieces) {
  cli::Json rows = cli::Json::array();
  for (const flash::Piece& piece : pieces) {
    rows.push_back({{"what", piece.what},
                    {"file", piece.file.string()},
                    {"address", fmt::format("{:#010x}", piece.region.begin)},
                    {"bytes", fs::file_size(piece.file)}});
  }
  return rows;
}

std::string to_text(const std::vector<flash::Piece>& pieces) {
  std::string text;
  for (const flash::Piece& piece : pieces) {
    text += fmt::format("{}{} ({} bytes at {:#010x})", text.empty() ? "" : ", ", piece.what,
                        fs::file_size(piece.file), piece.region.begin);
  }
  return text;
}

FlashAnswer flash_silicon(const FlashOptions& options, const flash::Recipe& recipe,
                          cli::Progress& progress) {
  const flash::Tool tool = flash::choose_tool(recipe, options.tool, options.port);
  const flash::Workspace workspace(options.board);
  const flash::MemoryMap map = flash::read_memory_map(options.board);
  const Cargo cargo = load(options, recipe, map, workspace.path(), options.code);
  const flash::Job job{recipe, map, tool, options.port, cargo.pieces, workspace.path()};
  const std::vector<flash::Step> steps = flash::plan(job);
  FlashAnswer answer;
  answer.json = {{"board", options.board},         {"tool", name_of(tool)},
                 {"image", cargo.image},           {"pieces", to_json(job.pieces)},
                 {"commands", cli::Json::array()}, {"written", !options.dry_run}};
  for (const flash::Step& step : steps) {
    const std::string line = files::shell_line(step.command);
    answer.json["commands"].push_back(line);
    if (options.dry_run) answer.text += line + "\n";
  }
  if (options.dry_run) return answer;
  const std::string what = to_text(job.pieces);  // before the temporary files are removed below
  flash::run(
      job, steps,
      {.progress = [&](const flash::Step& step, double share) { progress.show(share, step.label); },
       .stop = cli::interrupted});
  progress.clear();
  answer.text = fmt::format(
      "{}: {}: written and verified with {}{}{}\n", options.board, what, name_of(tool),
      tool == flash::Tool::kOpenocd ? ", and started" : "; set BOOT0 low and press reset",
      beside(options, cargo));
  return answer;
}

std::string to_text(const FlashOptions& options, const flash::EmulationPlan& plan,
                    const std::string& told) {
  std::string text =
      fmt::format("{}: runs in QEMU{}{}\n", options.board, told.empty() ? "" : "; ", told);
  for (const flash::EmulatedLink& link : plan.links) {
    text += fmt::format("  {:<18}{}\n", link.what, link.place);
  }
  if (plan.launch.serial_ports.empty()) {
    return text + fmt::format("  {:<18}verp walk --on {} starts one with a twin\n", "a walk",
                              options.board);
  }
  if (plan.protocol == BusProtocol::kCia402) {
    return text +
           fmt::format("  {:<18}verp bus read --link {}\n", "its registers", plan.links[0].place);
  }
  return text + fmt::format("  {:<18}verp hil MODEL --link {} --operator {}\n", "a twin for it",
                            plan.links[0].place, plan.links[1].place);
}

void run_on(flash::Emulation& emulation) {
  while (!cli::interrupted()) {
    if (!emulation.running()) throw board::BoardError(emulation.described("the emulator ended"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

FlashAnswer emulate(const FlashOptions& options, const flash::Recipe& recipe,
                    const std::function<void(const std::string&)>& say) {
  if (!options.port.empty() || !options.tool.empty()) {
    throw flash::FlashError(flash::FlashError::Kind::kUsage,
                            options.board +
                                ": an emulated board has no port and no flash tool; "
                                "leave out --port and --tool");
  }
  const flash::Workspace workspace(options.board);
  const flash::MemoryMap map = flash::read_memory_map(options.board);
  // QEMU takes the code as an image.
  const Cargo cargo = load(options, recipe, map, workspace.path(), false);
  const flash::EmulationPlan plan =
      flash::plan_emulation(recipe, cargo.protocol, cargo.pieces, workspace.path());
  const std::string line = files::shell_line(board::QemuProcess::command(plan.launch));
  FlashAnswer answer{.text = options.dry_run ? line + "\n" : "",
                     .json = {{"board", options.board},
                              {"tool", "qemu-system-arm"},
                              {"image", cargo.image},
                              {"pieces", to_json(cargo.pieces)},
                              {"commands", {line}},
                              {"links", cli::Json::object()},
                              {"written", !options.dry_run}}};
  for (const flash::EmulatedLink& link : plan.links) answer.json["links"][link.what] = link.place;
  if (options.dry_run) return answer;
  flash::Emulation emulation(plan);
  const std::string told = emulation.told();
  answer.json["told"] = told;
  if (options.stay) {
    say(to_text(options, plan, told) + "  Ctrl-C ends it\n");
    run_on(emulation);
  } else {
    answer.text = fmt::format("{}: runs in QEMU{}{}; verp flash --emulate keeps it running\n",
                              options.board, told.empty() ? "" : "; ", told);
  }
  return answer;
}

}  // namespace

void declare_target(CLI::App& app, FlashOptions& options) {
  app.add_option("--board", options.board, "a board of boards/")->required();
  app.add_option(
      "--port", options.port,
      "a serial port (/dev/ttyUSB0: the chip's own boot loader), or the serial number of "
      "a debug probe or USB device where there are several");
  app.add_option("--tool", options.tool,
                 "openocd, stm32flash or dfu-util, where the board can be flashed in several ways");
  app.add_flag("--emulate", options.emulate, "start the board in QEMU instead");
  app.add_flag("--dry-run", options.dry_run,
               "say what would be done, with the commands, and do none of it");
}

BusProtocol bus_of(const FlashOptions& options, const flash::Recipe& recipe,
                   const fs::path& folder) {
  return load(options, recipe, flash::read_memory_map(options.board), folder, false).protocol;
}

flash::EmulationPlan emulation_of(const FlashOptions& options, const flash::Recipe& recipe,
                                  const fs::path& folder) {
  const Cargo cargo = load(options, recipe, flash::read_memory_map(options.board), folder, false);
  return flash::plan_emulation(recipe, cargo.protocol, cargo.pieces, folder);
}

FlashAnswer flash_board(const FlashOptions& options, cli::Progress& progress,
                        const std::function<void(const std::string&)>& say) {
  const flash::Recipe& recipe = flash::find_recipe(options.board);
  if (!options.sensor.empty() && options.emulate) {
    throw flash::FlashError(
        flash::FlashError::Kind::kUsage,
        "--image " + options.sensor + ": QEMU has no such sensors; leave out --emulate");
  }
  if (recipe.chip == nullptr || options.emulate) return emulate(options, recipe, say);
  return flash_silicon(options, recipe, progress);
}

}  // namespace verp::tool
