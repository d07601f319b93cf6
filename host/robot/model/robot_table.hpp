#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

namespace verp::model {

/// A `key = value` file: one entry a line, `#` starts a comment. Every key must be read exactly
/// once by the program that uses the table, so that a misspelt one is an error, not a silent
/// default.
class RobotTable {
 public:
  /// Throws LoadError for a missing file, a line that is not `key = value`, or a key given twice.
  explicit RobotTable(const std::string& path);

  /// Throws LoadError when the key is missing, or the value is not one finite number.
  double number(const std::string& key);
  std::string text(const std::string& key);
  /// Of a value in parts, `a | b c | d`: one part, counted from 0, as it stands, or as that many
  /// numbers. Throws LoadError where they are not.
  std::string part(const std::string& key, std::size_t which);
  std::vector<double> numbers(const std::string& key, std::size_t which, std::size_t count);
  bool has(const std::string& key) const { return entries_.contains(key); }
  /// All that begin like this, in the table's order.
  std::vector<std::string> keys(const std::string& beginning) const;
  /// Throws LoadError at the key's line.
  [[noreturn]] void fail(const std::string& key, const std::string& message,
                         const std::string& fix) const;
  /// Throws LoadError naming the first key that nobody read.
  void require_all_read() const;

 private:
  struct Entry {
    std::string value;
    int line = 0;
  };
  std::string path_;
  std::map<std::string, Entry> entries_;
  std::set<std::string> read_;
};

/// `tuning.NAME = VALUE` of a table as a robot's <verp:tuning>.
std::string tuning_lines(RobotTable& table);

/// The SDF text of a 21-DOF humanoid of these proportions. Throws LoadError.
std::string generate_humanoid_sdf(RobotTable& table);
/// The SDF text of a robot whose table lists links and joints one by one. Throws
/// LoadError.
std::string generate_tree_sdf(RobotTable& table);
/// Either: `layout = tree` in the table chooses the second.
std::string generate_sdf(RobotTable& table);

}  // namespace verp::model
