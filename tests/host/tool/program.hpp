#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace verp::tool::test {

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;  ///< -1: killed
  std::string out, err;
};

inline std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The address sanitizer warns at the first change of stacks; no setting prevents it.
inline std::string without_doubts(std::string err) {
  const std::size_t doubt = err.find("WARNING: ASan doesn't fully support makecontext");
  if (doubt == std::string::npos) return err;
  const std::size_t begin = err.rfind('\n', doubt) + 1;
  return err.erase(begin, err.find('\n', doubt) + 1 - begin);
}

class Program : public ::testing::Test {
 protected:
  Program() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              (std::string("verp-tool-") + info->name() + "-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~Program() override { fs::remove_all(folder_); }

  /// As in a shell; `name` separates parallel outputs. By default the twin has a physics step of 2
  /// ms, which takes half the time.
  Outcome verp(const std::string& arguments, const std::string& name = "run") const {
    const auto says = [&](const char* word) { return arguments.find(word) != std::string::npos; };
    const std::string command = arguments.substr(0, arguments.find(' '));
    const bool faster = (command == "walk" || command == "hil") && command != arguments &&
                        !says("--physics-step") && !says("--scenario");
    return as_typed(
        faster ? command + " --physics-step 2" + arguments.substr(command.size()) : arguments,
        name);
  }
  Outcome as_typed(const std::string& arguments, const std::string& name = "run") const {
    return shell(std::string(VERP_PROGRAM) + " " + arguments, name);
  }
  Outcome shell(const std::string& command, const std::string& name = "run") const {
    const fs::path out = folder_ / (name + ".out"), err = folder_ / (name + ".err");
    const std::string line = "cd '" + folder_.string() + "' && ( " + command + " ) >'" +
                             out.string() + "' 2>'" + err.string() + "' </dev/null";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), without_doubts(slurp(err))};
  }

  /// Exit 2, no stdout, one line on stderr with `needle`.
  void expect_refused(const std::string& arguments, const std::string& needle) const {
    const Outcome outcome = as_typed(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << arguments << '\n'
                                                                           << outcome.err;
    EXPECT_NE(outcome.err.find(needle), std::string::npos) << arguments << '\n' << outcome.err;
  }

  fs::path folder_;
};

}  // namespace verp::tool::test
