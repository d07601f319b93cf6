#pragma once
#include <array>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

/// Plain numbers, shared by bench_core and bench_peers. Only ours is compiled with
/// EIGEN_DONT_VECTORIZE: one program would hold two versions of Eigen's functions under one name.
namespace verp::bench {

inline constexpr int kJoints = 6;  ///< hip to ankle

/// Frames are parallel to the body's with all joints at zero. Rotations are row-major.
struct LegTarget {
  std::array<double, 9> sole_rotation{};  ///< body frame
  std::array<double, 3> sole_m{};
  std::array<double, kJoints> before_rad{};  ///< one tick earlier, a warm start
  std::array<double, kJoints> answer_rad{};  ///< our solver's
};

struct LegProblem {
  std::array<double, 3 * kJoints> origin_m{};  ///< in the previous joint's frame
  std::array<double, 3 * kJoints> axis{};      ///< unit vectors
  std::array<double, 9> foot_sole{};           ///< in the last joint's frame
  std::array<double, 3> foot_sole_m{};
  std::vector<LegTarget> targets;
};

template <class Problem, class Visit>
void for_each_array(Problem& problem, Visit visit) {
  visit(problem.origin_m);
  visit(problem.axis);
  visit(problem.foot_sole);
  visit(problem.foot_sole_m);
  for (auto& target : problem.targets) {
    visit(target.sole_rotation);
    visit(target.sole_m);
    visit(target.before_rad);
    visit(target.answer_rad);
  }
}

inline bool write_problem(const std::string& path, const LegProblem& problem) {
  std::ofstream file(path);
  file.precision(std::numeric_limits<double>::max_digits10);
  file << problem.targets.size() << '\n';
  for_each_array(problem, [&](const auto& numbers) {
    for (const double number : numbers) file << number << ' ';
    file << '\n';
  });
  return file.flush().good();
}

/// False if the file is missing or incomplete.
inline bool read_problem(const std::string& path, LegProblem& problem) {
  std::ifstream file(path);
  std::size_t targets = 0;
  if (!(file >> targets) || targets == 0 || targets > 100000) return false;
  problem.targets.resize(targets);
  for_each_array(problem, [&](auto& numbers) {
    for (double& number : numbers) file >> number;
  });
  return !file.fail();
}

}  // namespace verp::bench
