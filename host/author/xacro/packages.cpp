#include "host/author/xacro/packages.hpp"

#include <filesystem>

#include "host/os/files/whole.hpp"

namespace verp::xacro {
namespace {

namespace fs = std::filesystem;
constexpr int kMostSteps = 6;  // above the file

bool says_its_name(const fs::path& folder, const std::string& name) {
  const std::string text = files::read(folder / "package.xml").value_or("");
  return text.find("<name>" + name + "</name>") != std::string::npos;
}

}  // namespace

std::optional<std::string> find_package(const std::string& name, const std::string& file) {
  std::error_code error;
  fs::path at = fs::absolute(file, error).lexically_normal().parent_path();
  for (int step = 0; step < kMostSteps && at.has_relative_path(); ++step, at = at.parent_path()) {
    if (at.filename() == name || says_its_name(at, name)) return at.string();
    if (fs::is_directory(at / name, error)) return (at / name).string();
  }
  return std::nullopt;
}

std::string moved_path(const std::string& name, const std::string& file, const std::string& to) {
  constexpr std::string_view kPackage = "package://", kFile = "file://";
  fs::path path;
  if (name.rfind(kPackage, 0) == 0) {
    const std::string rest = name.substr(kPackage.size());
    const auto folder = find_package(rest.substr(0, rest.find('/')), file);
    if (!folder || rest.find('/') == std::string::npos) return name;
    path = fs::path(*folder) / rest.substr(rest.find('/') + 1);
  } else if (name.rfind(kFile, 0) == 0) {
    path = name.substr(kFile.size());
  } else if (name.find("://") != std::string::npos) {
    return name;
  } else {
    path = fs::path(file).parent_path() / name;
  }
  return fs::relative(fs::weakly_canonical(path), fs::weakly_canonical(to)).string();
}

}  // namespace verp::xacro
