#pragma once
#include <fmt/format.h>

#include <string>

namespace verp::report {

std::string preamble();

/// A named data block; NaN: missing.
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
  /// An empty row ends a line of points, two end a data set.
  Data& end_row() {
    text_ += '\n';
    return *this;
  }
  std::string text() const { return text_ + "EOD\n"; }

 private:
  std::string text_;
};

struct Panel {
  std::string data, commands;
};

/// Joint names come from a file: keeps what gnuplot accepts in quotes.
std::string plain(const std::string& name);

}  // namespace verp::report
