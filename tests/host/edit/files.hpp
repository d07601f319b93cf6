#pragma once
#include <fstream>
#include <iterator>
#include <string>

#include "host/os/files/temporary_directory.hpp"

namespace verp::edit {

inline std::string read(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string robot(const std::string& name) {
  return std::string(VERP_SOURCE_DIR "/common/robots/") + name + "/robot.sdf";
}

}  // namespace verp::edit
