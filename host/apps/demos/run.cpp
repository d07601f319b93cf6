#include "host/apps/demos/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <numbers>
#include <stdexcept>

#include "host/apps/demos/crew.hpp"
#include "host/robot/model/world.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/session/session.hpp"
#include "host/show/camera/painter.hpp"
#include "host/twin/sim/scenery.hpp"

namespace verp::demos {
namespace {

/// Pictures of the robots' cameras, drawn by another program at the time of exposure.
class Eyes {
 public:
  /// Throws camera::CameraError if that program is not built or there is no OpenGL.
  Eyes(const std::vector<const session::WalkPlan*>& plans, const sim::WorldOptions& world);

  /// Picture of the robot's first camera; empty if another camera was exposed.
  std::optional<camera::Picture> look(const sim::Exposure& exposure);

 private:
  camera::Stage stage_;
  camera::Painter painter_;
};

std::string absolute(const std::string& file) {
  return file.empty() ? "" : std::filesystem::absolute(file).string();
}

camera::Stage stage_of(const std::vector<const session::WalkPlan*>& plans,
                       const sim::WorldOptions& world) {
  camera::Stage stage;
  for (const session::WalkPlan* plan : plans)
    stage.robots.push_back({absolute(plan->entity.file), plan->twin.seed});
  if (world.scenery != nullptr) stage.world_file = absolute(world.scenery->file);
  return stage;
}

Eyes::Eyes(const std::vector<const session::WalkPlan*>& plans, const sim::WorldOptions& world)
    : stage_(stage_of(plans, world)), painter_(camera::find_program(), stage_) {}

std::optional<camera::Picture> Eyes::look(const sim::Exposure& exposure) {
  if (std::find(exposure.cameras.begin(), exposure.cameras.end(), 0u) == exposure.cameras.end())
    return std::nullopt;
  camera::Moment moment;
  moment.time_us = exposure.time_us;
  moment.cameras = {0};
  moment.link_world = exposure.link_world;
  moment.body_world = exposure.body_world;
  moment.robot = static_cast<std::uint32_t>(exposure.robot);
  moment.raw = true;
  for (camera::Picture& picture : painter_.look(moment)) {
    if (picture.encoding == "rgb8") return std::move(picture);
  }
  return std::nullopt;
}

constexpr double kLow_m = 0.03;
constexpr int kCorners = 16;  // of a round shape

using Kind = model::Shape::Kind;

double top_m(const model::Shape& shape) {
  if (shape.kind == Kind::kBox || shape.kind == Kind::kCylinder) return shape.size_m.z() / 2;
  return shape.kind == Kind::kSphere || shape.kind == Kind::kCapsule ? shape.size_m.x() : 0;
}

Outline outline_of(const model::Shape& shape, const model::Transform& pose) {
  Outline out;
  const auto add = [&](double x_m, double y_m) {
    const model::Vec3 at = pose * model::Vec3(x_m, y_m, 0);
    out.corners.push_back({at.x(), at.y()});
  };
  if (shape.kind == Kind::kBox) {
    const double x_m = shape.size_m.x() / 2, y_m = shape.size_m.y() / 2;
    add(x_m, y_m);
    add(-x_m, y_m);
    add(-x_m, -y_m);
    add(x_m, -y_m);
    return out;
  }
  for (int i = 0; i < kCorners; ++i) {
    const double at_rad = 2 * std::numbers::pi * i / kCorners;
    add(shape.size_m.x() * std::cos(at_rad), shape.size_m.x() * std::sin(at_rad));
  }
  return out;
}

/// Outlines, from above, of static objects that reach above 3 cm, a sole's thickness.
std::vector<Outline> outlines_of(const model::World& world) {
  std::vector<Outline> out;
  for (const model::WorldObject& object : world.objects) {
    if (object.kind != model::WorldObject::Kind::kStatic) continue;
    for (const model::WorldCollision& each : object.collisions) {
      const model::Transform pose = object.pose * each.pose;
      const double half_m = top_m(each.shape);
      if (half_m == 0 || pose.translation().z() + half_m < kLow_m) continue;
      out.push_back(outline_of(each.shape, pose));
    }
  }
  return out;
}

constexpr double kAfterFall_s = 0.5;  // shows the outcome in a picture
constexpr double kAfterDone_s = 1.5;
constexpr std::uint32_t kWatchTicks = 5;

class Stage {
 public:
  Stage(const Demo& demo, const Options& options)
      : demo_(demo),
        options_(options),
        session_({.world = world_of(demo, options), .interrupted = options.interrupted}),
        radio_(options.radio, options.seed) {
    const int robots = options.robots > 0 ? options.robots : demo.usual;
    if (robots < demo.fewest || robots > demo.most) {
      throw std::invalid_argument(fmt::format("{}: {} robots; it is for {} to {}", demo.name,
                                              robots, demo.fewest, demo.most));
    }
    for (int i = 0; i < robots; ++i) {
      Member& member = crew_.emplace_back(demo, options, i, robots);
      Member::Look look;
      if (demo.cameras) {
        look = [this](const sim::Exposure& exposure) { return eyes_->look(exposure); };
      }
      session_.add(member.plan(), member.hooks(look));
      radio_.add();
    }
    if (demo.cameras) open_eyes(world_of(demo, options));
    run_.demo = &demo;
    if (session_.scenery() != nullptr) {
      run_.outlines = outlines_of(session_.scenery()->data());
      for (const model::WorldObject* object : model::moving(session_.scenery()->data()))
        run_.things.push_back({object->name, {}});
    }
  }

