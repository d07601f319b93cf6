#include "common/action/kept.hpp"

#include "common/base/crc32.hpp"

namespace verp::action {
namespace {

bool is_erased(const LibraryHeader& header) {
  for (const char each : header.magic) {
    if (static_cast<unsigned char>(each) != 0xFF) return false;
  }
  return true;
}

std::uint32_t crc_of(const LibraryHeader& library, std::uint32_t robot) {
  return crc32(&robot, sizeof robot, crc32(&library, sizeof library));
}

KeptMark mark_of(const LibraryHeader& library) {
  KeptMark mark;
  __builtin_memcpy(&mark, reinterpret_cast<const char*>(&library) + library.size, sizeof mark);
  return mark;
}

}  // namespace

std::uint32_t robot_mark(const Params& params) {
  std::uint32_t mark = crc32(params.name, sizeof params.name);
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const Xyz axis_and_place[] = {joint.origin_parent_m, joint.axis};
    const float limits_rad[] = {joint.lower_rad, joint.upper_rad};
    mark = crc32(joint.name, sizeof joint.name, mark);
    mark = crc32(axis_and_place, sizeof axis_and_place, mark);
    mark = crc32(limits_rad, sizeof limits_rad, mark);
  }
  return mark;
}

KeptMark make_mark(const LibraryHeader& library, const Params& params) {
  const std::uint32_t robot = robot_mark(params);
  return {robot, crc_of(library, robot)};
}

KeptFault check_any_kept(const void* bytes, std::size_t size) {
  const auto& header = *static_cast<const LibraryHeader*>(bytes);
  const LibraryFault fault = check_library(bytes, size);
  if (fault != LibraryFault::kNone) return static_cast<KeptFault>(fault);
  if (size - header.size < sizeof(KeptMark)) return KeptFault::kTruncated;
  const KeptMark there = mark_of(header);
  return there.crc32 == crc_of(header, there.robot) ? KeptFault::kNone : KeptFault::kDamaged;
}

std::size_t kept_size(const void* bytes, std::size_t size) {
  if (check_any_kept(bytes, size) != KeptFault::kNone) return 0;
  return static_cast<const LibraryHeader*>(bytes)->size + sizeof(KeptMark);
}

KeptFault check_kept(const void* bytes, std::size_t size, const Params& params) {
  const auto& header = *static_cast<const LibraryHeader*>(bytes);
  if (size >= sizeof header && is_erased(header)) return KeptFault::kNone;
  const KeptFault fault = check_any_kept(bytes, size);
  if (fault != KeptFault::kNone) return fault;
  return mark_of(header).robot == robot_mark(params) ? KeptFault::kNone : KeptFault::kOtherRobot;
}

KeptLibrary::KeptLibrary(const void* bytes, std::size_t size, const Params& params)
    : fault(check_kept(bytes, size, params)) {
  if (fault == KeptFault::kNone) library = Library(bytes, size);
}

}  // namespace verp::action
