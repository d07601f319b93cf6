#include "host/study/tune/lie_down.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/author/action/compile.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/params.hpp"
#include "host/study/tune/evolution.hpp"
#include "host/study/tune/tune.hpp"
#include "host/twin/sim/vary.hpp"

namespace verp::tune {
namespace {

/// Key frames in a row: seconds on the way; how far the thighs are ahead, the knees bent, the toes
/// up, the arms ahead, in degrees. From common/robots/*/actions/lie_down.action: onto the knees,
/// which are near the floor, and the hands.
constexpr int kKey = 5, kFree = 3 * kKey;
constexpr double kWays[][kFree] = {
    {0.5, 84, 131, 46, 51, 1.0, 108, 131, 73, 73, 1.3, 61, 131, 74, 160},  // generic21
    {0.7, 97, 125, 74, 81, 1.2, 91, 127, 71, 105, 1.3, 72, 115, 74, 134},  // op3
    {0.8, 94, 125, 73, -12, 0.8, 94, 92, 73, 29, 1.2, 92, 109, 73, 103},   // darwin_op
};
/// Then flat, by all of them: the feet slide back.
constexpr double kFlat[][kKey] = {{1.5, 34, 69, -57, 155}, {1.2, 0, 0, -57, 160}};
constexpr double kStep[kKey] = {0.2, 12, 12, 12, 12};  // of the search
constexpr double kTheirLeg_m = 0.186;                  // generic21's, hip to ankle
constexpr double kDegrees = 180 / std::numbers::pi;
using Point = Eigen::VectorXd;  // kFree numbers, in steps

/// Points become an action of this robot.
class Writer {
 public:
  explicit Writer(const model::Entity& entity) : entity_(entity) {
    for (const int side : {0, 1}) {
      const model::Limb& leg = *model::find_limb(entity, side == 0 ? "left_leg" : "right_leg");
      const model::LegGeometry g = model::classify_leg(entity, leg);
      slower_ = std::sqrt((g.thigh_m + g.shank_m) / kTheirLeg_m);
      for (const std::size_t k : {2U, 3U, 4U}) {  // hip, knee, ankle
        const int sign = k == 3 ? g.direction[k] : -g.direction[k];
        turns_.push_back({g.joint[k], k - 1, sign, -g.direction[k] * g.offset_rad[k]});
      }
    }
    add_arms();
  }

  action::Document document(const Point& at) const {
    action::Document document;
    document.name = action::kLieDown;
    document.file = document.name + ".action";
    for (int i = 0; i < kFree; i += kKey) {
      double key[kKey];
      for (int k = 0; k < kKey; ++k) key[k] = kStep[k] * at[i + k];
      document.frames.push_back(frame(key));
    }
    for (const auto& key : kFlat) document.frames.push_back(frame(key));
    document.frames.front().stance = action::Stance::kNone;
    document.frames.front().balance = false;
    document.frames.back().hold_s = 0.3;
    return document;
  }

 private:
  struct Turn {
    int joint;
    std::size_t number;  ///< of a key frame
    int sign;
    double zero_rad;
  };

  /// The first joint about y on each way out from the trunk, beside the middle. Arms hang in the
  /// crouch.
  void add_arms() {
    constexpr double kAlong = 0.9, kBeside_m = 0.01;
    const std::vector<model::Vec3> origins = model::node_origins(entity_);
    std::vector<bool> moved(entity_.nodes.size());
    for (const Turn& turn : turns_) moved[static_cast<std::size_t>(turn.joint) + 1] = true;
    for (const std::size_t j : model::outward(entity_)) {
      const model::Joint& joint = entity_.joints[j];
      if (moved[static_cast<std::size_t>(joint.parent)]) moved[j + 1] = true;
      if (moved[j + 1] || joint.follows >= 0 || std::abs(joint.axis.y()) < kAlong ||
          std::abs(origins[j + 1].y()) < kBeside_m)
        continue;
      moved[j + 1] = true;
      turns_.push_back({static_cast<int>(j), kKey - 1, joint.axis.y() > 0 ? -1 : 1, joint.sit_rad});
    }
  }

  /// Within the joints' limits, in whole degrees.
  action::FrameText frame(const double* key) const {
    action::FrameText frame;
    frame.time_s = std::max(0.2, std::round(100 * slower_ * key[0]) / 100);
    for (std::size_t j = 0; j < entity_.joints.size(); ++j) {
      const model::Joint& joint = entity_.joints[j];
      if (joint.follows >= 0) continue;
      double angle_rad = joint.sit_rad;
      for (const Turn& turn : turns_) {
        if (turn.joint != static_cast<int>(j)) continue;
        angle_rad = turn.zero_rad + turn.sign * key[turn.number] / kDegrees;
      }
      const double angle_deg =
          std::clamp(std::round(kDegrees * angle_rad), std::ceil(kDegrees * joint.lower_rad),
                     std::floor(kDegrees * joint.upper_rad));
      frame.goals.push_back({.joint = joint.name, .angle_rad = angle_deg / kDegrees});
    }
    return frame;
  }

