#include "host/apps/tool/robot/doctor_machine.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include "host/os/files/whole.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::optional<std::uint64_t> free_bytes_in(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error) return std::nullopt;
  return space.available;
}

int number_in(const fs::path& path) {
  const std::string name = path.filename().string();
  const bool digits =
      std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits && name.size() < 10 ? std::atoi(name.c_str()) : 0;
}

}  // namespace

Machine::Machine() : Machine("", {}) {
  std::error_code error;
  current_folder = fs::current_path(error).string();
  variable = [](const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return std::string(value == nullptr ? "" : value);
  };
}

Machine::Machine(fs::path root, const Environment& environment)
    : variable([environment](const std::string& name) {
        return environment.contains(name) ? environment.at(name) : "";
      }),
      free_bytes([this](const std::string& folder) { return free_bytes_in(at(folder)); }),
      root_(std::move(root)) {}

bool Machine::exists(const std::string& path) const {
  std::error_code error;
  return fs::exists(at(path), error);
}

std::string Machine::read(const std::string& path) const {
  std::error_code error;
  if (!fs::is_regular_file(at(path), error)) return "";  // a pipe or device might never end
  return files::read(at(path)).value_or("");
}

std::string Machine::first_line(const std::string& path) const {
  const std::string text = read(path);
  return text.substr(0, text.find('\n'));
}

std::vector<std::string> Machine::list(const std::string& folder, const std::string& begin) const {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator each(at(folder), error), end; !error && each != end;
       each.increment(error)) {
    const std::string name = each->path().filename().string();
    if (name.starts_with(begin)) found.push_back(folder + "/" + name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<long> Machine::own_numbers(const std::string& label) const {
  std::vector<long> numbers;
  for (const std::string& line : split(read("/proc/self/status"), '\n')) {
    if (!line.starts_with(label)) continue;
    std::istringstream stream(line.substr(label.size()));
    for (long number = 0; stream >> number;) numbers.push_back(number);
  }
  return numbers;
}

std::vector<std::string> Machine::fields_of(const std::string& path, long id) const {
  for (const std::string& line : split(read(path), '\n')) {
    auto fields = split(line, ':');
    if (fields.size() > 2 && fields[2] == std::to_string(id)) return fields;
  }
  return {};
}

std::string Machine::user() const {
  const auto ids = own_numbers("Uid:");
  const auto fields = fields_of("/etc/passwd", ids.empty() ? -1 : ids[0]);
  return fields.empty() ? "$USER" : fields[0];
}

std::string Machine::how_to_join(const std::string& path) const {
  struct stat status {};
  ::stat(at(path).c_str(), &status);
  const auto fields = fields_of("/etc/group", status.st_gid);
  const std::string group = fields.empty() ? std::to_string(status.st_gid) : fields[0];
  const auto members = split(fields.size() > 3 ? fields[3] : "", ',');
  if (std::find(members.begin(), members.end(), user()) == members.end()) {
    return "sudo usermod -aG " + group + " " + user() + "  # then log in again";
  }
  return "newgrp " + group + "  # or log in again: you are in that group since your last login";
}

bool Machine::may_use(const std::string& path) const {
  struct stat status {};
  if (::stat(at(path).c_str(), &status) != 0) return false;
  const auto users = own_numbers("Uid:");
  auto groups = own_numbers("Groups:");
  for (const long each : own_numbers("Gid:")) groups.push_back(each);
  const long user = users.size() > 1 ? users[1] : 0;  // the effective one
  const bool in_group = std::find(groups.begin(), groups.end(), status.st_gid) != groups.end();
  const unsigned both = user == status.st_uid ? S_IRUSR | S_IWUSR
                        : in_group            ? S_IRGRP | S_IWGRP
                                              : S_IROTH | S_IWOTH;
  if (user == 0 || (status.st_mode & both) == both) return true;
  return root_.empty() && ::access(path.c_str(), R_OK | W_OK) == 0;  // an access list may allow it
}

RunningProgram Machine::program(int id) const {
  const std::string folder = "/proc/" + std::to_string(id);
  std::string command = read(folder + "/cmdline");
  while (!command.empty() && command.back() == '\0') command.pop_back();
  std::replace(command.begin(), command.end(), '\0', ' ');
  return {id, first_line(folder + "/comm"), command};
}

std::vector<RunningProgram> Machine::programs() const {
  const auto own = own_numbers("Pid:");
  std::vector<RunningProgram> all;
  for (const std::string& each : list("/proc")) {
    const int id = number_in(each);
    if (id != 0 && (own.empty() || id != own[0])) all.push_back(program(id));
  }
  return all;
}

std::vector<RunningProgram> Machine::holders(const std::string& device) const {
  std::error_code error;
  const fs::path real = root_.empty() ? fs::weakly_canonical(device, error) : fs::path(device);
  std::vector<RunningProgram> all;
  for (const std::string& each : list("/proc")) {
    const int id = number_in(each);
    if (id == 0 || id == ::getpid()) continue;
    const auto open = list(each + "/fd");
    if (std::any_of(open.begin(), open.end(), [&](const std::string& one) {
          return fs::read_symlink(at(one), error) == real;
        })) {
      all.push_back(program(id));
    }
  }
  return all;
}

}  // namespace verp::tool
