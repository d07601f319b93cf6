#include "host/apps/demos/together.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/apps/demos/brain/column.hpp"
#include "host/apps/demos/brain/follow.hpp"
#include "host/apps/demos/judge.hpp"

namespace verp::demos {
namespace {

constexpr double kLeads_m_s = 0.12;
constexpr double kGuides_m_s = 0.11;

std::string trouble_of(const Run& run) {
  for (const Track& track : run.robots) {
    if (track.touches > 0) return fmt::format("{} touched something", track.name);
    if (!track.done_s) return fmt::format("{} was not done in {:.0f} s", track.name, run.length_s);
  }
  return "";
}

std::vector<brain::Pose> one_behind_another(int robots) {
  std::vector<brain::Pose> places;
  for (int i = 0; i < robots; ++i) places.push_back({{-brain::kGap_m * i, 0}, 0});
  return places;
}

Verdict judge_follow(const Run& run) {
  constexpr double kOff_rms_m = 0.15, kOff_m = 0.35, kNear_m = 0.45, kFar_m = 1.25;
  Verdict verdict;
  verdict.failure = trouble_of(run);
  const std::vector<brain::Point> leader = smooth(run.robots.front());
  std::vector<brain::Point> points = {{-brain::kGap_m * static_cast<double>(run.robots.size()), 0}};
  points.insert(points.end(), leader.begin(), leader.end());
  const Line line(points);
  verdict.facts.push_back({"leader's way", way_m(run.robots.front()), "m"});
  std::vector<brain::Point> ahead = leader;
  for (std::size_t i = 1; i < run.robots.size(); ++i) {
    const std::vector<brain::Point> own = smooth(run.robots[i]);
    std::vector<double> off_m, gap_m;
    for (std::size_t k = 0; k < own.size(); ++k) {
      off_m.push_back(line.off_m(own[k]));
      gap_m.push_back(distance(own[k], ahead[k]));
    }
    const Spread off = spread_of(off_m), gap = spread_of(gap_m);
    const std::string& name = run.robots[i].name;
    verdict.facts.push_back({name + " beside the leader's way, rms", off.rms, "m"});
    verdict.facts.push_back({name + " at most", off.worst, "m"});
    verdict.facts.push_back({name + " behind the one ahead, least", gap.least, "m"});
    verdict.facts.push_back({name + " behind the one ahead, most", gap.worst, "m"});
    if (verdict.failure.empty() && (off.rms > kOff_rms_m || off.worst > kOff_m))
      verdict.failure = fmt::format("{} left the leader's way", name);
    if (verdict.failure.empty() && (gap.least < kNear_m || gap.worst > kFar_m))
      verdict.failure = fmt::format("{} did not keep its distance", name);
    ahead = own;
  }
  return verdict;
}

std::vector<brain::Pose> column_places(int robots) {
  std::vector<brain::Pose> places;
  for (int i = 0; i < robots; ++i) {
    const brain::Slot slot = brain::column_slot(i);
    places.push_back({{-slot.back_m, slot.left_m}, 0});
  }
  return places;
}

Verdict judge_column(const Run& run) {
  constexpr double kRms_m = 0.12, kWorst_m = 0.3;
  Verdict verdict;
  verdict.failure = trouble_of(run);
  const std::vector<brain::Point> guide = smooth(run.robots.front());
  const Line line(guide);
  verdict.facts.push_back({"guide's way", line.long_m(), "m"});
  verdict.facts.push_back({"guide turned",
                           brain::wrapped(run.robots.front().moments.back().real.yaw_rad -
                                          run.robots.front().moments.front().real.yaw_rad),
                           "rad"});
  for (std::size_t i = 1; i < run.robots.size(); ++i) {
    const brain::Slot slot = brain::column_slot(static_cast<int>(i));
    const std::vector<brain::Point> own = smooth(run.robots[i]);
    std::vector<double> off_m;
    for (std::size_t k = 0; k < own.size(); ++k) {
      const brain::Pose place = line.at(line.along_m(k) - slot.back_m);
      off_m.push_back(distance(own[k], out_of(place, brain::Point{0, slot.left_m})));
    }
    const Spread off = spread_of(off_m);
    const std::string& name = run.robots[i].name;
    verdict.facts.push_back({name + " from its place, rms", off.rms, "m"});
    verdict.facts.push_back({name + " at most", off.worst, "m"});
    verdict.facts.push_back({name + " odometry's drift", drift_m(run.robots[i]), "m"});
    if (verdict.failure.empty() && (off.rms > kRms_m || off.worst > kWorst_m))
      verdict.failure = fmt::format("{} did not keep its place", name);
  }
  return verdict;
}

}  // namespace

Demo follow_demo() {
  constexpr double kLength_s = 55;
  return {.name = "follow",
          .what = "one leads, the others follow by laser and radio",
          .criterion =
              "all arrive; nobody falls or touches; each within 0.15 m (rms) and 0.35 m of "
              "the leader's way, 0.45 to 1.25 m behind the one ahead",
          .fewest = 2,
          .usual = 3,
          .most = 8,
          .length_s = kLength_s,
          .places = one_behind_another,
          .brain =
              [](const brain::About& about) {
                return about.number == 0 ? brain::make_leader(about, kLeads_m_s)
                                         : brain::make_follower(about);
              },
          .judge = judge_follow};
}

Demo column_demo() {
  constexpr double kLength_s = 60;
  return {.name = "column",
          .what = "a column two abreast walks and wheels to the left",
          .criterion =
              "all arrive; nobody falls or touches; each within 0.12 m (rms) and 0.3 m of "
              "its place",
          .fewest = 2,
          .usual = 4,
          .most = 8,
          .length_s = kLength_s,
          .places = column_places,
          .brain =
              [](const brain::About& about) {
                return about.number == 0 ? brain::make_guide(about, kGuides_m_s)
                                         : brain::make_file(about);
              },
          .judge = judge_column};
}

}  // namespace verp::demos
