#pragma once
#include <vector>

#include "host/author/action/compile.hpp"

namespace verp::action {

/// Key frames of one action; ways within it count from 0, others are set later.
struct Draft {
  std::vector<Frame> frames;
  std::vector<int> line;
  std::vector<Angles> angle_rad;  ///< as exact as known
};

/// Throws LoadError with the joints that there are.
int joint_named(const Params& params, const std::string& name, const std::filesystem::path& file,
                int line);

/// Poses of an action that is no mirror image. Throws LoadError.
Draft draft(const Params& params, const Poser& poser, const Document& document);

/// The same with left and right exchanged. Throws LoadError for a robot that is not symmetric.
Draft mirrored(const Params& params, const Draft& draft, const Document& document);

}  // namespace verp::action
