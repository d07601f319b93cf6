#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host/apps/tool/robot/doctor_bus.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tool {

/// One finding of that state has both texts.
inline void expect_finding(const Findings& found, const std::string& state, const std::string& text,
                           const std::string& fix) {
  const cli::Json json = found.json();
  for (const cli::Json& each : json.at("checks")) {
    if (each.at("state") == state &&
        each.at("text").get<std::string>().find(text) != std::string::npos &&
        each.at("fix").get<std::string>().find(fix) != std::string::npos) {
      return;
    }
  }
  ADD_FAILURE() << "no " << state << " with '" << text << "' and '" << fix << "':\n"
                << found.text();
}

inline void expect_one_bad(const Findings& found) {
  const cli::Json json = found.json();
  const auto& all = json.at("checks");
  EXPECT_EQ(std::count_if(all.begin(), all.end(),
                          [](const auto& each) { return each.at("state") == "bad"; }),
            1)
      << found.text();
}

inline BusCase generic21(const std::string& link, const std::string& bus = "") {
  BusCase made{.link = link,
               .endpoint = link::parse_endpoint(link),
               .timeout_us = 250'000,
               .model = "generic21"};
  const std::string file = model::find_model("generic21");
  made.robot = bus == "can" ? model::load_robot_on_can(file, "") : model::load_robot(file, bus);
  made.params = model::make_params(*made.robot);
  made.protocol = made.params->bus_protocol;
  return made;
}

}  // namespace verp::tool
