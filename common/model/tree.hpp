#pragma once
#include <cstdint>

#include "common/model/params.hpp"

/// The robot as a tree: node 0 is the body, node j + 1 the link of joint j. Recursion is at most
/// kMaxJoints deep, a few words of stack each.
namespace verp::model {

/// Returns -1 if there is none.
int find_joint(const Params& params, const char* name);

/// Bit j: joint j is in the subtree of `node`, including joint node - 1; node 0: all joints.
std::uint32_t subtree(const Params& params, int node);

struct Path {
  std::uint8_t node[kMaxNodes] = {};
  int length = 0;
};

/// Nodes from `from` to `to`, inclusive, through their nearest common ancestor.
Path path(const Params& params, int from, int to);

/// Mass of all links, kg.
float total_mass(const Params& params);

}  // namespace verp::model
