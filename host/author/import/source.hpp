#pragma once
#include <map>
#include <string>
#include <vector>

#include "host/author/import/servos.hpp"

namespace verp::import {

/// A foreign file as URDF, and what URDF has no words for.
struct Source {
  std::string format = "urdf";          ///< or mjcf, sdf, xacro
  std::string urdf;                     ///< empty: the file is one itself
  std::map<std::string, Drive> drives;  ///< by joint
  std::map<std::string, double> stand;  ///< rad, by joint
  std::vector<std::string> left_out;    ///< one line each
};

/// `folder`: where the URDF will be. Throws LoadError.
Source read_source(const std::string& file, const std::string& folder);

}  // namespace verp::import
