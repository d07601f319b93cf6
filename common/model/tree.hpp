#pragma once
#include <cstdint>

#include "common/model/params.hpp"

/// Node 0 is the body, node j + 1 the link of joint j. Recursion is at most kMaxJoints deep.
namespace verp::model {

/// Returns -1 if there is none.
int find_joint(const Params& params, const char* name);

/// Bit j: joint j is in the subtree of `node`, including joint node - 1; node 0: all joints.
std::uint32_t subtree(const Params& params, int node);

struct Path {
  std::uint8_t node[kMaxNodes] = {};
  int length = 0;
};

/// Nodes `from` to `to`, inclusive, through the nearest common ancestor.
Path path(const Params& params, int from, int to);

/// Mass of all links, kg.
float total_mass(const Params& params);

}  // namespace verp::model
