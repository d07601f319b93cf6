#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/study/signals/column.hpp"
#include "host/trace/record/decisions.hpp"
#include "host/trace/record/joint_speeds.hpp"

namespace verp::signals {

/// A trace's columns, tick by tick: what was measured, and what the controller made of it.
class Table {
 public:
  /// The trace must outlive it. `states`: with every field of the controller's State.
  Table(const record::Trace& trace, bool states);

  const std::vector<Column>& columns() const { return columns_; }
  /// On to the next tick; first of all to the first one. False: there is none.
  bool next();
  std::size_t index() const { return index_; }  ///< of Trace::ticks
  double time_s() const { return numbers_[1]; }
  /// Of this tick. Not a number: not known.
  double number(std::size_t column) const;
  /// The same for CSV: nothing where it is not known.
  void append_text(std::size_t column, std::string& out) const;
  /// The tick from which on this program decided otherwise than the one that recorded the trace:
  /// what the controller made of its inputs is not known.
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
  std::vector<double> numbers_;                             ///< of this tick, without State
  std::vector<std::pair<std::string, std::string>> state_;  ///< its fields; empty: not known
  std::optional<std::uint32_t> other_from_;
};

}  // namespace verp::signals
