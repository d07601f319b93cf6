#pragma once
#include "hal/chip/semihosting/semihosting.hpp"

namespace verp::board {

/// The emulator's command line: [0] is the image, its arguments follow. Missing words are "".
class Arguments {
 public:
  static constexpr int kMax = 5;

  Arguments() {
    if (!hal::semihosting::command_line(text_, sizeof text_)) text_[0] = 0;
    char* next = text_;
    for (const char*& word : word_) {
      while (*next == ' ') *next++ = 0;
      word = next;
      while (*next != ' ' && *next != 0) ++next;
    }
    if (*next == ' ') *next = 0;
  }
  const char* operator[](int index) const { return word_[index]; }

 private:
  char text_[1024];
  const char* word_[kMax];
};

}  // namespace verp::board
