#include "host/robot/model/load.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <sdf/sdf.hh>
#include <system_error>
#include <thread>

#include "host/robot/model/assemble.hpp"
#include "host/robot/model/bus_time.hpp"
#include "host/robot/model/couplings.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/library_console.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/unread.hpp"
#include "host/robot/model/urdf_check.hpp"
#include "host/robot/model/urdf_prepare.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {
namespace {

using Text = std::optional<std::string>;  // none: the file's content

/// While it lives, this thread's working directory has no file with a robot's name. In a container
/// that forbids a directory per thread, this applies to all threads.
class NoFilesHere {
 public:
  NoFilesHere() {
    const bool own = ::unshare(CLONE_FS) == 0;
    if (!own) before_ = ::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
    if ((own || before_ >= 0) && ::chdir("/proc/self/fdinfo") == 0) return;
    const int reason = errno;
    if (before_ >= 0) ::close(before_);
    throw std::system_error(reason, std::generic_category(), "/proc/self/fdinfo");
  }
  ~NoFilesHere() {
    if (before_ < 0) return;
    static_cast<void>(::fchdir(before_) == 0);
    ::close(before_);
  }
  NoFilesHere(const NoFilesHere&) = delete;
  NoFilesHere& operator=(const NoFilesHere&) = delete;

 private:
  int before_ = -1;
};

/// libsdformat looks for a relative <uri> in the working directory first: a user in a robot's
/// folder would get another robot.
void where_no_file_is(const std::function<void()>& work) {
  std::exception_ptr failure;
  std::thread([&] {
    try {
      const NoFilesHere here;
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  }).join();
  if (failure) std::rethrow_exception(failure);
}

/// libsdformat's strictest reading. Settings are global, because an <include> ignores those of
/// Load().
sdf::Errors read(const XmlSource& source, const PreparedUrdfs& urdfs, sdf::Root& root) {
  const std::string path = source.path();
  sdf::ParserConfig& config = sdf::ParserConfig::GlobalConfig();
  config.SetFindCallback([&](const std::string& uri) {
    const std::string found = source.included(uri);
    return found.empty() ? found : urdfs.copy_of(found);
  });
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  sdf::Errors errors;
  where_no_file_is([&] { errors = root.LoadSdfString(source.text_with_names()); });
  // The copies are deleted soon.
  config.SetFindCallback([path](const std::string& uri) { return resolve_model_uri(uri, path); });
  return errors;
}

[[noreturn]] void fail(const XmlSource& source, const PreparedUrdfs& urdfs,
                       const sdf::Error& error) {
  XmlSource::Place place = source.blame(error.Message());
  const std::string whole = error.FilePath().value_or(source.path());
  const bool own = whole == std::filesystem::absolute(source.path()).string();
  const std::string file = own ? source.path() : whole;
  const bool of_text = file == "data-string" || file == "<data-string>";
  if (error.LineNumber() && *error.LineNumber() > 0 && !urdfs.is_copy(file)) {
    place.line = *error.LineNumber();
    place.file = of_text ? source.path() : file;
  }
  std::string fix = "see sdformat.org/spec for what SDF allows here";
  switch (error.Code()) {
    case sdf::ErrorCode::DUPLICATE_NAME:
      fix = "give links, joints and frames names of their own";
      break;
    case sdf::ErrorCode::LINK_INERTIA_INVALID:
      fix = "write a positive mass and an inertia of a body that can exist";
      break;
    case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
    case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
      fix = "name links that exist";
      break;
    case sdf::ErrorCode::POSE_RELATIVE_TO_INVALID:
    case sdf::ErrorCode::FRAME_ATTACHED_TO_INVALID:
      fix = "name a link, joint or frame that exists";
      break;
    default:
      break;
  }
  throw LoadError(place.file, place.line, error.Message(), fix);
}

void cross_check(const XmlSource& source, const Facts& facts, const PreparedUrdfs& urdfs,
                 const sdf::Model& model) {
  UrdfTotals expected;
  for (const XmlElement& urdf : source.urdfs()) {
    const UrdfTotals totals = check_urdf(source, urdf, facts, urdfs.plain_copy_of(urdf.file()));
    expected.moving_joints += totals.moving_joints;
    expected.mass_kg += totals.mass_kg;
  }
  if (source.urdfs().empty()) return;
  int moving_joints = 0;
  for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
    if (model.JointByIndex(i)->Type() != sdf::JointType::FIXED) ++moving_joints;
  }
  double mass_kg = 0;
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    mass_kg += model.LinkByIndex(i)->Inertial().MassMatrix().Mass();
  }
  // The wrapper may add links and joints, not remove them.
  if (moving_joints < expected.moving_joints || mass_kg < expected.mass_kg * (1 - 1e-6)) {
    source.urdfs().front().fail(
        "libsdformat's import lost joints or mass: " + std::to_string(moving_joints) + " of " +
            std::to_string(expected.moving_joints) + " joints, " + std::to_string(mass_kg) +
            " of " + std::to_string(expected.mass_kg) + " kg",
        "convert this file to SDF by hand");
  }
}

}  // namespace

