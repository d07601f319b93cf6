#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "common/math/elementary.hpp"
#include "tests/exhaustive/functions.hpp"
#include "tests/exhaustive/golden.hpp"

namespace verp::exhaustive {
namespace {

constexpr std::string_view kUsage =
    "usage: verp_exhaustive [--function NAME|all] [--stride N] [--pairs N] [--threads N] [--json]\n"
    "       verp_exhaustive --golden\n"
    "  NAME       sin cos sincos.sin sincos.cos asin acos exp atan2 (default all)\n"
    "  --stride   tests every N-th float of all 2^32 (default 1: every one)\n"
    "  --pairs    stratified argument pairs of atan2 (default 1000000000)\n"
    "  --json     one JSON object on stdout\n"
    "  --golden   prints tests/unit/math/golden.hpp\n"
    "exit 0: within the documented bounds, 1: not, 2: bad usage\n";

struct Options {
  std::string_view function = "all";
  std::uint64_t stride = 1;
  std::uint64_t pairs = 1'000'000'000;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  bool json = false;
};

/// With its arguments: one, or two for atan2.
struct Worst {
  double error_ulp = 0;
  float x = 0;
  float y = 0;
  float result = 0;
};

struct Report {
  std::string_view name;
  double bound_ulp;
  std::uint64_t cases;
  double seconds;
  Worst worst;
  bool good() const { return worst.error_ulp <= bound_ulp; }
};

class Progress {
 public:
  Progress(std::string_view name, std::uint64_t total) : name_(name), total_(total) {}
  void add(std::uint64_t done) {
    const std::uint64_t before = done_.fetch_add(done);
    const std::uint64_t percent = (before + done) * 100 / total_;
    if (!shown_ || before * 100 / total_ == percent) return;
    const std::string bar(percent / 4, '#');
    std::fprintf(stderr, "\r%-10.*s [%-25s] %3d %%", static_cast<int>(name_.size()), name_.data(),
                 bar.c_str(), static_cast<int>(percent));
  }
  ~Progress() {
    if (shown_) std::fprintf(stderr, "\r%60s\r", "");
  }

 private:
  std::string_view name_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_ = 0;
  bool shown_ = isatty(STDERR_FILENO) == 1;
};

/// Calls test(i, worst) for all i below `count`, in blocks over threads.
template <class Test>
Report sweep(std::string_view name, double bound_ulp, std::uint64_t count, unsigned threads,
             Test test) {
  constexpr std::uint64_t kBlock = 1U << 16;
  Progress progress(name, count);
  std::atomic<std::uint64_t> next = 0;
  std::vector<Worst> worst(threads);
  std::vector<std::thread> workers;
  const auto start = std::chrono::steady_clock::now();
  for (Worst& mine : worst) {
    workers.emplace_back([&next, &progress, &mine, count, test] {
      Worst local;
      for (std::uint64_t begin = next.fetch_add(kBlock); begin < count;
           begin = next.fetch_add(kBlock)) {
        const std::uint64_t end = std::min(count, begin + kBlock);
        for (std::uint64_t i = begin; i < end; ++i) test(i, local);
        progress.add(end - begin);
      }
      mine = local;
    });
  }
  for (std::thread& worker : workers) worker.join();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  // Equal errors rank by argument, so the threads do not matter.
  const auto less = [](const Worst& a, const Worst& b) {
    if (a.error_ulp != b.error_ulp) return a.error_ulp < b.error_ulp;
    return std::bit_cast<std::uint32_t>(a.x) > std::bit_cast<std::uint32_t>(b.x);
  };
  return {name, bound_ulp, count, elapsed.count(),
          *std::max_element(worst.begin(), worst.end(), less)};
}

Report run_unary(const UnaryFunction& function, const Options& options) {
  const std::uint64_t stride = options.stride;
  const std::uint64_t count = ((std::uint64_t{1} << 32) + stride - 1) / stride;
  const auto test = [&function, stride](std::uint64_t i, Worst& worst) {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(i * stride));
    const float result = function.tested(x);
    double error = 0;
    float expected = 0;
    if (function.special(x, expected)) {
      if (std::bit_cast<std::uint32_t>(result) != std::bit_cast<std::uint32_t>(expected)) {
        error = std::numeric_limits<double>::infinity();
      }
    } else {
      error = error_ulp(result, function.reference(static_cast<double>(x)));
      if (error > worst.error_ulp) {
        error = fine_error_ulp(result, function.fine_reference(static_cast<long double>(x)));
      }
    }
    if (error > worst.error_ulp) worst = {error, x, 0, result};
  };
  return sweep(function.name, function.bound_ulp, count, options.threads, test);
}

Report run_atan2(const Options& options) {
  const auto test = [](std::uint64_t i, Worst& worst) {
    const Pair pair = stratified_pair(i);
    const float result = math::atan2(pair.y, pair.x);
    double error =
        error_ulp(result, std::atan2(static_cast<double>(pair.y), static_cast<double>(pair.x)));
    if (error > worst.error_ulp) {
      error = fine_error_ulp(
          result, std::atan2(static_cast<long double>(pair.y), static_cast<long double>(pair.x)));
    }
    if (error > worst.error_ulp) worst = {error, pair.x, pair.y, result};
  };
  return sweep("atan2", kAtan2BoundUlp, options.pairs, options.threads, test);
}

void print_line(const Report& report) {
  char where[64];
  if (report.name == "atan2") {
    std::snprintf(where, sizeof where, "(%a, %a)", static_cast<double>(report.worst.y),
                  static_cast<double>(report.worst.x));
  } else {
    std::snprintf(where, sizeof where, "(%a)", static_cast<double>(report.worst.x));
  }
  std::printf("%-10.*s worst %.4f ULP (bound %g) at %s = %a; %llu cases, %.1f s%s\n",
              static_cast<int>(report.name.size()), report.name.data(), report.worst.error_ulp,
              report.bound_ulp, where, static_cast<double>(report.worst.result),
              static_cast<unsigned long long>(report.cases), report.seconds,
              report.good() ? "" : "  TOO FAR");
  std::fflush(stdout);
}

void print_json(const std::vector<Report>& reports) {
  std::printf("{\"functions\": [");
  const char* separator = "";
  for (const Report& report : reports) {
    // JSON has no infinity: -1 marks a wrong special value.
    const double error = std::isfinite(report.worst.error_ulp) ? report.worst.error_ulp : -1.0;
    std::printf(
        "%s\n  {\"name\": \"%.*s\", \"worst_ulp\": %.6f, \"bound_ulp\": %g, \"good\": %s, "
        "\"x_bits\": %u, \"y_bits\": %u, \"cases\": %llu, \"seconds\": %.2f}",
        separator, static_cast<int>(report.name.size()), report.name.data(), error,
        report.bound_ulp, report.good() ? "true" : "false",
        std::bit_cast<std::uint32_t>(report.worst.x), std::bit_cast<std::uint32_t>(report.worst.y),
        static_cast<unsigned long long>(report.cases), report.seconds);
    separator = ",";
  }
  std::printf("\n]}\n");
}

bool parse_count(const char* text, std::uint64_t& value) {
  const char* end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, value);
  return error == std::errc{} && stop == end && value > 0;
}

