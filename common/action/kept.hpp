#pragma once
#include <cstddef>
#include <cstdint>

#include "common/action/library.hpp"
#include "common/base/fields.hpp"
#include "common/model/params.hpp"

/// Actions in a board's flash: a library image (library.hpp) and its robot's mark. Joints are
/// numbers, so another robot would move the wrong ones.
namespace verp::action {

struct KeptMark {
  std::uint32_t robot = 0;  ///< robot_mark() of their robot
  std::uint32_t crc32 = 0;  ///< of the library's header and `robot`
  VERP_FIELDS(robot, crc32)
};
VERP_PACKED(KeptMark);

/// LibraryFault, and kOtherRobot.
enum class KeptFault : std::uint8_t {
  kNone = 0,  ///< sound, or erased flash
  kTruncated = 1,
  kNotALibrary = 2,
  kOtherLayout = 3,
  kDamaged = 4,  ///< image or mark
  kOutOfBounds = 5,
  kOtherRobot = 6,
};
inline constexpr const char* kKeptFaultNames[] = {
    "none",    "truncated",     "no action library", "of another version",
    "damaged", "out of bounds", "for another robot"};

/// Covers the robot's name, each joint's name, place, axis and limits. Not gains, friction, zeros,
/// tuning or bus.
std::uint32_t robot_mark(const Params& params);

KeptMark make_mark(const LibraryHeader& library, const Params& params);

/// `bytes` aligned to 4; `size` may exceed the actions (a flash section).
KeptFault check_kept(const void* bytes, std::size_t size, const Params& params);

/// check_kept() for whichever robot the mark names.
KeptFault check_any_kept(const void* bytes, std::size_t size);

/// Bytes of a sound library and its mark, for any robot; 0: none.
std::size_t kept_size(const void* bytes, std::size_t size);

struct KeptLibrary {
  KeptLibrary() = default;
  KeptLibrary(const void* bytes, std::size_t size, const Params& params);

  Library library;  ///< empty on a fault
  KeptFault fault = KeptFault::kNone;
};

}  // namespace verp::action
