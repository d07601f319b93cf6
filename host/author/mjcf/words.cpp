#include "host/author/mjcf/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace verp::mjcf {

namespace fs = std::filesystem;

std::string numbers(const Vec3& v) {
  const auto plain = [](double value) { return std::abs(value) < 1e-15 ? 0.0 : value; };
  return fmt::format("{:.12g} {:.12g} {:.12g}", plain(v.x()), plain(v.y()), plain(v.z()));
}

std::string ending_of(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::string path_from(const std::string& folder, const std::string& file) {
  return fs::relative(fs::weakly_canonical(file), fs::weakly_canonical(folder)).string();
}

}  // namespace verp::mjcf
