#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

namespace verp::model {

/// `key = value` lines; `#` starts a comment. Every key must be read, so that a misspelt one is an
/// error.
class RobotTable {
 public:
  /// Throws LoadError for a missing file, another line, or a duplicate key.
  explicit RobotTable(const std::string& path);

  /// Throws LoadError if the key is missing, or the value is not one finite number.
  double number(const std::string& key);
  std::string text(const std::string& key);
  /// Part `which` from 0 of `a | b c | d`: text, or `count` numbers. Else throws LoadError.
  std::string part(const std::string& key, std::size_t which);
  std::vector<double> numbers(const std::string& key, std::size_t which, std::size_t count);
  bool has(const std::string& key) const { return entries_.contains(key); }
  /// Keys with this prefix, in table order.
  std::vector<std::string> keys(const std::string& beginning) const;
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

/// SDF of a 21-DOF humanoid of these proportions. Throws LoadError.
std::string generate_humanoid_sdf(RobotTable& table);
/// SDF of a robot whose links and joints are listed one by one. Throws LoadError.
std::string generate_tree_sdf(RobotTable& table);
/// One of the two: `layout = tree` in the table selects the second.
std::string generate_sdf(RobotTable& table);

}  // namespace verp::model