  Run run() {
    using Clock = std::chrono::steady_clock;
    const auto begun = Clock::now();
    while (!over()) {
      const session::Robot* robot = session_.tick();
      if (robot == nullptr) break;
      ticked(static_cast<int>(session_.index_of(*robot)));
    }
    run_.wall_s = std::chrono::duration<double>(Clock::now() - begun).count();
    return result();
  }

 private:
  static sim::WorldOptions world_of(const Demo& demo, const Options& options) {
    return scenario::world_of({.file = options.world.empty() ? demo.world : options.world,
                               .physics_step_ms = 1e-3 * options.physics_step_us});
  }

  void open_eyes(const sim::WorldOptions& world) {
    std::vector<const session::WalkPlan*> plans;
    for (const Member& member : crew_) plans.push_back(&member.plan());
    eyes_ = std::make_unique<Eyes>(plans, world);
  }

  double now_s() const { return 1e-6 * static_cast<double>(session_.now_us()); }
  double for_s() const { return options_.for_s > 0 ? options_.for_s : demo_.length_s; }

  bool over() {
    if (options_.interrupted && options_.interrupted()) return run_.interrupted = true;
    bool done = true;
    for (const Member& member : crew_) {
      if (member.track().fell_s && now_s() > *member.track().fell_s + kAfterFall_s) return true;
      done = done && member.track().done_s.has_value();
      done = done && now_s() > *member.track().done_s + kAfterDone_s;
    }
    return done || now_s() >= for_s();
  }

  /// After a robot's tick: radio and brain; after the first robot's tick, also the referee.
  void ticked(int number) {
    Member& member = crew_[static_cast<std::size_t>(number)];
    radio_.advance(session_.now_us(), antennas());
    for (radio::ReceivedMessage& heard : radio_.take(number)) {
      member.note_radio("heard", static_cast<std::int64_t>(heard.number), heard.from, number,
                        heard.data);
      member.computer().heard(heard.from, std::move(heard.data));
    }
    if (member.computer().due()) think(number, member);
    if (number == 0 && member.tick() % kWatchTicks == 0) watch();
  }

  void think(int number, Member& member) {
    const brain::Orders& orders = member.computer().think([&](const brain::Senses& senses) {
      if (options_.spy) options_.spy(number, senses);
    });
    for (const brain::ToSay& say : orders.say) {
      const auto count = static_cast<std::int64_t>(radio_.sent());
      const radio::Sent sent = radio_.send(number, say.to, say.data, session_.now_us());
      constexpr const char* kEvents[] = {"said", "too long", "too many", "nobody"};
      const bool went = sent == radio::Sent::kOnItsWay;
      member.note_radio(kEvents[static_cast<int>(sent)], went ? count : -1, number, say.to,
                        say.data);
    }
  }

  std::vector<radio::Place> antennas() {
    std::vector<radio::Place> places;
    for (std::size_t i = 0; i < session_.size(); ++i) {
      const sim::Vec3 at = session_.robot(i).twin().body().link_pose(0).translation();
      places.push_back({at.x(), at.y(), at.z()});
    }
    return places;
  }

  void watch() {
    for (std::size_t i = 0; i < session_.size(); ++i) {
      crew_[i].watch(session_.robot(i).twin(), now_s());
    }
    if (session_.scenery() != nullptr) {
      const std::vector<sim::Transform> poses = session_.scenery()->moving_poses();
      for (std::size_t i = 0; i < run_.things.size(); ++i) {
        const sim::Vec3 at = poses[i].translation();
        run_.things[i].at_m.push_back({at.x(), at.y()});
      }
    }
    if (options_.went_on) options_.went_on(now_s() / for_s());
  }

  Run result() {
    run_.length_s = now_s();
    for (std::size_t i = 0; i < crew_.size(); ++i) {
      crew_[i].close(session_.result(i));
      run_.robots.push_back(crew_[i].track());
    }
    run_.radio.sent = radio_.sent();
    run_.radio.refused = radio_.refused();
    for (const radio::Outcome& each : radio_.take_outcomes())
      ++run_.radio.fates[static_cast<std::size_t>(each.fate)];
    run_.verdict = judged();
    return std::move(run_);
  }

  /// In every demo, a fall is a failure.
  Verdict judged() const {
    Verdict verdict = demo_.judge(run_);
    for (const Track& track : run_.robots) {
      if (track.fell_s)
        verdict.failure = fmt::format("{} fell after {:.1f} s", track.name, *track.fell_s);
    }
    return verdict;
  }

  const Demo& demo_;
  const Options& options_;
  std::deque<Member> crew_;
  session::Session session_;
  radio::Radio radio_;
  std::unique_ptr<Eyes> eyes_;  ///< null: no cameras
  Run run_;
};

}  // namespace

Run run(const Demo& demo, const Options& options) {
  return Stage(demo, options).run();
}

}  // namespace verp::demos
