#pragma once
#include "common/action/library.hpp"
#include "common/base/crc32.hpp"

namespace verp::action::test {

/// One action of two frames, one of one frame.
struct Shelf {
  LibraryHeader header;
  Action action[2];
  Frame frame[3];

  Shelf() {
    __builtin_memcpy(header.magic, kLibraryMagic, sizeof kLibraryMagic);
    header.library_version = kLibraryVersion;
    header.size = sizeof(Shelf);
    header.actions = 2;
    header.frames = 3;
    action[0].name[0] = 'a';
    action[0].frames = 2;
    action[1].name[0] = 'b';
    action[1].first = 2;
    action[1].frames = 1;
    for (Frame& each : frame) {
      each.time_ms = 200;
      for (std::uint8_t& percent : each.stiffness_percent) percent = 100;
    }
    frame[0].next = 1;
    seal();
  }
  void goal(int index, int joint, float angle_rad) {
    frame[index].joints |= 1U << joint;
    frame[index].smooth |= 1U << joint;
    frame[index].goal_tenth_mrad[joint] = static_cast<std::int16_t>(1e4F * angle_rad);
    seal();
  }
  void seal() { header.crc32 = crc32(action, sizeof(Shelf) - sizeof(LibraryHeader)); }
  Library library() const { return {this, sizeof(Shelf)}; }
};
static_assert(sizeof(Shelf) == sizeof(LibraryHeader) + 2 * sizeof(Action) + 3 * sizeof(Frame));

}  // namespace verp::action::test
