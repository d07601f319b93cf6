#include "host/twin/sim/world.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <utility>
#include <vector>

#include "host/twin/sim/ode_parts.hpp"
#include "host/twin/sim/scenery.hpp"
#include "host/twin/sim/solver.hpp"

namespace verp::sim {
namespace {

/// Replaces ODE's exit from the program.
struct OdeGaveUp : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// Drops messages: nobody can act on problems after which ODE continues.
void say_nothing(int, const char*, va_list) {}
[[noreturn]] void give_up(int, const char* text, va_list arguments) {
  char said[256];
  std::vsnprintf(said, sizeof said, text, arguments);
  throw OdeGaveUp(said);
}

struct OdeRuntime {
  OdeRuntime() {
    solver_loops();  // else the linker leaves them out
    dInitODE2(0);
    dSetErrorHandler(give_up);
    dSetDebugHandler(give_up);
    dSetMessageHandler(say_nothing);
  }
  ~OdeRuntime() { dCloseODE(); }
};

/// Cannot be destroyed: ODE was left in the middle of a step, with pending jobs.
void keep(dWorldID world, dThreadingImplementationID threading) {
  static std::mutex mutex;
  static auto& kept = *new std::vector<std::pair<dWorldID, dThreadingImplementationID>>;
  const std::lock_guard lock(mutex);
  kept.emplace_back(world, threading);
}

/// Per pair of geometries; a box on a plane has four, and more would slow the solver.
constexpr int kMaxContacts = 8;

/// Error reduction per step and softness (CFM). ODE's default; and so small that no joint visibly
/// gives way, but singular configurations still factorise.
constexpr double kErrorReduction = 0.2;
constexpr double kConstraintSoftness = 1e-9;
/// Limits ODE's correction of penetration, so that a bad start does not throw the robot into the
/// air.
constexpr double kMaxCorrectingVelocity = 1.0;
/// Slower impacts do not bounce: gravity's gain in 2 ms. Otherwise things never rest.
constexpr double kLeastBounce_m_s = 0.02;

/// Springs in series; stiffness 0: rigid.
Surface combine(const Surface& a, const Surface& b) {
  Surface both;
  both.friction = std::min(a.friction, b.friction);
  both.restitution = std::max(a.restitution, b.restitution);
  if (a.stiffness_n_m > 0 && b.stiffness_n_m > 0) {
    both.stiffness_n_m = 1.0 / (1.0 / a.stiffness_n_m + 1.0 / b.stiffness_n_m);
    both.damping_n_s_m = a.damping_n_s_m + b.damping_n_s_m;
  } else {
    const Surface& soft = a.stiffness_n_m > 0 ? a : b;
    both.stiffness_n_m = soft.stiffness_n_m;
    both.damping_n_s_m = soft.damping_n_s_m;
  }
  return both;
}

/// ODE manual, "Joint error and the error reduction parameter": an implicit spring and damper.
void set_surface(dSurfaceParameters& out, const Surface& surface, double step_s) {
  out.mode = dContactApprox1;
  out.mu = surface.friction;
  if (surface.restitution > 0) {
    out.mode |= dContactBounce;
    out.bounce = surface.restitution;
    out.bounce_vel = kLeastBounce_m_s;
  }
  if (surface.stiffness_n_m <= 0) return;
  const double spring = step_s * surface.stiffness_n_m;
  out.mode |= dContactSoftERP | dContactSoftCFM;
  out.soft_erp = spring / (spring + surface.damping_n_s_m);
  out.soft_cfm = 1.0 / (spring + surface.damping_n_s_m);
}

}  // namespace

World::World(const WorldOptions& options) : options_(options) {
  static const OdeRuntime runtime;
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  world_ = dWorldCreate();
  // Own threading: worlds without it share ODE's, which two threads must not step at a time.
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_),
                                       threading_);
  space_ = dSimpleSpaceCreate(nullptr);
  contact_group_ = dJointGroupCreate(0);
  set_gravity(options.gravity_m_s2);
  dWorldSetERP(world_, kErrorReduction);
  dWorldSetCFM(world_, kConstraintSoftness);
  dWorldSetContactSurfaceLayer(world_, 0);
  dWorldSetContactMaxCorrectingVel(world_, kMaxCorrectingVelocity);
  if (options.ground) {
    ground_ = &tag(dCreatePlane(space_, 0, 0, 1, 0),
                   GeomTag{.owner = kScenery, .surface = options.ground_surface});
  }
  if (options.scenery) scenery_ = std::make_unique<Scenery>(*this, options.scenery);
}

