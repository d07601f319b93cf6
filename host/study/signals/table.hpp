#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/model/params.hpp"
#include "host/trace/record/decisions.hpp"
#include "host/trace/record/joint_speeds.hpp"

/// A row per tick, a column per signal.
namespace verp::signals {

enum class Format : std::uint8_t {
  kWhole,
  kFixed4,
  kFixed6,
  kDigits5,  ///< five significant digits
  kDigits6,
  kState,  ///< a field of State
};

/// SI units; sensor axes are those of the IMU.
struct Column {
  std::string name;     ///< may contain a joint name from a file
  std::string unit;     ///< empty: no unit
  std::string subject;  ///< same for measured and goal of a joint
  Format format = Format::kWhole;
};

/// Columns in CSV order; `states` adds all fields of State.
std::vector<Column> columns_of(const Params& params, bool states);

/// The column of that name, else all that match with `*` and `?`.
std::vector<std::size_t> matching(const std::vector<Column>& columns, std::string_view pattern);

/// Measurements and the controller's results, tick by tick.
class Table {
 public:
  /// The trace must outlive it.
  Table(const record::Trace& trace, bool states);

  const std::vector<Column>& columns() const { return columns_; }
  /// Moves to the next tick, at first to the first one. False: there is none.
  bool next();
  std::size_t index() const { return index_; }  ///< in Trace::ticks
  double time_s() const { return numbers_[1]; }
  /// NaN: unknown.
  double number(std::size_t column) const;
  /// CSV: empty if unknown.
  void append_text(std::size_t column, std::string& out) const;
  /// From here on this program decides differently from the recording one, and results are unknown.
  const std::optional<std::uint32_t>& other_from() const { return other_from_; }

 private:
  void read(const TickRecord& record);
  void read_decisions(const Outputs* made);
  void read_estimates(const State* state);

  const record::Trace& trace_;
  const bool states_;
  std::vector<Column> columns_;
  record::Decisions decisions_;
  record::JointSpeeds speeds_;
  std::size_t index_ = 0, next_ = 0;
  std::vector<double> numbers_;                             ///< of this tick
  std::vector<std::pair<std::string, std::string>> state_;  ///< empty: unknown
  std::optional<std::uint32_t> other_from_;
};

}  // namespace verp::signals
