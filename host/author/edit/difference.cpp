#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/author/edit/document.hpp"

namespace verp::edit {
namespace {

constexpr std::size_t kAround = 3;              // context lines
constexpr std::size_t kMostCells = 20'000'000;  // above it, all lines are one change

using Lines = std::vector<std::string_view>;

Lines lines_of(const std::string& text) {
  Lines lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(std::string_view(text).substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

struct Row {
  char sign;
  std::string_view line;
};

/// Longest common subsequence between the common ends.
std::vector<Row> rows_of(const Lines& from, const Lines& to) {
  std::vector<Row> rows;
  const std::size_t n = from.size(), m = to.size();
  if ((n + 1) * (m + 1) > kMostCells) {
    for (const auto line : from) rows.push_back({'-', line});
    for (const auto line : to) rows.push_back({'+', line});
    return rows;
  }
  std::vector<std::uint32_t> longest((n + 1) * (m + 1));
  const auto cell = [&](std::size_t i, std::size_t j) -> std::uint32_t& {
    return longest[i * (m + 1) + j];
  };
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = m; j-- > 0;) {
      cell(i, j) =
          from[i] == to[j] ? cell(i + 1, j + 1) + 1 : std::max(cell(i + 1, j), cell(i, j + 1));
    }
  }
  std::size_t i = 0, j = 0;
  while (i < n || j < m) {
    if (i < n && j < m && from[i] == to[j]) {
      rows.push_back({' ', from[i++]}), ++j;
    } else if (j == m || (i < n && cell(i + 1, j) >= cell(i, j + 1))) {
      rows.push_back({'-', from[i++]});
    } else {
      rows.push_back({'+', to[j++]});
    }
  }
  return rows;
}

std::vector<Row> all_rows(const Lines& from, const Lines& to) {
  const auto [a, b] = std::mismatch(from.begin(), from.end(), to.begin(), to.end());
  const auto head = a - from.begin();
  const auto tails =
      std::mismatch(from.rbegin(), from.rend() - head, to.rbegin(), to.rend() - head);
  const auto tail = tails.first - from.rbegin();
  std::vector<Row> rows;
  for (auto line = from.begin(); line != a; ++line) rows.push_back({' ', *line});
  const auto middle = rows_of({a, from.end() - tail}, {b, to.end() - tail});
  rows.insert(rows.end(), middle.begin(), middle.end());
  for (auto line = from.end() - tail; line != from.end(); ++line) rows.push_back({' ', *line});
  return rows;
}

}  // namespace

std::string difference(const std::string& before, const std::string& after,
                       const std::string& file) {
  if (before == after) return "";
  const std::vector<Row> rows = all_rows(lines_of(before), lines_of(after));
  std::string out = "--- " + file + "\n+++ " + file + "\n";
  std::size_t old_line = 1, new_line = 1, done = 0;
  const auto count = [](const Row& row, std::size_t& a, std::size_t& b) {
    a += row.sign != '+', b += row.sign != '-';
  };
  for (std::size_t at = 0; at < rows.size(); ++at) {
    if (rows[at].sign == ' ') continue;
    const std::size_t begin = std::max(done, at - std::min(at, kAround));
    std::size_t end = at, quiet = 0;
    for (; end < rows.size() && quiet <= 2 * kAround; ++end) {
      quiet = rows[end].sign == ' ' ? quiet + 1 : 0;
    }
    end -= quiet > kAround ? quiet - kAround : 0;
    for (; done < begin; ++done) count(rows[done], old_line, new_line);
    std::size_t old_end = old_line, new_end = new_line;
    std::string body;
    for (; done < end; ++done) {
      count(rows[done], old_end, new_end);
      body += rows[done].sign + std::string(rows[done].line) + "\n";
    }
    out += "@@ -" + std::to_string(old_line) + "," + std::to_string(old_end - old_line) + " +" +
           std::to_string(new_line) + "," + std::to_string(new_end - new_line) + " @@\n" + body;
    old_line = old_end, new_line = new_end, at = end - 1;
  }
  return out;
}

}  // namespace verp::edit
