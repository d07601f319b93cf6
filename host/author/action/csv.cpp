#include "host/author/action/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "host/author/action/frames.hpp"
#include "host/author/action/words.hpp"

namespace verp::action {
namespace {

std::vector<std::string> cells_of(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != ' ' && c != '"') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

std::string to_csv(const Params& params, const CompiledActions& made, int number) {
  const Library library = made.library();
  const Action& own = library.action(number);
  std::string text = "time_s,hold_s";
  for (int j = 0; j < params.joint_count; ++j) text += std::string(",") + params.joint[j].name;
  text += "\n";
  for (int i = own.first; i < own.first + own.frames; ++i) {
    const Frame& frame = library.frame(i);
    text += fmt::format("{:g},{:g}", 1e-3 * frame.time_ms, 1e-3 * frame.pause_ms);
    for (int j = 0; j < params.joint_count; ++j) {
      const bool goes = (frame.joints >> j & 1U) != 0;
      text += goes ? fmt::format(",{:.4f}", 1e-4 * frame.goal_tenth_mrad[j]) : ",";
    }
    text += "\n";
  }
  return text;
}

std::string not_in_csv(const Document& document) {
  const auto any = [&](const auto& has) {
    return std::any_of(document.frames.begin(), document.frames.end(), has);
  };
  const std::pair<const char*, bool> parts[] = {
      {"note", !document.note.empty()},
      {"link", document.link.has_value()},
      {"page", document.page.has_value()},
      {"labels", any([](const FrameText& each) { return !each.label.empty(); })},
      {"interpolation", any([](const FrameText& each) { return each.smooth == false; })},
      {"balance", any([](const FrameText& each) { return each.balance.has_value(); })},
      {"stance", any([](const FrameText& each) { return each.stance.has_value(); })},
      {"stiffness", any([](const FrameText& each) { return !each.stiffness.empty(); })},
      {"exits", any([](const FrameText& each) { return each.exit.has_value(); })},
      {"conditions", any([](const FrameText& each) { return each.wait.has_value(); })},
      {"repeats", any([](const FrameText& each) { return each.repeat.has_value(); })},
  };
  std::string text;
  for (const auto& [name, is_there] : parts) {
    if (is_there) text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

Document from_csv(const Params& params, const std::filesystem::path& file, const std::string& text,
                  const std::string& name) {
  Document document;
  document.file = file;
  document.name = name;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> columns = cells_of(line);
  const auto fail = [&](int number, const std::string& what, const std::string& fix) {
    throw model::LoadError(file.string(), number, what, fix);
  };
  if (columns.size() < 3 || columns[0] != "time_s" || columns[1] != "hold_s") {
    fail(1, "is no table of key frames", "begin with: time_s,hold_s,JOINT,...");
  }
  for (auto column = columns.begin(); column != columns.end(); ++column) {
    if (std::find(columns.begin(), column, *column) == column) continue;
    fail(1, "a second column '" + *column + "'", "give each joint one");
  }
  for (std::size_t i = 2; i < columns.size(); ++i) joint_named(params, columns[i], file, 1);
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (cells.size() != columns.size()) {
      fail(number, fmt::format("{} cells, the first line has {}", cells.size(), columns.size()),
           "give one for each column");
    }
    FrameText frame;
    frame.line = number;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 1 && cells[i].empty()) continue;
      const std::optional<double> value = Words::number_in(cells[i]);
      const double low = i == 0 ? 1e-3 * kLeastFrame_ms : i == 1 ? 0.0 : -6.3;
      const double high = i < 2 ? 60.0 : 6.3;
      if (!value || *value < low || *value > high) {
        fail(number,
             fmt::format("'{}' in column '{}' is no number of {:g} to {:g}", cells[i], columns[i],
                         low, high),
             "give seconds, and angles in radians");
      }
      if (i == 0) frame.time_s = *value;
      if (i == 1) frame.hold_s = *value;
      if (i > 1) frame.goals.push_back({columns[i], false, *value, number});
    }
    document.frames.push_back(frame);
  }
  if (document.frames.empty()) fail(1, "has no key frame", "give a line for each");
  return document;
}

}  // namespace verp::action
