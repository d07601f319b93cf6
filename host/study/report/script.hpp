#pragma once
#include <fmt/format.h>

#include <string>

/// Pieces of gnuplot scripts.
namespace verp::report {

/// The look shared by all pictures.
std::string preamble();

/// A named data block; rows of numbers, NaN where there is none.
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
  /// Also ends a line of points when the row is empty; two empty rows end a data set.
  Data& end_row() {
    text_ += '\n';
    return *this;
  }
  std::string text() const { return text_ + "EOD\n"; }

 private:
  std::string text_;
};

/// Part of a picture: data blocks, and the commands that plot them.
struct Panel {
  std::string data, commands;
};

/// Joint names come from a file: keeps what gnuplot takes as plain text inside quotes.
std::string plain(const std::string& name);

}  // namespace verp::report
