#pragma once
#include <cstdint>

namespace verp::own {

/// A crash inside a user's controller then prints one line and exits with 1.
void name_crashes();

/// The thread is inside that folder's controller.
class Inside {
 public:
  Inside(const char* folder, std::uint32_t tick);
  ~Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
};

}  // namespace verp::own
