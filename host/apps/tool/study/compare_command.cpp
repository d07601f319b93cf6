#include <CLI/CLI.hpp>

#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/study/commands.hpp"
#include "host/study/compare/page.hpp"
#include "host/study/compare/words.hpp"

namespace verp::tool {
namespace {

struct CompareWords {
  std::string a, b, folder;
  std::optional<double> shift_s;
  double within_ms = 200;
  bool json = false, recover = false;
};

record::Trace read(const CompareWords& words, const std::string& file) {
  record::Trace trace =
      record::read_trace(file, words.recover ? record::Read::kRecover : record::Read::kStrict);
  if (!trace.warning.empty()) cli::complain(trace.warning);
  return trace;
}

cli::Json number(const std::optional<double>& value, double factor = 1) {
  return value ? cli::Json(factor * *value) : cli::Json();
}

cli::Json json_of(const CompareWords& words, const compare::Comparison& c) {
  using compare::kDegrees;
  cli::Json joints = cli::Json::array();
  for (const compare::JointResult& each : c.joints) {
    joints.push_back({{"joint", each.name},
                      {"error_rms_deg", kDegrees * each.error_rms_rad},
                      {"error_max_deg", kDegrees * each.error_most_rad},
                      {"error_max_at_s", each.error_most_s},
                      {"offset_deg", kDegrees * each.offset_rad},
                      {"delay_ms", number(each.delay_s, 1e3)},
                      {"no_delay", each.no_delay},
                      {"left_rms_deg", number(each.left_rad, kDegrees)},
                      {"gain", number(each.gain)},
                      {"phase_lag_deg", number(each.phase_lag_rad, kDegrees)}});
  }
  return {{"a", words.a},
          {"b", words.b},
          {"aligned", compare::name_of(c.alignment)},
          {"shift_s", c.shift_s},
          {"from_s", c.from_s},
          {"to_s", c.to_s},
          {"delay_ms", number(c.delay_s, 1e3)},
          {"error_rms_deg", kDegrees * c.error_rms_rad},
          {"gait_hz", number(c.gait_hz)},
          {"joints", joints},
          {"notes", c.notes}};
}

int run_compare(const CompareWords& words) {
  const record::Trace a = read(words, words.a), b = read(words, words.b);
  const compare::Comparison comparison =
      compare::compare(a, b, {.most_delay_s = 1e-3 * words.within_ms, .shift_s = words.shift_s});
  cli::Json json = json_of(words, comparison);
  std::string text = "A " + words.a + "\nB " + words.b + '\n' + compare::text_of(comparison);
  if (!words.folder.empty()) {
    const compare::WrittenPage written = compare::write_page(words.folder, a, b, comparison);
    if (!written.note.empty()) cli::complain(written.page.string() + ": " + written.note);
    json["page"] = written.page.string();
    text += written.page.string() + '\n';
  }
  cli::print_answer(words.json, json, text);
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_compare(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "compare");
  auto words = std::make_shared<CompareWords>();
  app->add_option("A", words->a, "a trace, such as the twin's")->required();
  app->add_option("B", words->b, "the trace to hold against it, such as the robot's")->required();
  app->add_option("-o,--report", words->folder,
                  "write a page with pictures, and the numbers as CSV, into this folder");
  app->add_option(
         "--shift", words->shift_s,
         "B's clock shows this much more than A's, s; default: found from where both begin "
         "to walk or act")
      ->check(cli::number_between(-86400, 86400, "s"));
  app->add_option("--within", words->within_ms,
                  "look for delays up to this, ms; less than half of what repeats itself")
      ->check(cli::number_between(1, 5000, "ms"))
      ->capture_default_str();
  app->add_flag("--recover", words->recover, "take what stands before a truncation or damage");
  cli::add_json_flag(*app, words->json);
  return {app, [words] { return run_compare(*words); }};
}

}  // namespace verp::tool
