#include "host/apps/tool/robot/action_convert.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <numbers>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/author/action/csv.hpp"
#include "host/author/action/folder.hpp"
#include "host/author/action/kept.hpp"
#include "host/author/action/robotis.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/study/tune/lie_down.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommand = "verp action convert";

void write_file(const char* command, const fs::path& file, const std::string& bytes) {
  const files::Trouble trouble = files::replace(file, bytes);
  if (!trouble.any()) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: {}: {}", command, file.string(), trouble.text()));
}

std::string read_text(const fs::path& file) {
  const std::optional<std::string> text = files::read(file);
  if (text && !fs::is_directory(file)) return *text;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: {} cannot be read; give a file", kCommand, file.string()));
}

/// A folder that is filled under a temporary name: a failure leaves nothing behind.
class NewFolder {
 public:
  explicit NewFolder(fs::path path)
      : path_(std::move(path)), part_(path_.string() + fmt::format(".{}.part", getpid())) {
    std::error_code error;
    if (fs::exists(path_, error) && !fs::is_empty(path_, error)) {
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{}: {} is there already, and something is in it; give "
                                       "another folder",
                                       kCommand, path_.string()));
    }
    fs::create_directories(fs::absolute(path_).parent_path(), error);
    if (!fs::create_directory(part_, error)) fail();
  }
  ~NewFolder() {
    std::error_code error;
    fs::remove_all(part_, error);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const fs::path& part() const { return part_; }
  void keep() const {
    const int folder = ::open(part_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool kept = files::take_name(folder, part_, path_);
    ::close(folder);
    if (!kept) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw cli::ToolError(cli::kBadInput, fmt::format("{}: {}: {}", kCommand, path_.string(),
                                                     files::Trouble(errno).text()));
  }

  fs::path path_, part_;
};

std::string motion_to_folder(const Params& params, const ConvertWords& convert) {
  const auto documents = action::from_motion(params, action::read_motion(convert.from));
  if (documents.empty()) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: all pages of {} are blank; there is nothing to make "
                                     "actions of",
                                     kCommand, convert.from));
  }
  const NewFolder folder(convert.to.ends_with('/') ? convert.to.substr(0, convert.to.size() - 1)
                                                   : convert.to);
  for (const action::Document& each : documents) {
    write_file(kCommand, folder.part() / (each.name + ".action"), action::text_of(each));
  }
  folder.keep();
  return fmt::format("{}: {} actions\n", convert.to, documents.size());
}

std::string folder_to_motion(const Params& params, const ConvertWords& convert) {
  const auto documents = action::read_folder(convert.from);
  if (documents.empty()) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("{}: {} holds no action; give a folder of *.action", kCommand, convert.from));
  }
  const action::Motion motion = action::to_motion(params, documents);
  std::string bytes;
  for (const action::Page& page : motion) bytes.append(page.begin(), page.end());
  write_file(kCommand, convert.to, bytes);
  std::string text =
      fmt::format("{}: {} actions on {} pages\n", convert.to, documents.size(), motion.size());
  for (const action::Document& each : documents) {
    const std::string without = action::not_on_page(each);
    if (!without.empty()) text += fmt::format("  {} without its {}\n", each.name, without);
  }
  return text;
}

}  // namespace

std::string convert_actions(const ActionWords& words, const ConvertWords& convert) {
  const fs::path from = convert.from, to = convert.to;
  if (to.extension() == ".csv") {
    ActionWords named = words;
    named.action = convert.from;
    const ActionRobot robot = load_action_robot(named);
    const int number = require_action(robot, named);
    write_file(kCommand, to, action::to_csv(robot.params, robot.made, number));
    const std::string without =
        action::not_in_csv(robot.made.documents[static_cast<std::size_t>(number - 1)]);
    return convert.to + (without.empty() ? "\n" : ": without its " + without + "\n");
  }
  const Params params = model::make_params(model::load_robot(model::find_model(words.model), ""));
  if (from.extension() == ".csv" && to.extension() == ".action") {
    const auto made = action::from_csv(params, from, read_text(from), to.stem().string());
    write_file(kCommand, to, action::text_of(made));
    return convert.to + "\n";
  }
  if (from.extension() == ".bin" && !to.has_extension()) return motion_to_folder(params, convert);
  if (fs::is_directory(from) && to.extension() == ".bin") return folder_to_motion(params, convert);
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: nothing makes {} of {}; give ACTION FILE.csv, FILE.csv "
                                   "FILE.action, MOTION.bin FOLDER or FOLDER MOTION.bin",
                                   kCommand, convert.to, convert.from));
}