  const model::Entity& entity_;
  std::vector<Turn> turns_;
  double slower_ = 1;
};

std::vector<Point> shipped_ways() {
  std::vector<Point> points;
  for (const auto& way : kWays) {
    points.push_back(Point::Map(way, kFree));
    for (int i = 0; i < kFree; ++i) points.back()[i] /= kStep[i % kKey];
  }
  return points;
}

constexpr double kSpread = 0.7;     // the search's first, in steps of each axis
constexpr double kNoGood = 3;       // more than any good one's badness
constexpr double kWellBelow = 0.9;  // for the judges, of whom one may fall a little more

/// The most free fall that is good counts 1, and so does the most motion without torque.
double badness_of(const action::LetGo& ends) {
  constexpr double kMostFall_percent = 8, kMostMoved_rad = 0.3, kFlat_rad = 1.4;
  const double sum = ends.fall_percent / kMostFall_percent + ends.moved_rad / kMostMoved_rad +
                     std::max(0.0, kFlat_rad - ends.lay_rad);
  return ends.good && ends.by_action ? sum : kNoGood + sum;
}

class Search {
 public:
  Search(const model::Entity& entity, const LieDownOptions& options, const survey::Watch& watch)
      : entity_(entity),
        params_(model::make_params(entity)),
        options_(options),
        watch_(watch),
        writer_(entity) {}

  LieDown run() {
    look(shipped_ways());
    Evolution evolution(best_, kSpread, options_.children, kSearchSeed);
    while (!over()) evolution.tell(look(evolution.ask()));
    return result_;
  }

 private:
  /// Judges the best way, if it is well below what is good, or good at the search's end.
  bool over() {
    const bool last = round_ > options_.generations;
    if (result_.interrupted || least_ >= (last ? kNoGood : kWellBelow))
      return result_.interrupted || last;
    std::vector<std::uint64_t> seeds = {0};
    const std::uint64_t first = kCheckSeed + options_.judges * static_cast<std::uint64_t>(round_);
    while (seeds.size() < options_.judges) seeds.push_back(first + seeds.size());
    result_.document = writer_.document(best_);
    result_.worst = worst_of({result_.document}, seeds).front();
    result_.found = !result_.interrupted && badness_of(result_.worst) < kNoGood;
    least_ = 1e9;  // the next round's best has new judges
    return result_.interrupted || result_.found || last;
  }

  /// Tries each way in the robot as its file has it, and in a random one of this round.
  std::vector<double> look(const std::vector<Point>& ways) {
    if (watch_.went_on) watch_.went_on(round_ / (options_.generations + 1.0));
    std::vector<action::Document> documents;
    for (const Point& at : ways) documents.push_back(writer_.document(at));
    const std::uint64_t seed = kSearchSeed + static_cast<std::uint64_t>(round_++);
    std::vector<double> badness;
    for (const action::LetGo& worst : worst_of(documents, {0, seed})) {
      badness.push_back(badness_of(worst));
      if (badness.back() >= least_) continue;
      least_ = badness.back();
      best_ = ways[badness.size() - 1];
      if (result_.document.frames.empty()) result_.worst = worst;
    }
    return badness;
  }

  /// For each action, of the robots that were let go.
  std::vector<action::LetGo> worst_of(const std::vector<action::Document>& documents,
                                      const std::vector<std::uint64_t>& seeds) {
    std::vector<action::LetGo> ends(documents.size() * seeds.size());
    survey::Watch watch = watch_;
    watch.went_on = {};
    survey::Workers workers(watch, ends.size());
    workers.run(ends.size(), [&](std::size_t i) {
      ends[i] = let_go(documents[i / seeds.size()], seeds[i % seeds.size()]);
    });
    result_.tries += static_cast<int>(ends.size());
    result_.interrupted = result_.interrupted || workers.stopped();
    std::vector<action::LetGo> worst;
    for (auto from = ends.begin(); from != ends.end();) {
      const auto to = from + static_cast<std::ptrdiff_t>(seeds.size());
      worst.push_back(*std::max_element(from, to, [](const auto& one, const auto& other) {
        return badness_of(one) < badness_of(other);
      }));
      from = to;
    }
    return worst;
  }

  /// Seed 0: the robot as its file has it, with the least friction in its gears.
  action::LetGo let_go(const action::Document& document, std::uint64_t seed) const {
    sim::TwinOptions twin;
    twin.seed = seed;
    sim::WorldOptions world;
    world.step_us = 2000;
    sim::Varied robot{entity_, twin, world, {}};
    if (seed != 0) robot = sim::vary(entity_, twin, world);
    session::WalkPlan plan;
    plan.entity = std::move(robot.entity);
    plan.params = params_;
    plan.twin = robot.twin;
    plan.actions = action::make_library(params_, {document}).words;
    if (seed == 0)
      for (model::Joint& joint : plan.entity.joints) sim::scale_friction(-1, joint.servo);
    return action::let_go(std::move(plan), robot.world);
  }

  const model::Entity& entity_;
  const Params params_;
  const LieDownOptions& options_;
  const survey::Watch& watch_;
  const Writer writer_;
  int round_ = 0;
  Point best_;
  double least_ = 1e9;  ///< best_'s badness, until it is judged
  LieDown result_;
};

}  // namespace

LieDown make_lie_down(const model::Entity& entity, const LieDownOptions& options,
                      const survey::Watch& watch) {
  return Search(entity, options, watch).run();
}

}  // namespace verp::tune
