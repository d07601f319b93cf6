#include "host/apps/cli/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace verp::cli {
namespace {

std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replace = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replace, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// The part after the last dot: "half_stance_m" of gait.half_stance_m.
std::string_view last_part(std::string_view word) {
  return word.substr(word.rfind('.') + 1);  // npos + 1 is 0
}

/// Without the unit: "lift" for gait.lift_m.
std::string_view without_unit(std::string_view name) {
  const std::size_t end = name.rfind('_');
  return end == name.npos || name.size() - end > 4 ? name : name.substr(0, end);
}

/// A word without a dot also matches a name's last part.
std::size_t distance_to(std::string_view word, std::string_view name) {
  if (word.find('.') != word.npos) return edit_distance(word, name);
  const std::string_view last = last_part(name);
  return std::min({edit_distance(word, name), edit_distance(word, last),
                   edit_distance(word, without_unit(last))});
}

std::vector<std::string> holding(std::string_view part, const std::vector<std::string>& names) {
  std::vector<std::string> found;
  if (part.size() < 3) return found;
  for (const std::string& name : names) {
    if (last_part(name).find(part) != std::string_view::npos) found.push_back(name);
  }
  return found;
}

/// The only name that begins with the word; empty: none, or several.
std::string begun(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t kLetters = 3;
  const std::size_t first = word.find_first_not_of('-');
  if (first == word.npos || word.size() < first + kLetters) return "";
  const auto begins = [&](const std::string& name) { return name.starts_with(word); };
  if (std::count_if(names.begin(), names.end(), begins) != 1) return "";
  return *std::find_if(names.begin(), names.end(), begins);
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  if (const std::string name = begun(word, names); !name.empty()) return name;
  const std::string* best = nullptr;
  std::size_t best_distance = 3;
  for (const std::string& name : names) {
    if (!word.empty() && name.ends_with("." + std::string(word))) return name;
    const std::size_t distance = distance_to(word, name);
    if (distance < best_distance) best = &name, best_distance = distance;
  }
  return best == nullptr ? "" : *best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t kMostNamed = 5;
  if (const std::string name = nearest(word, names); !name.empty()) {
    return fmt::format("; did you mean {}?", name);
  }
  const std::vector<std::string> found = holding(last_part(word), names);
  if (found.empty() || found.size() > kMostNamed) return "";
  return fmt::format("; did you mean {}?", fmt::join(found, " or "));
}

}  // namespace verp::cli