Entity load_robot(const std::string& path, const std::string& bus) {
  Entity entity = load_robot_on_any_bus(path, bus);
  require_bus(entity, make_params(entity));
  return entity;
}

namespace {

/// Otherwise the robot cannot walk, and nothing would explain it.
void require_legs_and_imu(const XmlElement& model, const Facts& facts) {
  for (const std::string leg : {"left_leg", "right_leg"}) {
    const bool has = std::any_of(facts.limbs.begin(), facts.limbs.end(),
                                 [&](const LimbFact& limb) { return limb.name == leg; });
    if (!has) {
      model.fail("the robot has no " + leg,
                 "add <verp:limb name=\"" + leg + "\" base=\"TRUNK LINK\" tip=\"SOLE FRAME\"/>");
    }
  }
  if (!facts.imu) {
    model.fail("the robot has no IMU, and balances by nothing else",
               "add <verp:imu link=\"TRUNK LINK\" id=\"120\" type=\"icm20648\"/>");
  }
}

Entity load(const std::string& path, const std::string& bus, bool whole, const Text& text = {}) {
  const XmlSource source(path, text);
  const XmlElement model = source.model();
  Facts facts = read_facts(model, bus);
  const LibraryConsole silence;
  const PreparedUrdfs urdfs(source, facts);
  for (const XmlElement& urdf : source.urdfs()) {
    check_urdf(source, urdf, facts, urdfs.plain_copy_of(urdf.file()));
    for (MimicFact& mimic : urdf_mimics(urdf, facts)) facts.mimics.push_back(std::move(mimic));
  }
  sdf::Root root;
  const sdf::Errors errors = read(source, urdfs, root);
  if (!errors.empty()) fail(source, urdfs, errors.front());
  if (!root.Model()) model.fail("libsdformat finds no model here", "put one <model> below <sdf>");
  cross_check(source, facts, urdfs, *root.Model());
  Entity entity = assemble(source, facts, *root.Model(), urdfs.names());
  entity.notes.insert(entity.notes.end(), urdfs.notes().begin(), urdfs.notes().end());
  Lost lost;
  for (const XmlElement& top : source.tops()) find_unread(top, lost);
  find_missing_meshes(entity, lost);
  for (const std::string& line : lines_of(lost))
    entity.notes.push_back("changed or left out: " + line);
  if (whole) require_legs_and_imu(model, facts);
  return entity;
}

}  // namespace

Entity load_robot_on_any_bus(const std::string& path, const std::string& bus) {
  return load(path, bus, true);
}

Entity load_part_of_robot(const std::string& path) {
  return load(path, "", false);
}

Entity load_part_of_robot_text(const std::string& path, const std::string& text) {
  return load(path, "", false, text);
}

Entity load_robot_text(const std::string& path, const std::string& text) {
  Entity entity = load(path, "", true, text);
  require_bus(entity, make_params(entity));
  return entity;
}

void check_numbers(const std::string& path, const std::string& text) {
  const XmlSource source(path, text);
}

Entity load_robot_on_can(const std::string& path, const std::string& bus) {
  Entity entity = load_robot_on_any_bus(path, bus);
  if (!bus.empty() || entity.protocol == BusProtocol::kCia402) return entity;
  for (const std::string& name : entity.buses) {
    Entity other = load_robot_on_any_bus(path, name);
    if (other.protocol == BusProtocol::kCia402) return other;
  }
  return entity;
}

}  // namespace verp::model
