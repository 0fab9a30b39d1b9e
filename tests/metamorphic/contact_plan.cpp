// SPDX-License-Identifier: BSD-3-Clause
#include "metamorphic/contact_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::metamorphic {
namespace {

using contact::ContactSide;
using contact::Shape;

constexpr const char* kTwin = "twin of ";
constexpr double kFar = 50.0;   // of a twin, in extents of the first scene
constexpr double kLater = 0.4;  // of a twin's touch, in the time of the run

Shape draw_shape(RandomDraw& draw, int kind, double size) {
  const Pose pose{draw.rotation(), 0.2 * size * draw.vector()};
  const auto ratio = [&] { return draw.uniform(0.3, 1.0); };
  switch (kind) {
    case 0:
      return {contact::Sphere{size}, pose};
    case 1:
      return {contact::Capsule{size * ratio(), size}, pose};
    case 2:
      return {contact::Cylinder{size * ratio(), size * ratio()}, pose};
    case 3:
      return {contact::Cone{size * ratio(), size * ratio()}, pose};
    case 4:
      return {contact::Ellipsoid{size * Vector3(1.0, ratio(), ratio())}, pose};
    default:
      return {contact::Box{size * Vector3(1.0, ratio(), ratio())}, pose};
  }
}

const char* name_shape(const Shape& shape) {
  static constexpr const char* kNames[] = {"sphere", "capsule",    "cylinder",
                                           "box",    "half space", "mesh",
                                           "cone",   "ellipsoid"};
  return kNames[shape.kind.index()];
}

StrikingBody draw_body(RandomDraw& draw, const char* name, int kind,
                       double size) {
  StrikingBody body{.name = name, .shape = draw_shape(draw, kind, size)};
  body.mass = draw.log_uniform(0.1, 10.0);
  const Vector3 moments = Vector3(1.0, 1.0, 1.0) + 0.3 * draw.vector();
  body.inertia_B = 0.4 * body.mass * size * size * moments;
  body.X_WB.R = draw.rotation();
  body.material = contact::SurfaceMaterial{draw.log_uniform(1e7, 1e10),
                                           draw.uniform(0.0, 0.45)};
  return body;
}

StrikingBody draw_floor(RandomDraw& draw) {
  StrikingBody floor{.name = "B", .shape = {contact::HalfSpace{}, {}}};
  floor.shape.X_BS.R = draw.rotation();
  floor.material = contact::SurfaceMaterial{draw.log_uniform(1e7, 1e10), 0.3};
  return floor;
}

ContactSide make_side(const StrikingBody& body) {
  if (body.is_world()) {
    return {body.shape, body.material, std::numeric_limits<double>::infinity()};
  }
  return {body.shape, body.material, body.mass, body.inertia_B.asDiagonal()};
}

template <typename Law>
double find_gap(const Law& law, const ContactPlan& plan) {
  joints::PairBody bodies[2];
  for (int i = 0; i < 2; ++i) {
    const StrikingBody& body = plan.bodies[static_cast<std::size_t>(i)];
    if (body.is_world()) continue;
    bodies[i].R_WB = body.X_WB.R;
    bodies[i].p_WB = body.X_WB.p;
  }
  return law.find_clearance({bodies[0], bodies[1]});
}

std::shared_ptr<const joints::PairInteraction> make_law(
    const ContactPlan& plan) {
  const auto& [first, second] = std::tie(plan.bodies[0], plan.bodies[1]);
  const ContactSide A = make_side(plan.is_swapped ? second : first);
  const ContactSide B = make_side(plan.is_swapped ? first : second);
  return contact::make_contact(A, B, plan.parameters);
}

// The first body flies at the other, and starts near it.
void place(ContactPlan& plan, RandomDraw& draw, double size, double speed) {
  StrikingBody& first = plan.bodies[0];
  const StrikingBody& other = plan.bodies[1];
  const Vector3 way =
      other.is_world() ? Vector3(-other.shape.X_BS.R.col(2)) : draw.direction();
  const auto law = make_law(plan);
  const double gap = 0.05 * size;
  first.X_WB.p = -10.0 * size * way;
  for (int i = 0; i < 100; ++i) {
    first.X_WB.p += (find_gap(*law->touching(), plan) - gap) * way;
  }
  first.v_WB_W = speed * (way + 0.3 * draw.vector());
  plan.settings.end_time = 5.0 * gap / speed;
  plan.settings.step = plan.settings.end_time / 50.0;
}

// Of materials, of no material, or of a stiffness.
const char* draw_modulus(RandomDraw& draw, ContactPlan& plan) {
  if (draw.chance(0.2)) {
    for (StrikingBody& body : plan.bodies) body.material.reset();
    return "no material";
  }
  if (!draw.chance(0.25)) return "materials";
  plan.parameters.stiffness = draw.log_uniform(1e6, 1e9);
  return "a stiffness";
}

dynamics::BodyIndex add_body(dynamics::SystemBuilder& builder,
                             const StrikingBody& body,
                             const std::string& prefix) {
  if (body.is_world()) return dynamics::kWorld;
  return builder.add_rigid_body(
      prefix + body.name, {body.mass, Matrix3(body.inertia_B.asDiagonal())});
}

void add_pair(dynamics::SystemBuilder& builder, const ContactPlan& plan,
              const std::string& prefix) {
  const auto i = static_cast<std::size_t>(plan.is_reversed);
  dynamics::BodyIndex added[2];
  added[i] = add_body(builder, plan.bodies[i], prefix);
  added[1 - i] = add_body(builder, plan.bodies[1 - i], prefix);
  const auto a = static_cast<std::size_t>(plan.is_swapped);
  builder.add_pair(prefix + "A/B", added[a], added[1 - a], make_law(plan));
}

void set_start(const ContactPlan& plan, const dynamics::SystemModel& model,
               const std::string& prefix, const Vector3& shift,
               dynamics::SystemState& state) {
  for (const StrikingBody& body : plan.bodies) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (model.bodies[b].name != prefix + body.name) continue;
      dynamics::BodyState& s = state.bodies[b];
      s.p_WB = body.X_WB.p + shift;
      s.quat_WB = Quaternion(body.X_WB.R);
      s.v_WB_W = body.v_WB_W;
      s.w_WB_B = body.w_WB_B;
    }
  }
}

