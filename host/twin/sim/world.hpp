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

/// The physics engine: ODE in double precision. Only the calling thread steps it, by dWorldStep at
/// a fixed interval. The state is a function of the calls alone, so two equal runs are equal to the
/// last bit.
namespace verp::sim {

using model::Mat3;
using model::Transform;
using model::Vec3;

struct Surface {
  double friction = 1.0;
  double stiffness_n_m = 5e4;
  double damping_n_s_m = 500;
  double restitution = 0;  ///< of speed; the larger of two surfaces counts. A soft surface absorbs
                           ///< it
};

inline constexpr int kScenery = -1;

/// Owner of a geometry: a number from World::new_owner(), or kScenery.
struct GeomTag {
  int owner = kScenery;
  int node = 0;  ///< link index of the owner's Entity
  Surface surface;
  /// Links of the same owner that never collide with it, bit n: link n. Scenery never collides with
  /// itself.
  std::uint64_t passes = 0;

  bool collides_with(const GeomTag& other) const {
    if (owner != other.owner) return true;
    return owner != kScenery && node != other.node && (passes >> other.node & 1) == 0;
  }
};

/// One contact point of the last step, seen by one of its partners.
struct Contact {
  int owner = kScenery;
  int node = 0;
  int other_owner = kScenery;
  int other_node = 0;
  Vec3 position_world_m = Vec3::Zero();
  Vec3 force_world_n = Vec3::Zero();  ///< on the owner
};

class Scenery;

/// The shapes that a ray ignores: those of one link.
struct RayFilter {
  int owner = kScenery - 1;
  int node = 0;
};

/// An object that acts in every physics step, for example a robot.
class Actor {
 public:
  virtual ~Actor() = default;
  virtual void before_step(double step_s) = 0;
  virtual void after_step(double step_s) = 0;
  /// Poses of the robot's links; empty for objects that are not robots.
  virtual std::vector<Transform> link_poses() const { return {}; }
};

/// Advances a world's time. A single bus advances the world itself; with several, a coordinator
/// steps the world once for all.
class TimeSource {
 public:
  virtual ~TimeSource() = default;
  /// Returns when the world has done all whole steps that end at or before time_us.
  virtual void advance_to(std::uint64_t time_us) = 0;
};

/// The solver gave up because a speed overflowed. The world that threw it cannot continue.
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
  Vec3 up = Vec3::UnitZ();  ///< opposite to gravity; the world's frame is the floor's, so a tilted
                            ///< up is a tilted floor
  bool ground = true;       ///< the plane z = 0
  Surface ground_surface{
      .friction = 1.0, .stiffness_n_m = 0, .damping_n_s_m = 0};  ///< 0 stiffness: rigid
  /// Contents of a world file, including its ground; null: none. gravity_m_s2 above still holds.
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

  /// Runs whole steps up to the last one that ends at or before time_us; never goes back.
  void advance_to(std::uint64_t time_us) override;

  const std::vector<Contact>& contacts() const { return contacts_; }

  int new_owner() { return owners_++; }
  /// Actors act in the order in which they were added. An actor must remove itself before its end.
  void add(Actor& actor) { actors_.push_back(&actor); }
  void remove(Actor& actor) { std::erase(actors_, &actor); }
  const std::vector<Actor*>& actors() const { return actors_; }

  /// Attaches a tag that lives as long as the world, and lets the geometry collide.
  GeomTag& tag(dGeomID geom, const GeomTag& tag);
  /// A shape in this world's space, not attached to a body; the caller sets its pose.
  dGeomID make_shape(const model::Collision& collision);

  dWorldID ode_world() const { return world_; }
  dSpaceID ode_space() const { return space_; }
  /// Null: the world has no scenery.
  Scenery* scenery() { return scenery_.get(); }
  const Scenery* scenery() const { return scenery_.get(); }
  /// Distance to the first shape in that direction; nothing if none is within range_m.
  std::optional<double> ray_m(const Vec3& from_world_m, const Vec3& direction_world, double range_m,
                              const RayFilter& filter = {}) const;
  /// Height of the highest surface below 1.5 m within around_m: where a robot can be put down.
  double height_m(double x_m, double y_m, double around_m) const;
  /// From the next step on; the direction stays.
  void set_gravity(double gravity_m_s2);
  /// Tag of the plane z = 0; null: no plane.
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
  std::deque<dJointFeedback>
      feedback_;  // a deque: ODE keeps pointers to its elements during the step
  std::vector<Contact> contacts_;
};

}  // namespace verp::sim
