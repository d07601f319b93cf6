#pragma once
#include <string>

namespace verp::import {

/// One line of import.md's table.
struct Finding {
  enum class Sureness { kRead, kMeasured, kGuessed } sureness = Sureness::kRead;
  std::string what, value, check;  ///< `check`: what a person should look at; may be empty
};

}  // namespace verp::import
