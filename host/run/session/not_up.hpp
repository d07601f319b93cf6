#pragma once
#include <stdexcept>
#include <string>

#include "firmware/app/bring_up_report.hpp"

namespace verp::session {

/// A robot did not come up: one line that says what, where and how to mend it.
class NotUp : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Why it did not; `where` is the register or object at which it failed.
NotUp not_up(const app::BringUpReport& report, const std::string& place, const std::string& where);

}  // namespace verp::session