std::string record_action(const RecordWords& words) {
  const record::Trace trace = record::read_trace(words.trace);
  const fs::path file = words.file;
  if (file.extension() != ".action") {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp action record: {}: actions are *.action; give -o "
                                     "NAME.action",
                                     words.file));
  }
  action::RecordOptions options = words.options;
  options.name = file.stem().string();
  if (options.name.find_first_of(" \t\n#") != std::string::npos) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp action record: '{}' is no action's name: it has a "
                                     "space or a # in it; give -o NAME.action",
                                     options.name));
  }
  const action::Document document =
      words.gait_cycles > 0 ? action::record_gait(trace, options.name, words.gait_cycles)
                            : action::record_joints(trace, options);
  write_file("verp action record", file, action::text_of(document));
  return fmt::format("{}: {} frames\n", words.file, document.frames.size());
}

std::string make_lie_down(const ActionWords& words, const std::string& named) {
  const auto fail = [](cli::ExitStatus status, const std::string& why) {
    throw cli::ToolError(status, "verp action make: " + why);
  };
  const model::Entity entity = model::load_robot(model::find_model(words.model), "");
  const fs::path own = action::folder_of(entity.file) / (words.action + ".action");
  const fs::path file = named.empty() ? own : fs::path(named);
  std::error_code error;
  if (model::find_limb(entity, "left_leg") == nullptr)
    fail(cli::kBadInput, entity.name + " has no legs to lie down by");
  if (fs::exists(file, error))
    fail(cli::kBadInput, file.string() + " is there already; delete it, or name another by -o");
  const fs::path folder = fs::absolute(file).parent_path();
  if (!named.empty() && !fs::is_directory(folder, error))
    fail(cli::kBadInput, folder.string() + ": there is no such folder; make it, or mend -o");
  cli::Progress progress(true);
  const survey::Watch watch{.interrupted = cli::interrupted, .went_on = [&](double share) {
                              progress.show(share, "robots lie down in the twin");
                            }};
  tune::LieDown made = tune::make_lie_down(entity, {}, watch);
  progress.clear();
  if (made.interrupted) fail(cli::kRunFailed, "interrupted");
  const std::string worst = fmt::format(
      "{:.2f} m/s down ({:.1f} % of a free fall), then {:.0f} degrees without torque",
      made.worst.down_m_s, made.worst.fall_percent, 180 / std::numbers::pi * made.worst.moved_rad);
  if (!made.found) {
    fail(cli::kRunFailed, fmt::format("{}: no way down found in {} tries in the twin, the best {}. "
                                      "It is let go in the crouch, as before: hold it",
                                      entity.name, made.tries, worst));
  }
  made.document.note = "From the crouch to the floor, found in the twin";
  fs::create_directory(folder, error);  // of the robot's first action
  write_file("verp action make", file, action::text_of(made.document));
  return fmt::format(
      "{}: found in {} tries in the twin. {} robots lay down by it, at worst {}; it {}\n",
      file.string(), made.tries, tune::LieDownOptions().judges, worst, made.worst.ends);
}

std::string export_actions(const ActionWords& words, const std::string& file) {
  const ActionRobot robot = load_action_robot(words);
  if (robot.made.documents.empty()) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp action export: {} has no actions in {}; write one: "
                    "host/guide/actions.md has the words",
                    robot.entity.name, action::folder_of(robot.entity.file).string()));
  }
  const std::vector<std::uint8_t> image = action::kept_image(robot.made, robot.params);
  write_file("verp action export", file,
             {reinterpret_cast<const char*>(image.data()), image.size()});
  return fmt::format("{}: {} actions of {}, {} bytes\n", file, robot.made.documents.size(),
                     robot.entity.name, image.size());
}

}  // namespace verp::tool
