#pragma once
#include <fmt/format.h>

#include <string>

namespace verp::report {

std::string preamble();

/// A named data block with rows of numbers; NaN for missing ones.
class Data {
 public:
  explicit Data(const char* name) { text_ = fmt::format("${} << EOD\n", name); }
  template <class... Numbers>
  Data& row(Numbers... values) {
    (cell(static_cast<double>(values)), ...);
    return end_row();
  }
  Data& cell(double value, int digits = 6) {
    text_ += fmt::format("{:.{}g} ", value, digits);
    return *this;
  }
  Data& label(const std::string& value) {
    text_ += '"' + value + "\" ";
    return *this;
  }
  /// On an empty row also ends a line of points; two empty rows end a data set.
  Data& end_row() {
    text_ += '\n';
    return *this;
  }
  std::string text() const { return text_ + "EOD\n"; }

 private:
  std::string text_;
};

/// A part of a plot: data blocks, and their plot commands.
struct Panel {
  std::string data, commands;
};

/// Keeps the characters that gnuplot accepts inside quotes, because joint names come from a file.
std::string plain(const std::string& name);

}  // namespace verp::report
