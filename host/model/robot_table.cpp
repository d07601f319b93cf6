#include "host/model/robot_table.hpp"

#include <fstream>

#include "host/model/load_error.hpp"
#include "host/model/number.hpp"

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

void RobotTable::require_all_read() const {
  for (const auto& [key, entry] : entries_) {
    if (!read_.contains(key)) {
      throw LoadError(path_, entry.line, "nobody reads '" + key + "'",
                      "check its spelling, or remove it");
    }
  }
}

}  // namespace verp::model
