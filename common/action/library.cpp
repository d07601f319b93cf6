#include "common/action/library.hpp"

#include "common/base/crc32.hpp"

namespace verp::action {
namespace {

const Action* actions_of(const LibraryHeader* header) {
  return reinterpret_cast<const Action*>(header + 1);
}
const Frame* frames_of(const LibraryHeader* header) {
  return reinterpret_cast<const Frame*>(actions_of(header) + header->actions);
}

bool is_well_formed(const Frame& frame, int frames) {
  const std::uint16_t ways[] = {frame.next, frame.otherwise, frame.exit, frame.loop_to};
  for (const std::uint16_t to : ways) {
    if (to != kToStand && to >= frames) return false;
  }
  for (const std::uint8_t percent : frame.stiffness_percent) {
    if (percent > 100) return false;
  }
  return frame.time_ms >= kLeastFrame_ms && static_cast<int>(frame.condition) < kConditions &&
         frame.stance <= Stance::kNone && frame.balance <= 1;
}

bool is_well_formed(const Action& action, int frames) {
  return action.name[kNameLength - 1] == '\0' && action.frames > 0 &&
         action.first + action.frames <= frames;
}

}  // namespace

LibraryFault check_library(const void* bytes, std::size_t size) {
  if (bytes == nullptr || size < sizeof(LibraryHeader)) return LibraryFault::kTruncated;
  const auto* header = static_cast<const LibraryHeader*>(bytes);
  if (__builtin_memcmp(header->magic, kLibraryMagic, sizeof kLibraryMagic) != 0) {
    return LibraryFault::kNotALibrary;
  }
  if (header->library_version != kLibraryVersion) return LibraryFault::kOtherLayout;
  if (header->actions > kMaxActions || header->frames > kMaxFrames) {
    return LibraryFault::kOutOfBounds;
  }
  const std::size_t whole =
      sizeof(LibraryHeader) + header->actions * sizeof(Action) + header->frames * sizeof(Frame);
  if (header->size != whole) return LibraryFault::kOutOfBounds;
  if (size < whole) return LibraryFault::kTruncated;
  if (crc32(header + 1, whole - sizeof(LibraryHeader)) != header->crc32) {
    return LibraryFault::kDamaged;
  }
  for (int i = 0; i < header->actions; ++i) {
    if (!is_well_formed(actions_of(header)[i], header->frames)) return LibraryFault::kOutOfBounds;
  }
  for (int i = 0; i < header->frames; ++i) {
    if (!is_well_formed(frames_of(header)[i], header->frames)) return LibraryFault::kOutOfBounds;
  }
  return LibraryFault::kNone;
}

Library::Library(const void* bytes, std::size_t size) {
  if (check_library(bytes, size) != LibraryFault::kNone) return;
  header_ = static_cast<const LibraryHeader*>(bytes);
  actions_ = actions_of(header_);
  frames_ = frames_of(header_);
}

std::uint8_t Library::number_of(const char (&name)[kNameLength]) const {
  for (int number = 1; number <= count(); ++number) {
    if (__builtin_memcmp(action(number).name, name, kNameLength) == 0) {
      return static_cast<std::uint8_t>(number);
    }
  }
  return 0;
}

}  // namespace verp::action
