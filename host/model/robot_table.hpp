#pragma once
#include <map>
#include <set>
#include <string>

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

/// The SDF text of a 21-DOF humanoid of these proportions. Throws LoadError.
std::string generate_humanoid_sdf(RobotTable& table);

}  // namespace verp::model
