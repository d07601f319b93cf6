#include "common/protocol/canopen/robot_plan.hpp"
#include "host/twin/eds/eds.hpp"

namespace verp::eds {
namespace {

std::vector<Entry> entries_of(const Description& description, bool with_manufacturers) {
  std::vector<Entry> all;
  for (const Object& object : description.objects) {
    if (is_manufacturers(object.index) && !with_manufacturers) continue;
    if (object.has_members) {
      const Value count{.name = object.name + ", entries", .writable = object.count_writable};
      all.push_back({{object.index, 0}, count});
    }
    for (std::size_t i = 0; i < object.values.size(); ++i) {
      std::size_t subindex = 0;
      if (object.has_members) subindex = object.subindices.empty() ? i + 1 : object.subindices[i];
      all.push_back({{object.index, static_cast<std::uint8_t>(subindex)}, object.values[i]});
    }
  }
  return all;
}

}  // namespace

std::vector<Entry> known_entries(const canopen::Identity& node) {
  for (const Sheet& each : sheets()) {
    const Description description = each.describe();
    const canopen::Identity& ours = description.identity;
    const bool same = ours.vendor == node.vendor && ours.product == node.product;
    const bool alike = (node.device_type & 0xFFFF) == canopen::plan::kDriveProfile &&
                       ours.device_type == node.device_type;
    if (same || alike) return entries_of(description, same);
  }
  return {};
}

}  // namespace verp::eds
