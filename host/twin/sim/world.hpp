#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/world.hpp"

/// ODE in double precision, stepped by the calling thread at a fixed interval: equal calls give
/// equal bits.
namespace verp::sim {

using model::Mat3;
using model::Transform;
using model::Vec3;

struct Surface {
  double friction = 1.0;
  double stiffness_n_m = 5e4;
  double damping_n_s_m = 500;
  double restitution = 0;  ///< the larger of two counts; a soft surface absorbs it
};

inline constexpr int kScenery = -1;

/// Owner of a geometry: a number from World::new_owner(), or kScenery.
struct GeomTag {
  int owner = kScenery;
  int node = 0;  ///< link of the owner's Entity
  Surface surface;
  /// The owner's links that never collide with it, bit n: link n. Scenery never collides with
  /// itself.
  std::uint64_t passes = 0;

  bool collides_with(const GeomTag& other) const {
    if (owner != other.owner) return true;
    return owner != kScenery && node != other.node && (passes >> other.node & 1) == 0;
  }
};

/// A contact point of the last step, seen by one partner.
struct Contact {
  int owner = kScenery;
  int node = 0;
  int other_owner = kScenery;
  int other_node = 0;
  Vec3 position_world_m = Vec3::Zero();
  Vec3 force_world_n = Vec3::Zero();  ///< on the owner
};

class Scenery;

/// A ray ignores the shapes of one link.
struct RayFilter {
  int owner = kScenery - 1;
  int node = 0;
};

class Actor {
 public:
  virtual ~Actor() = default;
  virtual void before_step(double step_s) = 0;
  virtual void after_step(double step_s) = 0;
  /// Empty for objects that are not robots.
  virtual std::vector<Transform> link_poses() const { return {}; }
};

/// A single bus advances the world itself; with several, a coordinator steps it once for all.
class TimeSource {
 public:
  virtual ~TimeSource() = default;
  /// Returns after all whole steps that end by time_us.
  virtual void advance_to(std::uint64_t time_us) = 0;
};

/// A speed overflowed; the world that threw this cannot continue.
class Diverged : public std::runtime_error {
 public:
  Diverged(double at_s, double step_s, const std::string& why)
      : std::runtime_error("physics diverged " + std::to_string(at_s).substr(0, 6) +
                           " s after its start, in steps of " +
                           std::to_string(1e3 * step_s).substr(0, 4) +
                           " ms; smaller ones may hold, or a push, or gains, masses or "
                           "inertias of the robot's file are beyond any (" +
                           why + ")") {}
};

struct WorldOptions {
  std::uint32_t step_us = 1000;
  double gravity_m_s2 = 9.80665;
  Vec3 up = Vec3::UnitZ();  ///< opposite to gravity, in the floor's frame, so a tilted up is a
                            ///< tilted floor
  bool ground = true;       ///< the plane z = 0
  Surface ground_surface{
      .friction = 1.0, .stiffness_n_m = 0, .damping_n_s_m = 0};  ///< 0 stiffness: rigid
  /// A world file, including its ground; null: none. gravity_m_s2 still holds.
  std::shared_ptr<const model::World> scenery = {};
};

class World final : public TimeSource {
 public:
  explicit World(const WorldOptions& options = {});
  ~World() override;
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::uint64_t now_us() const { return now_us_; }
  double step_s() const { return static_cast<double>(options_.step_us) * 1e-6; }
  const WorldOptions& options() const { return options_; }

  /// Runs the whole steps that end by time_us; never goes back.
  void advance_to(std::uint64_t time_us) override;

  const std::vector<Contact>& contacts() const { return contacts_; }

  int new_owner() { return owners_++; }
  /// Actors act in this order, and remove themselves before their end.
  void add(Actor& actor) { actors_.push_back(&actor); }
  void remove(Actor& actor) { std::erase(actors_, &actor); }
  const std::vector<Actor*>& actors() const { return actors_; }

  /// The tag lives as long as the world; the geometry then collides.
  GeomTag& tag(dGeomID geom, const GeomTag& tag);
  /// A shape without a body; the caller sets its pose.
  dGeomID make_shape(const model::Collision& collision);

  dWorldID ode_world() const { return world_; }
  dSpaceID ode_space() const { return space_; }
  Scenery* scenery() { return scenery_.get(); }
  const Scenery* scenery() const { return scenery_.get(); }
  /// Distance to the first shape within range_m.
  std::optional<double> ray_m(const Vec3& from_world_m, const Vec3& direction_world, double range_m,
                              const RayFilter& filter = {}) const;
  /// Highest surface below 1.5 m within around_m: where a robot can stand.
  double height_m(double x_m, double y_m, double around_m) const;
  /// From the next step on; the direction stays.
  void set_gravity(double gravity_m_s2);
  /// Null: no plane.
  GeomTag* ground_tag() { return ground_; }

 private:
  static void near_callback(void* self, dGeomID a, dGeomID b);
  void collide(dGeomID a, dGeomID b);
  void step();
  void step_once();
  void read_contacts();

  struct Touching {
    const GeomTag* first;
    const GeomTag* second;
    Vec3 position_world_m;
  };

  WorldOptions options_;
  dWorldID world_;
  dThreadingImplementationID threading_;
  dSpaceID space_;
  dJointGroupID contact_group_;
  std::uint64_t now_us_ = 0;
  bool diverged_ = false;
  int owners_ = 0;
  std::vector<Actor*> actors_;
  std::deque<GeomTag> tags_;
  GeomTag* ground_ = nullptr;
  std::unique_ptr<Scenery> scenery_;
  std::vector<Touching> touching_;
  std::deque<dJointFeedback> feedback_;  // a deque: ODE points to its elements during the step
  std::vector<Contact> contacts_;
};

}  // namespace verp::sim