bool known(std::string_view function) {
  if (function == "all" || function == "atan2") return true;
  return std::any_of(kUnaryFunctions, kUnaryFunctions + kUnaryFunctionCount,
                     [&](const UnaryFunction& f) { return f.name == function; });
}

/// The mistake, or empty.
std::string parse(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view option = argv[i];
    if (option == "--json") {
      options.json = true;
      continue;
    }
    const bool takes_value = option == "--function" || option == "--stride" ||
                             option == "--pairs" || option == "--threads";
    if (!takes_value) return "unknown option " + std::string(option);
    if (++i == argc) return std::string(option) + " needs a value";
    if (option == "--function") {
      options.function = argv[i];
      if (!known(options.function)) return "unknown function " + std::string(options.function);
      continue;
    }
    std::uint64_t value = 0;
    if (!parse_count(argv[i], value)) {
      return std::string(option) + " needs a whole number above 0, not " + argv[i];
    }
    if (option == "--stride") options.stride = value;
    if (option == "--pairs") options.pairs = value;
    if (option == "--threads")
      options.threads = static_cast<unsigned>(std::min<std::uint64_t>(value, 256));
  }
  return {};
}

int run(const Options& options) {
  std::vector<Report> reports;
  const auto add = [&](const Report& report) {
    reports.push_back(report);
    if (!options.json) print_line(report);
  };
  for (int i = 0; i < kUnaryFunctionCount; ++i) {
    const UnaryFunction& function = kUnaryFunctions[i];
    if (options.function == "all" || options.function == function.name) {
      add(run_unary(function, options));
    }
  }
  if (options.function == "all" || options.function == "atan2") add(run_atan2(options));
  if (options.json) print_json(reports);
  return std::all_of(reports.begin(), reports.end(), [](const Report& r) { return r.good(); }) ? 0
                                                                                               : 1;
}

}  // namespace
}  // namespace verp::exhaustive

int main(int argc, char** argv) {
  using namespace verp::exhaustive;
  if (argc == 2 && std::string_view(argv[1]) == "--help") {
    std::fputs(kUsage.data(), stdout);
    return 0;
  }
  if (argc == 2 && std::string_view(argv[1]) == "--golden") {
    print_golden();
    return 0;
  }
  Options options;
  const std::string problem = parse(argc, argv, options);
  if (!problem.empty()) {
    std::fprintf(stderr, "verp_exhaustive: %s; try --help\n", problem.c_str());
    return 2;
  }
  return run(options);
}
