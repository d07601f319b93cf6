#pragma once
#include <cstddef>
#include <cstdint>

#include "common/action/library.hpp"
#include "common/base/fields.hpp"
#include "common/model/params.hpp"

/// A robot's actions as a board keeps them in its flash: a library image (library.hpp), and behind
/// it a mark that names the robot. A library's joints are numbers: played by another robot it moves
/// what nobody meant.
namespace verp::action {

struct KeptMark {
  std::uint32_t robot = 0;  ///< robot_mark() of the robot that the actions were made for
  std::uint32_t crc32 = 0;  ///< of the library's header and `robot`
  VERP_FIELDS(robot, crc32)
};
VERP_PACKED(KeptMark);

/// LibraryFault and one more.
enum class KeptFault : std::uint8_t {
  kNone = 0,  ///< all is well, or nothing is there: erased
  kTruncated = 1,
  kNotALibrary = 2,
  kOtherLayout = 3,
  kDamaged = 4,  ///< the image, or its mark
  kOutOfBounds = 5,
  kOtherRobot = 6,
};
inline constexpr const char* kKeptFaultNames[] = {
    "none",    "truncated",     "no action library", "of another version",
    "damaged", "out of bounds", "for another robot"};

/// What actions depend on: the robot's name, and of each joint its name, place, axis and limits. It
/// stays the same when gains, friction, zeros or the tuning change, and whatever the bus.
std::uint32_t robot_mark(const Params& params);

KeptMark make_mark(const LibraryHeader& library, const Params& params);

/// What is wrong with these bytes, aligned to 4, as the actions of this robot; `size` may exceed
/// what is there (a flash section).
KeptFault check_kept(const void* bytes, std::size_t size, const Params& params);

/// The same as the actions of whatever robot they name.
KeptFault check_any_kept(const void* bytes, std::size_t size);

/// Bytes of a sound library and its mark, whatever robot they name; 0: there are none.
std::size_t kept_size(const void* bytes, std::size_t size);

struct KeptLibrary {
  KeptLibrary() = default;
  KeptLibrary(const void* bytes, std::size_t size, const Params& params);

  Library library;  ///< no actions if there is a fault
  KeptFault fault = KeptFault::kNone;
};

}  // namespace verp::action
