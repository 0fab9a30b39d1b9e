// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/contact_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/meetings.hpp"
#include "limber/contact/shape_measures.hpp"

namespace limber::contact {
namespace {

using joints::PairBodies;
using joints::PairBody;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Below this share of the change of depth the way along the normal does not
// tell the force [-].
constexpr double kLeastWay = 0.1;
// Features that touch at once, such as the corners of a box that lands flat,
// begin at once: at most as far behind the first, of the shapes' size [-].
constexpr double kTogether = 1e-9;

double find_reduced_mass(double mass_A, double mass_B) {
  return 1.0 / (1.0 / mass_A + 1.0 / mass_B);
}

bool has_rim(const Shape& shape) {
  return std::holds_alternative<Cylinder>(shape.kind);
}

bool is_round(const Shape& shape) {
  return std::holds_alternative<Sphere>(shape.kind) ||
         std::holds_alternative<HalfSpace>(shape.kind);
}

// Where a rim meets an edge or a face, the nearest feature changes along the
// rim, and its speed is not that of the depth.
void check_rims(const Shape& A, const Shape& B) {
  if ((has_rim(A) && !is_round(B)) || (has_rim(B) && !is_round(A))) {
    throw InputError(
        "contact: a cylinder touches spheres and half spaces only; use a "
        "capsule or a box in its place");
  }
}

double check_masses(const ContactSide& A, const ContactSide& B) {
  LIMBER_EXPECT(A.mass > 0.0 && B.mass > 0.0);
  const double mass = find_reduced_mass(A.mass, B.mass);
  if (std::isfinite(mass)) return mass;
  throw InputError("contact: neither side can move");
}

SurfacePlace to_place(const PlaceMemory& memory) {
  return {memory.x_B, static_cast<int>(memory.face), memory.u, memory.v};
}

// Of the material point where the force acts, so that increments since then are
// those that the force does work on.
PlaceMemory to_memory(const SurfacePlace& surface,
                      const joints::PairPlace& place) {
  return {place.x_B, static_cast<double>(surface.face), surface.u, surface.v};
}

// The material point of a body that is at p_W, moved as its surface there.
void set_place(const PairBody& body, const Shape& shape,
               const SurfacePlace& surface, const Vector3& p_W,
               joints::PairPlace& out) {
  set_shape_functions(shape, surface, out.Phi_B);
  out.x_B.setZero();
  out.x_B = body.R_WB.transpose() * (p_W - body.p_WB) - find_arm(body, out);
}

// Where the material point at which the force acted at the last commit is now.
Vector3 find_former(const PairBody& body, const Shape& shape,
                    const PlaceMemory& former, joints::PairPlace& scratch) {
  const SurfacePlace surface = to_place(former);
  set_shape_functions(shape, surface, scratch.Phi_B);
  scratch.x_B = surface.x_B;
  return find_position(body, scratch);
}

template <typename Number>
std::span<Number> numbers_of(std::size_t i, std::span<Number> memory) {
  return memory.subspan(i * kPointNumbers, kPointNumbers);
}

// All but the energy.
void set_response(const PointResponse& response, joints::PairPoint& point,
                  joints::PairResponse& out) {
  point.force_W = response.force_W;
  point.stiffness = response.stiffness;
  point.damping = response.damping;
  out.dissipation += response.dissipation;
}

joints::TouchReach find_reach(const Shape& shape, const VectorX& mode_reach) {
  const VectorX still = VectorX::Zero(mode_reach.size());
  PairBody body;
  body.modes = static_cast<int>(still.size());
  body.eta = body.etadot = still.data();
  return {find_extent(shape, body), mode_reach};
}

// Of the shape's points relative to its body's origin, at most [m/s].
double find_own_speed(const Shape& shape, const VectorX& mode_reach,
                      const PairBody& body) {
  const double turn = body.w_WB_B.norm();
  double speed = turn > 0.0 ? turn * find_extent(shape, body) : 0.0;
  for (Eigen::Index k = 0; k < mode_reach.size(); ++k) {
    speed += mode_reach[k] * std::abs(body.etadot[k]);
  }
  return speed;
}

}  // namespace

ContactPair::ContactPair(ContactSide side_A, ContactSide side_B,
                         const ContactParameters& parameters)
    : A_(std::move(side_A)),
      B_(std::move(side_B)),
      parameters_(parameters),
      shapes_(A_.shape, B_.shape),
      law_(parameters, find_pair_moduli(A_.material, B_.material),
           check_masses(A_, B_), find_roundness(A_.shape, B_.shape)),
      size_(contact::find_size(A_.shape, B_.shape)),
      mode_reach_A_(find_mode_reach(A_.shape)),
      mode_reach_B_(find_mode_reach(B_.shape)) {
  check_rims(A_.shape, B_.shape);
}

void ContactPair::describe_parameters(Manifest& out) const {
  describe(out, "parameters", parameters_);
  const auto describe_side = [&](const char* name, const ContactSide& side) {
    out.within(name, [&] {
      describe(out, "shape", side.shape);
      out.add("mass [kg]", side.mass);
      if (!side.material) return;
      out.add("youngs modulus [Pa]", side.material->youngs_modulus);
      out.add("poisson ratio", side.material->poisson_ratio);
    });
  };
  describe_side("body A", A_);
  describe_side("body B", B_);
}

std::size_t ContactPair::most_points() const { return shapes_.most_points(); }

std::size_t ContactPair::memory_size() const {
  return kPointNumbers * most_points();
}

void ContactPair::check(int modes_A, int modes_B) const {
  const auto check_modes = [](const Shape& shape, int modes, const char* body) {
    const int own = count_modes(shape);
    if (own == 0 || own == modes) return;
    throw InputError(fmt::format(
        "the surface of body {} has {} modes, the body {}; expected as many",
        body, own, modes));
  };
  check_modes(A_.shape, modes_A, "A");
  check_modes(B_.shape, modes_B, "B");
}

// Motion at a feature; places the point there.
PointMotion ContactPair::place(const PairBodies& bodies, const Meeting& meeting,
                               const PointMemory& memory, double t,
                               joints::PairPoint& point) const {
  PointMotion motion{.normal_W = meeting.normal_W,
                     .depth = meeting.depth,
                     .curvature = meeting.curvature,
                     .residual = find_residual(A_.shape, meeting.on_A) +
                                 find_residual(B_.shape, meeting.on_B),
                     .share = meeting.share,
                     .R_WB = bodies.B.R_WB,
                     .time = t};
  // At the commit both were at one point: their distance has come since.
  if (law_.has_friction() && memory.is_touching()) {
    motion.increment_W =
        find_former(bodies.B, B_.shape, memory.on_B, point.on_B) -
        find_former(bodies.A, A_.shape, memory.on_A, point.on_A);
  }
  set_place(bodies.A, A_.shape, meeting.on_A, meeting.p_W, point.on_A);
  set_place(bodies.B, B_.shape, meeting.on_B, meeting.p_W, point.on_B);
  motion.velocity_W =
      find_velocity(bodies.B, point.on_B) - find_velocity(bodies.A, point.on_A);
  return motion;
}

HertzLaw ContactPair::find_law(const Meeting& meeting, double share) const {
  return law_.find_law(meeting.curvature,
                       find_residual(A_.shape, meeting.on_A) +
                           find_residual(B_.shape, meeting.on_B),
                       share);
}

void ContactPair::evaluate(const PairBodies& bodies, const Instant& now,
                           std::span<const double> memory,
                           joints::PairResponse& out) const {
  Meetings meetings(most_points());
  shapes_.find(bodies, 0.0, meetings.all());
  for (std::size_t i = 0; i < most_points(); ++i) {
    const Meeting& meeting = meetings[i];
    if (!(meeting.depth > 0.0)) continue;
    joints::PairPoint& point = out.add();
    const PointMemory before = load_memory(numbers_of(i, memory));
    const PointResponse response =
        law_.evaluate(place(bodies, meeting, before, now.t, point), before);
    set_response(response, point, out);
    out.energy += response.energy;
  }
}

ElasticForce ContactPair::find_step_force(const joints::PairStep& step,
                                          const PointMotion& motion,
                                          const joints::PairPoint& point,
                                          const Meeting& begin,
                                          const Meeting& end) const {
  const HertzLaw::StepResponse mean =
      law_.find_law(motion.curvature, motion.residual, motion.share)
          .evaluate_over_step(begin.depth, end.depth);
  ElasticForce elastic{mean.force, mean.stiffness};
  // Way and energies are nearly those of that law: the normal turns, and
  // curvature and residual vary.
  const Vector3 way = (find_position(step.end.B, point.on_B) -
                       find_position(step.begin.B, point.on_B)) -
                      (find_position(step.end.A, point.on_A) -
                       find_position(step.begin.A, point.on_A));
  const double deepening = -motion.normal_W.dot(way);
  const double work =
      find_law(end, end.share).evaluate(end.depth).energy() -
      find_law(begin, begin.share).evaluate(begin.depth).energy();
  if (std::abs(deepening) > kLeastWay * std::abs(end.depth - begin.depth)) {
    elastic.force = std::max(work / deepening, 0.0);
  }
  return elastic;
}

void ContactPair::evaluate_over_step(const joints::PairStep& step,
                                     std::span<const double> memory,
                                     joints::PairResponse& out) const {
  if (find_clearance(step.begin) > 0.0 && find_clearance(step.end) > 0.0) {
    return;
  }
  Meetings begin(most_points());
  Meetings middle(most_points());
  Meetings end(most_points());
  shapes_.find(step.begin, kInfinity, begin.all());
  shapes_.find(step.end, kInfinity, end.all());
  shapes_.find(step.middle, kInfinity, middle.all());
  for (std::size_t i = 0; i < most_points(); ++i) {
    if (!(begin[i].depth > 0.0) && !(end[i].depth > 0.0)) continue;
    joints::PairPoint& point = out.add();
    const PointMemory before = load_memory(numbers_of(i, memory));
    const PointMotion motion =
        place(step.middle, middle[i], before, step.times.middle(), point);
    const ElasticForce elastic =
        find_step_force(step, motion, point, begin[i], end[i]);
    set_response(law_.evaluate(motion, elastic, before), point, out);
  }
}

void ContactPair::commit(const PairBodies& bodies, double t,
                         std::span<double> memory,
                         joints::PairResponse& scratch) const {
  Meetings meetings(most_points());
  shapes_.find(bodies, 0.0, meetings.all());
  scratch.clear();
  joints::PairPoint& point = scratch.add();
  for (std::size_t i = 0; i < most_points(); ++i) {
    const Meeting& meeting = meetings[i];
    const std::span<double> numbers = numbers_of(i, memory);
    PointMemory next;
    if (meeting.depth > 0.0) {
      const PointMemory before = load_memory(numbers);
      next =
          law_.evaluate(place(bodies, meeting, before, t, point), before).next;
      next.on_A = to_memory(meeting.on_A, point.on_A);
      next.on_B = to_memory(meeting.on_B, point.on_B);
    }
    save_memory(next, numbers);
  }
}

joints::PairTouch ContactPair::find_touch(const PairBodies& bodies,
                                          joints::PairResponse& scratch) const {
  Meetings meetings(most_points());
  shapes_.find(bodies, kInfinity, meetings.all());
  const std::size_t i = meetings.find_deepest();
  const Meeting& deepest = meetings[i];
  scratch.clear();
  const PointMotion motion = place(bodies, deepest, {}, 0.0, scratch.add());
  return {.depth = motion.depth,
          .rate = motion.rate(),
          .normal_W = deepest.normal_W,
          .p_W = deepest.p_W};
}

joints::TouchReach ContactPair::find_reach_A() const {
  return find_reach(A_.shape, mode_reach_A_);
}

joints::TouchReach ContactPair::find_reach_B() const {
  return find_reach(B_.shape, mode_reach_B_);
}

double ContactPair::find_clearance(const PairBodies& bodies) const {
  return shapes_.find_clearance(bodies);
}

double ContactPair::find_speed_bound(const PairBodies& bodies) const {
  return (bodies.B.v_WB_W - bodies.A.v_WB_W).norm() +
         find_own_speed(A_.shape, mode_reach_A_, bodies.A) +
         find_own_speed(B_.shape, mode_reach_B_, bodies.B);
}

double ContactPair::begin_touch(const PairBodies& bodies, double t,
                                std::span<double> memory,
                                joints::PairResponse& scratch) const {
  Meetings meetings(most_points());
  shapes_.find(bodies, kInfinity, meetings.all());
  const std::size_t deepest = meetings.find_deepest();
  const double least_depth = meetings[deepest].depth - kTogether * size_;
  for (std::size_t i = 0; i < most_points(); ++i) {
    const Meeting& meeting = meetings[i];
    const std::span<double> numbers = numbers_of(i, memory);
    // Where an earlier run goes on they touch already.
    if (!(meeting.depth >= least_depth) || load_memory(numbers).is_touching()) {
      continue;
    }
    scratch.clear();
    joints::PairPoint& point = scratch.add();
    const PointMotion motion = place(bodies, meeting, {}, t, point);
    PointMemory next = law_.begin(find_law(meeting, 1.0), motion.rate());
    next.time = t;
    next.on_A = to_memory(meeting.on_A, point.on_A);
    next.on_B = to_memory(meeting.on_B, point.on_B);
    save_memory(next, numbers);
  }
  return law_.find_duration(find_law(meetings[deepest], 1.0),
                            load_memory(numbers_of(deepest, memory)).speed);
}

joints::TouchReading ContactPair::read(const PairBodies& bodies,
                                       const Instant& now,
                                       std::span<const double> memory,
                                       joints::PairResponse& scratch) const {
  Meetings meetings(most_points());
  shapes_.find(bodies, 0.0, meetings.all());
  scratch.clear();
  joints::PairPoint& point = scratch.add();
  joints::TouchReading reading;
  double largest = -1.0;
  for (std::size_t i = 0; i < most_points(); ++i) {
    const Meeting& meeting = meetings[i];
    if (!(meeting.depth > 0.0)) continue;
    const PointMemory before = load_memory(numbers_of(i, memory));
    const PointResponse response =
        law_.evaluate(place(bodies, meeting, before, now.t, point), before);
    ++reading.points;
    reading.normal_force += response.normal_force;
    reading.force_W += response.force_W;
    reading.friction_W += response.friction_W;
    reading.energy += response.energy;
    reading.area += response.area;
    reading.depth = std::max(reading.depth, meeting.depth);
    reading.slips = reading.slips || response.slips;
    if (response.normal_force <= largest) continue;
    largest = response.normal_force;
    reading.friction_force = response.friction_W.norm();
    reading.normal_W = meeting.normal_W;
    reading.p_W = meeting.p_W;
  }
  return reading;
}

}  // namespace limber::contact
