#pragma once
#include <cstdint>

#include "common/model/params.hpp"

/// The robot as a tree: node 0 is the body, node j + 1 is the link that joint j moves. Searches
/// recurse over parents: at most kMaxJoints levels, a few words of stack each.
namespace verp::model {

/// Joint whose name is `name`, or -1.
int find_joint(const Params& params, const char* name);

/// Bit j is set if joint j is in the subtree of `node` (including joint node - 1, which moves it);
/// node 0: all joints.
std::uint32_t subtree(const Params& params, int node);

struct Path {
  std::uint8_t node[kMaxNodes] = {};
  int length = 0;
};

/// The nodes from `from` to `to`, both included, through their nearest common ancestor.
Path path(const Params& params, int from, int to);

/// Sum of all link masses, kg.
float total_mass(const Params& params);

}  // namespace verp::model
