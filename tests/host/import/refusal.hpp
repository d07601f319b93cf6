#pragma once
#include <string>

#include "host/robot/model/load_error.hpp"

namespace verp::import {

/// The refusal's line and message; empty: none.
template <class Reading>
std::string refusal_of(Reading&& reading) {
  try {
    reading();
  } catch (const model::LoadError& error) {
    return std::to_string(error.line) + ": " + error.message;
  }
  return "";
}

}  // namespace verp::import
