#pragma once
#include <vector>

#include "host/author/action/compile.hpp"

namespace verp::action {

/// Key frames of one action; links count from 0, links to others are set later.
struct Draft {
  std::vector<Frame> frames;
  std::vector<int> line;
  std::vector<Angles> angle_rad;  ///< not rounded
};

/// Throws LoadError with the joints.
int joint_named(const Params& params, const std::string& name, const std::filesystem::path& file,
                int line);

/// For an action that mirrors no other. Throws LoadError.
Draft draft(const Params& params, const Poser& poser, const Document& document);

/// Exchanges left and right. Throws LoadError for an asymmetric robot.
Draft mirrored(const Params& params, const Draft& draft, const Document& document);

}  // namespace verp::action
