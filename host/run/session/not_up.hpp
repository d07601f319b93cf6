#pragma once
#include <stdexcept>
#include <string>

#include "firmware/app/bring_up_report.hpp"

namespace verp::session {

/// A robot did not come up. One line: what, where and the remedy.
class NotUp : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The reason; `where`: register or object of the failure.
NotUp not_up(const app::BringUpReport& report, const std::string& place, const std::string& where);

}  // namespace verp::session
