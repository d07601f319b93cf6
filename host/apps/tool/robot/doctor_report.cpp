#include "host/apps/tool/robot/doctor_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace verp::tool {

void Findings::split(const char* state, const std::string& check, const std::string& line) {
  const std::size_t end = std::min(line.find("; "), line.size());
  add(state, check, line.substr(0, end), end == line.size() ? "" : line.substr(end + 2));
}

bool Findings::any_bad() const {
  return std::any_of(all_.begin(), all_.end(),
                     [](const Finding& each) { return each.state == "bad"; });
}

std::string Findings::text() const {
  std::string text;
  for (const Finding& each : all_) {
    text += fmt::format("{:<7} {:<16} {}\n", each.state, each.check, each.text);
    if (!each.fix.empty()) text += fmt::format("{:<7} fix: {}\n", "", each.fix);
  }
  return text;
}

cli::Json Findings::json() const {
  cli::Json checks = cli::Json::array();
  for (const Finding& each : all_) {
    checks.push_back({{"check", each.check}, {"state", each.state}, {"text", each.text}});
    checks.back()["fix"] = each.fix;
  }
  return {{"good", !any_bad()}, {"checks", checks}};
}

}  // namespace verp::tool
