#include "host/robot/model/robot_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/number.hpp"

namespace verp::model {
namespace {

std::string trim(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

RobotTable::RobotTable(const std::string& path) : path_(path) {
  std::ifstream file(path);
  if (!file)
    throw LoadError(path, 1, "cannot read this file", "check the path and its permissions");
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line = trim(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const auto equals = line.find('=');
    const std::string key = trim(line.substr(0, equals));
    if (equals == std::string::npos || key.empty() || trim(line.substr(equals + 1)).empty()) {
      throw LoadError(path, number, "not `key = value`: " + line, "write one key and one value");
    }
    const auto [place, fresh] = entries_.insert({key, {trim(line.substr(equals + 1)), number}});
    if (!fresh) {
      throw LoadError(path, number, "'" + key + "' is given twice",
                      "remove this line or line " + std::to_string(place->second.line));
    }
  }
}

std::string RobotTable::text(const std::string& key) {
  const auto entry = entries_.find(key);
  if (entry == entries_.end()) {
    throw LoadError(path_, 1, "'" + key + "' is missing", "add a line `" + key + " = ...`");
  }
  read_.insert(key);
  return entry->second.value;
}

double RobotTable::number(const std::string& key) {
  const auto value = parse_number(text(key));
  if (!value) {
    throw LoadError(path_, entries_.at(key).line,
                    "'" + key + "' is not one finite number: " + entries_.at(key).value,
                    "write it like 0.093");
  }
  return *value;
}

std::string RobotTable::part(const std::string& key, std::size_t which) {
  std::string rest = text(key);
  for (std::size_t i = 0; i < which; ++i) {
    const auto bar = rest.find('|');
    if (bar == std::string::npos) {
      fail(key, "'" + key + "' has only " + std::to_string(i + 1) + " parts",
           "write all parts, with | between them");
    }
    rest.erase(0, bar + 1);
  }
  return trim(rest.substr(0, rest.find('|')));
}

std::vector<double> RobotTable::numbers(const std::string& key, std::size_t which,
                                        std::size_t count) {
  const std::string text = part(key, which);
  const auto values = parse_numbers(text);
  if (!values || values->size() != count) {
    fail(key,
         "'" + key + "', part " + std::to_string(which + 1) + " is not " + std::to_string(count) +
             " finite numbers: " + text,
         "write them like 0.093, with blanks between them");
  }
  return *values;
}

std::vector<std::string> RobotTable::keys(const std::string& beginning) const {
  std::vector<std::string> found;
  for (const auto& [key, entry] : entries_) {
    if (key.starts_with(beginning)) found.push_back(key);
  }
  std::sort(found.begin(), found.end(), [&](const std::string& a, const std::string& b) {
    return entries_.at(a).line < entries_.at(b).line;
  });
  return found;
}

void RobotTable::fail(const std::string& key, const std::string& message,
                      const std::string& fix) const {
  throw LoadError(path_, entries_.at(key).line, message, fix);
}

std::string tuning_lines(RobotTable& table) {
  const std::string beginning = "tuning.";
  std::string out;
  for (const std::string& key : table.keys(beginning)) {
    out += fmt::format("    <verp:tuning name=\"{}\" value=\"{:.9g}\"/>\n",
                       key.substr(beginning.size()), table.number(key));
  }
  return out;
}

std::string generate_sdf(RobotTable& table) {
  if (!table.has("layout")) return generate_humanoid_sdf(table);
  if (table.text("layout") == "tree") return generate_tree_sdf(table);
  table.fail("layout", "there is no layout '" + table.text("layout") + "'",
             "write tree, or leave it out: a 21-joint humanoid by its lengths");
}

void RobotTable::require_all_read() const {
  for (const auto& [key, entry] : entries_) {
    if (!read_.contains(key)) {
      throw LoadError(path_, entry.line, "nobody reads '" + key + "'",
                      "check its spelling, or remove it");
    }
  }
}

}  // namespace verp::model
