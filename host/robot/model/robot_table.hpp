#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

namespace verp::model {

/// A `key = value` file: one entry per line, `#` starts a comment. The program must read every key,
/// so that a misspelt key is an error, not a silent default.
class RobotTable {
 public:
  /// Throws LoadError for a missing file, a line that is not `key = value`, or a duplicate key.
  explicit RobotTable(const std::string& path);

  /// Throws LoadError if the key is missing, or the value is not one finite number.
  double number(const std::string& key);
  std::string text(const std::string& key);
  /// One part, counted from 0, of a value such as `a | b c | d`: as text, or as `count` numbers.
  /// Throws LoadError if it is not.
  std::string part(const std::string& key, std::size_t which);
  std::vector<double> numbers(const std::string& key, std::size_t which, std::size_t count);
  bool has(const std::string& key) const { return entries_.contains(key); }
  /// All keys with this prefix, in table order.
  std::vector<std::string> keys(const std::string& beginning) const;
  /// Throws LoadError at the key's line.
  [[noreturn]] void fail(const std::string& key, const std::string& message,
                         const std::string& fix) const;
  /// Throws LoadError with the first unread key.
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

/// Converts `tuning.NAME = VALUE` entries to <verp:tuning>.
std::string tuning_lines(RobotTable& table);

/// SDF text of a 21-DOF humanoid with these proportions. Throws LoadError.
std::string generate_humanoid_sdf(RobotTable& table);
/// SDF text of a robot whose table lists links and joints one by one. Throws LoadError.
std::string generate_tree_sdf(RobotTable& table);
/// One of the two: `layout = tree` in the table selects the second.
std::string generate_sdf(RobotTable& table);

}  // namespace verp::model
