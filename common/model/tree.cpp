#include "common/model/tree.hpp"

namespace verp::model {
namespace {

bool same_name(const char* a, const char* b) {
  for (int i = 0; i < kNameLength; ++i) {
    if (a[i] != b[i]) return false;
    if (a[i] == '\0') return true;
  }
  return true;
}

int parent(const Params& params, int node) {
  return params.joint[node - 1].parent;
}

int depth(const Params& params, int node) {
  return node == 0 ? 0 : 1 + depth(params, parent(params, node));
}

bool below(const Params& params, int node, int ancestor) {
  if (node == ancestor) return true;
  return node != 0 && below(params, parent(params, node), ancestor);
}

void connect(const Params& params, int from, int to, Path& path) {
  if (from == to) {
    path.node[path.length++] = static_cast<std::uint8_t>(from);
  } else if (depth(params, from) >= depth(params, to)) {
    path.node[path.length++] = static_cast<std::uint8_t>(from);
    connect(params, parent(params, from), to, path);
  } else {
    connect(params, from, parent(params, to), path);
    path.node[path.length++] = static_cast<std::uint8_t>(to);
  }
}

}  // namespace

int find_joint(const Params& params, const char* name) {
  for (int j = 0; j < params.joint_count; ++j) {
    if (same_name(params.joint[j].name, name)) return j;
  }
  return -1;
}

std::uint32_t subtree(const Params& params, int node) {
  std::uint32_t joints = 0;
  for (int j = 0; j < params.joint_count; ++j) {
    if (below(params, j + 1, node)) joints |= std::uint32_t{1} << j;
  }
  return joints;
}

Path path(const Params& params, int from, int to) {
  Path result;
  connect(params, from, to, result);
  return result;
}

float total_mass(const Params& params) {
  float mass_kg = params.body_mass_kg;
  for (int j = 0; j < params.joint_count; ++j) mass_kg += params.joint[j].mass_kg;
  return mass_kg;
}

}  // namespace verp::model