// It strikes after the first impact, whose steps are then the same.
void set_twin(const ContactPlan& plan, const dynamics::SystemModel& model,
              dynamics::SystemState& state) {
  ContactPlan twin = plan;
  StrikingBody& first = twin.bodies[0];
  first.X_WB.p -= kLater * plan.settings.end_time * first.v_WB_W;
  const double distance = kFar * (plan.bodies[0].X_WB.p.norm() + 1.0);
  const StrikingBody& other = plan.bodies[1];
  const Vector3 aside =
      other.is_world() ? Vector3(other.shape.X_BS.R.col(0)) : Vector3::UnitY();
  set_start(twin, model, kTwin, distance * aside, state);
}

std::vector<Strike::Body> read_bodies(const ContactPlan& plan,
                                      const dynamics::SystemModel& model,
                                      const dynamics::SystemState& state) {
  std::vector<Strike::Body> bodies(plan.bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (model.bodies[b].name != plan.bodies[i].name) continue;
      const dynamics::BodyState& s = state.bodies[b];
      bodies[i] = {{s.quat_WB.toRotationMatrix(), s.p_WB}, s.v_WB_W, s.w_WB_B};
    }
  }
  return bodies;
}

}  // namespace

bool StrikingBody::is_world() const {
  return std::holds_alternative<contact::HalfSpace>(shape.kind);
}

ContactPlan draw_contact(unsigned seed) {
  RandomDraw draw(seed + 5'000'000U);
  ContactPlan plan;
  const double size = draw.log_uniform(0.02, 0.5);
  const double speed = draw.log_uniform(0.05, 5.0);
  const auto kind = [&] { return draw.integer(0, 5); };
  plan.bodies.push_back(draw_body(draw, "A", kind(), size));
  plan.bodies.push_back(
      draw.chance(1.0 / 3.0)
          ? draw_floor(draw)
          : draw_body(draw, "B", kind(), size * draw.log_uniform(0.3, 3.0)));
  for (StrikingBody& body : plan.bodies) {
    if (body.is_world()) continue;
    body.w_WB_B = speed / size * draw.vector();
  }
  plan.parameters.restitution = draw.chance(0.3) ? 1.0 : draw.uniform(0.1, 1.0);
  if (draw.chance(0.5)) {
    plan.parameters.friction.sliding = draw.uniform(0.05, 1.0);
  }
  place(plan, draw, size, speed);
  const char* modulus = draw_modulus(draw, plan);
  if (draw.chance(0.2))
    plan.parameters.damping = draw.uniform(0.0, 1.0) / speed;
  plan.description = fmt::format(
      "seed {}: {} on {}, size {:.3g} m, speed {:.3g} m/s, e {:.3g}, mu "
      "{:.3g}, modulus of {}{}",
      seed, name_shape(plan.bodies[0].shape), name_shape(plan.bodies[1].shape),
      size, speed, plan.parameters.restitution,
      plan.parameters.friction.sliding, modulus,
      plan.parameters.damping ? ", damping" : "");
  return plan;
}

Strike run(const ContactPlan& plan) {
  dynamics::SystemBuilder builder;
  builder.set_gravity(plan.gravity_W);
  add_pair(builder, plan, "");
  if (plan.has_twin) add_pair(builder, plan, kTwin);
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  set_start(plan, model, "", Vector3::Zero(), state);
  if (plan.has_twin) set_twin(plan, model, state);
  Strike strike;
  dynamics::SimulationStatistics statistics;
  try {
    dynamics::simulate(model, state, plan.settings, {}, {}, statistics, {}, {},
                       strike.record);
  } catch (const NumericalError& error) {
    strike.refusal = error.what();
  }
  strike.bodies = read_bodies(plan, model, state);
  strike.steps = statistics.steps;
  strike.events = statistics.events.size();
  strike.has_halved_steps = statistics.halved_steps > 0;
  return strike;
}

Momenta find_momenta(const ContactPlan& plan,
                     const std::vector<Strike::Body>& bodies) {
  Momenta sum;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const StrikingBody& plan_body = plan.bodies[i];
    if (plan_body.is_world()) continue;
    const Strike::Body& body = bodies[i];
    const Vector3 p = plan_body.mass * body.v_WB_W;
    const Vector3 L_B = plan_body.inertia_B.cwiseProduct(body.w_WB_B);
    sum.linear += p;
    sum.angular += body.X_WB.p.cross(p) + body.X_WB.R * L_B;
  }
  return sum;
}

std::vector<Strike::Body> find_start(const ContactPlan& plan) {
  std::vector<Strike::Body> bodies;
  for (const StrikingBody& body : plan.bodies) {
    bodies.push_back({body.X_WB, body.v_WB_W, body.w_WB_B});
  }
  return bodies;
}

}  // namespace limber::metamorphic