World::~World() {
  scenery_.reset();
  dJointGroupDestroy(contact_group_);
  dSpaceDestroy(space_);
  if (diverged_) {
    keep(world_, threading_);
    return;
  }
  dWorldDestroy(world_);
  dThreadingFreeImplementation(threading_);
}

void World::set_gravity(double gravity_m_s2) {
  options_.gravity_m_s2 = gravity_m_s2;
  const Vec3 down_m_s2 = -gravity_m_s2 * options_.up.normalized();
  dWorldSetGravity(world_, down_m_s2.x(), down_m_s2.y(), down_m_s2.z());
}

GeomTag& World::tag(dGeomID geom, const GeomTag& tag) {
  tags_.push_back(tag);
  dGeomSetData(geom, &tags_.back());
  return tags_.back();
}

dGeomID World::make_shape(const model::Collision& collision) {
  const Vec3& size = collision.size_m;
  switch (collision.shape) {
    case model::Collision::Shape::kSphere:
      return dCreateSphere(space_, size.x());
    case model::Collision::Shape::kCapsule:
      return dCreateCapsule(space_, size.x(), size.z());
    case model::Collision::Shape::kCylinder:
      return dCreateCylinder(space_, size.x(), size.z());
    case model::Collision::Shape::kBox:
      break;
  }
  return dCreateBox(space_, size.x(), size.y(), size.z());
}

void World::near_callback(void* self, dGeomID a, dGeomID b) {
  static_cast<World*>(self)->collide(a, b);
}

void World::collide(dGeomID a, dGeomID b) {
  const auto* first = static_cast<const GeomTag*>(dGeomGetData(a));
  const auto* second = static_cast<const GeomTag*>(dGeomGetData(b));
  if (first == nullptr || second == nullptr || !first->collides_with(*second)) return;
  dContact points[kMaxContacts];
  const int count = dCollide(a, b, kMaxContacts, &points[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dContact& point = points[i];
    // A moving body first: ODE's feedback is then the force on it.
    if (dGeomGetBody(point.geom.g1) == nullptr) {
      std::swap(point.geom.g1, point.geom.g2);
      for (int axis = 0; axis < 3; ++axis) point.geom.normal[axis] = -point.geom.normal[axis];
    }
    const auto* on = static_cast<const GeomTag*>(dGeomGetData(point.geom.g1));
    const auto* other = static_cast<const GeomTag*>(dGeomGetData(point.geom.g2));
    set_surface(point.surface, combine(on->surface, other->surface), step_s());
    const dJointID joint = dJointCreateContact(world_, contact_group_, &point);
    dJointAttach(joint, dGeomGetBody(point.geom.g1), dGeomGetBody(point.geom.g2));
    if (touching_.size() == feedback_.size()) feedback_.emplace_back();
    dJointSetFeedback(joint, &feedback_[touching_.size()]);
    touching_.push_back({on, other, vec_of(point.geom.pos)});
  }
}

void World::step() {
  const double now_s = 1e-6 * static_cast<double>(now_us_);
  if (diverged_) throw Diverged(now_s, step_s(), "no step can follow");
  try {
    step_once();
  } catch (const OdeGaveUp& error) {
    diverged_ = true;
    throw Diverged(now_s, step_s(), error.what());
  }
}

void World::step_once() {
  for (Actor* actor : actors_) actor->before_step(step_s());
  dJointGroupEmpty(contact_group_);
  touching_.clear();
  dSpaceCollide(space_, this, &World::near_callback);
  dWorldStep(world_, step_s());
  now_us_ += options_.step_us;
  read_contacts();
  for (Actor* actor : actors_) actor->after_step(step_s());
}

void World::read_contacts() {
  contacts_.clear();
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    const Touching& pair = touching_[i];
    const Vec3 force = vec_of(feedback_[i].f1);
    const GeomTag &a = *pair.first, &b = *pair.second;
    contacts_.push_back({a.owner, a.node, b.owner, b.node, pair.position_world_m, force});
    if (b.owner == kScenery) continue;
    contacts_.push_back({b.owner, b.node, a.owner, a.node, pair.position_world_m, -force});
  }
}

void World::advance_to(std::uint64_t time_us) {
  while (now_us_ + options_.step_us <= time_us) step();
}

}  // namespace verp::sim
