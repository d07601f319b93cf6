#include "host/apps/tool/walk_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <thread>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/tool/walk_estimate.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/process/child.hpp"
#include "host/study/survey/interval.hpp"

namespace verp::tool {
namespace {

/// The command line of one walk: the common options and its seed.
std::vector<std::string> words_of(const WalkOptions& options, std::uint64_t seed) {
  std::vector<std::string> words = {"/proc/self/exe", "walk", "--json",
                                    fmt::format("--seed={}", seed)};
  if (options.model_given) words.push_back(options.model);
  for (const auto& [option, value] : options.changed) {
    if (option != "--seeds") words.push_back(value.empty() ? option : option + "=" + value);
  }
  return words;
}

struct Walking {
  std::uint64_t seed;
  std::filesystem::path output;
  std::unique_ptr<process::Child> child;
};

class Seeds {
 public:
  explicit Seeds(const WalkOptions& options) : options_(options), progress_(!options.json) {}

  int run() {
    const auto [first, last] = seeds_of(options_);
    const std::size_t most = std::max(1U, std::thread::hardware_concurrency());
    of_ = last - first + 1;
    for (std::uint64_t next = first; !cli::interrupted() && (next <= last || !walking_.empty());) {
      while (next <= last && walking_.size() < most) start(next++);
      reap();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    progress_.clear();
    tell();
    return cli::interrupted() || survived_ < rows_.size() ? std::max(status_, int{cli::kRunFailed})
                                                          : status_;
  }

 private:
  void start(std::uint64_t seed) {
    const auto output = folder_.path() / std::to_string(seed);
    walking_.push_back(
        {seed, output,
         std::make_unique<process::Child>(process::Command{
             .words = words_of(options_, seed), .input = {}, .output = {.file = output}})});
  }

  void reap() {
    std::erase_if(walking_, [&](Walking& walking) {
      const auto status = walking.child->status();
      if (status) take(walking, *status);
      return status.has_value();
    });
    progress_.show(static_cast<double>(rows_.size()) / static_cast<double>(of_),
                   fmt::format("{} of {} walks, {} survived", rows_.size(), of_, survived_));
  }

  void take(const Walking& walking, int status) {
    const std::string said = files::read(walking.output).value_or("");
    const std::size_t from = std::min(said.find('{'), said.size()), to = said.rfind('}');
    const cli::Json json = cli::Json::parse(
        said.substr(from, to == std::string::npos ? 0 : to + 1 - from), nullptr, false);
    if (status == cli::kBadInput || status == cli::kNoDevice) {  // all walks fail so
      if (status_ == cli::kGood) cli::complain(said);
      status_ = status_ == cli::kGood ? status : status_;
      return;
    }
    if (cli::interrupted()) return;  // so was this walk
    const bool good = status == cli::kGood && json.is_object();
    survived_ += good ? 1 : 0;
    cli::Json row = {{"seed", walking.seed}, {"survived", good}};
    if (!json.is_object() || !json.contains("failure")) {
      row["failure"] =
          fmt::format("its program ended with status {}: {}", status,
                      json.is_object() ? json.value("error", "") : process::last_line(said));
    }
    for (const char* key :
         {"failure", "remark", "fallen", "distance_m", "asked_m", "asked_turn_deg", "ahead_m",
          "lateral_drift_m", "speed_steady_m_s", "yaw_drift_deg", "zmp_bias_mean_mm", "falls",
          "get_ups", "self_contact_ticks", "estimator", "digest", "varied"}) {
      if (json.contains(key)) row[key] = json[key];
    }
    rows_[walking.seed] = row;
  }

  void tell() const {
    cli::Json all = cli::Json::array();
    std::string fell;
    std::vector<double> bias_mm, speed_m_s, went_m, asked_m, turned_deg, asked_deg;
    std::vector<cli::Json> estimates;
    for (const auto& [seed, row] : rows_) {
      all.push_back(row);
      if (row["survived"].get<bool>()) {
        keep(row, "zmp_bias_mean_mm", bias_mm);
        keep(row, "speed_steady_m_s", speed_m_s);
        keep(row, "distance_m", went_m);
        keep(row, "asked_m", asked_m);
        keep(row, "yaw_drift_deg", turned_deg);
        keep(row, "asked_turn_deg", asked_deg);
        if (row.contains("estimator") && row["estimator"].is_object())
          estimates.push_back(row["estimator"]);
      } else {
        fell += fmt::format("  seed {}: {}\n", seed, row["failure"].get<std::string>());
      }
    }
    const survey::Interval interval = survey::interval_of(survived_, rows_.size());
    if (options_.json) {
      cli::print_json({{"model", options_.model},
                       {"of", rows_.size()},
                       {"survived", survived_},
                       {"survived_interval_95", {interval.low, interval.high}},
                       {"interrupted", cli::interrupted()},
                       {"walks", all}});
    } else {
      cli::answer(
          fmt::format("{}: {} of {} {} {:g} s; 95 % interval {:.1f} to {:.1f} %{}\n",
                      options_.model, survived_, rows_.size(), options_.stand ? "stood" : "walked",
                      options_.walk_s, 100 * interval.low, 100 * interval.high,
                      cli::interrupted() ? "; interrupted" : "") +
          of_asked(range("distance, m", went_m, 2), asked_m, 2) +
          (turns(asked_deg) ? of_asked(range("turned, degrees", turned_deg, 0), asked_deg, 0)
                            : "") +
          range("ZMP bias, mm", bias_mm, 1) + range("steady speed, m/s", speed_m_s, 3) +
          estimates_text(estimates) + fell);
    }
  }

  static void keep(const cli::Json& row, const char* key, std::vector<double>& values) {
    if (row.contains(key) && row[key].is_number()) values.push_back(row[key].get<double>());
  }

  static std::string range(const char* name, std::vector<double>& values, int digits) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return fmt::format("  {:<18}{:.{}f} to {:.{}f}, median {:.{}f}\n", name, values.front(), digits,
                       values.back(), digits, values[values.size() / 2], digits);
  }

  /// Adds the median order; a walk that ended early counts a smaller one.
  static std::string of_asked(std::string line, std::vector<double> asked, int digits) {
    if (line.empty() || asked.empty()) return line;
    std::sort(asked.begin(), asked.end());
    line.pop_back();
    return line + fmt::format(" of {:.{}f} asked\n", asked[asked.size() / 2], digits);
  }
  static bool turns(const std::vector<double>& asked_deg) {
    return !asked_deg.empty() && asked_deg.front() != 0;
  }

  const WalkOptions& options_;
  const files::TemporaryDirectory folder_;
  cli::Progress progress_;
  std::vector<Walking> walking_;
  std::map<std::uint64_t, cli::Json> rows_;
  std::uint64_t of_ = 0, survived_ = 0;
  int status_ = cli::kGood;
};

}  // namespace

int walk_seeds(const WalkOptions& options) {
  return Seeds(options).run();
}

}  // namespace verp::tool
