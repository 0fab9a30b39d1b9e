// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/contact_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/feature_slots.hpp"
#include "limber/contact/meeting_order.hpp"
#include "limber/contact/patches/pressure_sum.hpp"
#include "limber/contact/point_numbers.hpp"
#include "limber/contact/shapes/shape_measures.hpp"
#include "limber/contact/touch.hpp"

namespace limber::contact {
namespace {

using joints::PairBodies;
using joints::PairBody;

// Features whose depths differ by at most this share of the shapes' size, such
// as the pads of a surface that lands flat, begin to touch together [-].
constexpr double kTogether = 1e-9;

// Of the couple of friction about the normal, over the shapes' size [-].
constexpr double kTwistArm = 1e-3;

SurfacePlace to_place(const PlaceMemory& memory) {
  return {memory.x_B, static_cast<int>(memory.face), memory.u, memory.v};
}

// Stores the material point where the force acts, so that later increments are
// those on which the force does work.
PlaceMemory to_memory(const SurfacePlace& surface,
                      const joints::PairPlace& place) {
  return {place.x_B, static_cast<double>(surface.face), surface.u, surface.v};
}

// Sets the material point of a body at p_W, which moves as the surface there.
void set_place(const PairBody& body, const Shape& shape,
               const SurfacePlace& surface, const Vector3& p_W,
               joints::PairPlace& out) {
  set_shape_functions(shape, surface, out.Phi_B);
  out.x_B.setZero();
  out.x_B = body.R_WB.transpose() * (p_W - body.p_WB) - find_arm(body, out);
}

// Second moments of Hertz's pressure on a round area.
Matrix3 find_spread(double area, const Vector3& normal_W) {
  return 0.2 * area / std::numbers::pi *
         (Matrix3::Identity() - normal_W * normal_W.transpose());
}

}  // namespace

ContactPair::ContactPair(ContactSide side_A, ContactSide side_B,
                         const ContactParameters& parameters)
    : A_(std::move(side_A)),
      B_(std::move(side_B)),
      mass_(A_, B_, parameters),
      parameters_(parameters),
      shapes_(A_.shape, B_.shape, !parameters.radius && !parameters.stiffness),
      law_(parameters, find_pair_moduli(A_.material, B_.material),
           check_masses(A_, B_), find_roundness(A_.shape, B_.shape)),
      pads_(PadContact::make(shapes_, {A_.shape, A_.material},
                             {B_.shape, B_.material}, parameters)),
      has_twist_(law_.has_friction() && (A_.material || B_.material) &&
                 count_features() == 1),
      size_(contact::find_size(A_.shape, B_.shape)),
      mode_reach_A_(find_mode_reach(A_.shape)),
      mode_reach_B_(find_mode_reach(B_.shape)) {
  if (parameters.rolling_friction > 0.0) {
    throw InputError(
        "contact: rolling_friction does not act on these shapes: a surface "
        "of a link at level full, or a ball on a flexible link");
  }
}

// Adds friction about the normal as two more points, on both sides of the
// meeting's place.
void ContactPair::add_twist(const PairBodies& bodies, const Meeting& meeting,
                            const PointResponse& response, std::size_t point,
                            joints::PairResponse& out) const {
  const double arm = kTwistArm * size_;
  const std::size_t first = out.points().size();
  const Vector3 aside_W = meeting.normal_W.unitOrthogonal();
  for (const double side : {1.0, -1.0}) {
    const Vector3 p_W = meeting.p_W + side * arm * aside_W;
    joints::PairPoint& next = out.add();
    set_place(bodies.A, A_.shape, meeting.on_A, p_W, next.on_A);
    set_place(bodies.B, B_.shape, meeting.on_B, p_W, next.on_B);
  }
  // The turn is along . (d_first - d_second) / (2 arm).
  const Vector3 along_W = meeting.normal_W.cross(aside_W) / (2.0 * arm);
  const Matrix3 K = -response.moment_by_turn * along_W * along_W.transpose();
  for (const double side : {1.0, -1.0}) {
    const std::size_t own = side > 0.0 ? first : first + 1;
    const std::size_t other = side > 0.0 ? first + 1 : first;
    out.points()[own].force_W = side * response.moment * along_W;
    out.points()[own].stiffness = K;
    out.coupling(own, other) = -K;
    out.coupling(own, point) =
        -side * along_W * response.moment_by_position.transpose();
    out.coupling(point, own) =
        -side * response.force_by_turn * along_W.transpose();
  }
}

void ContactPair::describe_parameters(Manifest& out) const {
  describe(out, A_, B_, parameters_);
}

std::size_t ContactPair::most_points() const {
  return count_features() + (has_twist_ ? 2 : 0);
}

std::size_t ContactPair::memory_size() const {
  return kPointNumbers * count_features() + OpposedMass::kNumbers;
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

// Motion at a feature; sets the places of the point.
PointMotion ContactPair::place(const PairBodies& bodies, const Meeting& meeting,
                               const PointMemory& memory, double t,
                               joints::PairPoint& point) const {
  PointMotion motion{.normal_W = meeting.normal_W,
                     .depth = meeting.depth,
                     .curvature = meeting.curvature,
                     .residual = find_residual(A_.shape, meeting.on_A) +
                                 find_residual(B_.shape, meeting.on_B),
                     .share = meeting.share,
                     .turns = {bodies.A.R_WB, bodies.B.R_WB},
                     .time = t};
  motion.spin = meeting.normal_W.dot(bodies.B.R_WB * bodies.B.w_WB_B -
                                     bodies.A.R_WB * bodies.A.w_WB_B);
  // At the last commit both points coincided: their distance is the increment.
  if (law_.has_friction() && memory.is_touching()) {
    motion.increment_W =
        find_point(bodies.B, B_.shape, to_place(memory.on_B), point.on_B) -
        find_point(bodies.A, A_.shape, to_place(memory.on_A), point.on_A);
  }
  set_place(bodies.A, A_.shape, meeting.on_A, meeting.p_W, point.on_A);
  set_place(bodies.B, B_.shape, meeting.on_B, meeting.p_W, point.on_B);
  motion.velocity_W =
      find_velocity(bodies.B, point.on_B) - find_velocity(bodies.A, point.on_A);
  return motion;
}

void ContactPair::meet(const PairBodies& bodies, double reach,
                       std::span<const double> memory,
                       std::span<Meeting> out) const {
  shapes_.find(bodies, reach, out);
  if (shapes_.has_loose_features()) follow_memory(memory, out);
  const std::size_t ordered = shapes_.ordered_count();
  if (ordered == out.size()) return;
  take_slots(memory.subspan(kPointNumbers * ordered,
                            kPointNumbers * (out.size() - ordered)),
             size_, out.subspan(ordered));
}

void ContactPair::evaluate_pads(std::span<const Meeting> meetings,
                                PadLaw::Response& out) const {
  if (pads_) pads_->evaluate(meetings, out);
}

bool ContactPair::touches(const Meeting& meeting, std::size_t i,
                          const PadLaw::Response& pads) const {
  if (!is_pad(i)) return meeting.depth > 0.0;
  return !(pads.force[static_cast<Eigen::Index>(i)] <= 0.0);
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
  Meetings meetings(count_features());
  meet(bodies, 0.0, memory, meetings.all());
  Touch touch(memory);
  gather(bodies, now.t, memory, meetings.all(), touch, out);
  out.energy += touch.pads.energy;
  respond(bodies, meetings.all(), touch, out);
}

void ContactPair::commit(const PairBodies& bodies, double t,
                         std::span<double> memory,
                         joints::PairResponse& scratch) const {
  Meetings meetings(count_features());
  meet(bodies, 0.0, memory, meetings.all());
  scratch.clear();
  Touch touch(memory);
  gather(bodies, t, memory, meetings.all(), touch, scratch);
  const DampingRate damping = find_damping(bodies, touch);
  for (std::size_t i = 0; i < count_features(); ++i) {
    save_memory({}, numbers_of(i, memory));
  }
  for (const TouchingPoint& at : touch.points.all()) {
    const Meeting& meeting = meetings[at.feature];
    const joints::PairPoint& point = scratch.points()[at.point];
    const PointResponse response =
        law_.evaluate(at.motion, at.elastic, damping, at.before);
    PointMemory next = response.next;
    next.on_A = to_memory(meeting.on_A, point.on_A);
    next.on_B = to_memory(meeting.on_B, point.on_B);
    save_memory(next, numbers_of(at.feature, memory));
  }
}

joints::PairTouch ContactPair::find_touch(const PairBodies& bodies,
                                          joints::PairResponse& scratch) const {
  Meetings meetings(count_features());
  shapes_.find(bodies, kInfinity, meetings.all());
  const std::size_t i = meetings.find_deepest();
  const Meeting& deepest = meetings[i];
  if (deepest.depth == Meeting{}.depth)
    return {.depth = -find_clearance(bodies)};
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
  Meetings meetings(count_features());
  meet(bodies, kInfinity, memory, meetings.all());
  const std::size_t deepest = meetings.find_deepest();
  // Surfaces that cross where neither has an interior.
  if (meetings[deepest].depth == Meeting{}.depth) return kInfinity;
  const double least_depth = meetings[deepest].depth - kTogether * size_;
  for (std::size_t i = 0; i < count_features(); ++i) {
    const Meeting& meeting = meetings[i];
    const std::span<double> numbers = numbers_of(i, memory);
    // In a resumed run they touch already.
    if (!(meeting.depth >= least_depth) || load_memory(numbers).is_touching()) {
      continue;
    }
    scratch.clear();
    joints::PairPoint& point = scratch.add();
    const PointMotion motion = place(bodies, meeting, {}, t, point);
    PointMemory next = law_.begin(motion.rate());
    next.time = t;
    next.friction =
        keep_friction({}, FrictionFrame(meeting.normal_W), motion.turns);
    next.on_A = to_memory(meeting.on_A, point.on_A);
    next.on_B = to_memory(meeting.on_B, point.on_B);
    save_memory(next, numbers);
  }
  const HertzLaw whole =
      pads_ ? HertzLaw({HertzLaw::kRigid, 1.0 / pads_->law().total_stiffness()})
            : find_law(meetings[deepest], 1.0);
  return law_.find_duration(whole,
                            load_memory(numbers_of(deepest, memory)).speed);
}

void ContactPair::set_mobility(const joints::PairMobility& mobility,
                               std::span<double> memory) const {
  OpposedMass::keep(mobility, memory);
}

void ContactPair::end_touch(std::span<double> memory) const {
  for (std::size_t i = 0; i < count_features(); ++i) {
    save_memory({}, numbers_of(i, memory));
  }
  OpposedMass::keep(joints::PairMobility::Zero(), memory);
}

joints::TouchReading ContactPair::read(const PairBodies& bodies,
                                       const Instant& now,
                                       std::span<const double> memory,
                                       joints::PairResponse& scratch) const {
  Meetings meetings(count_features());
  meet(bodies, 0.0, memory, meetings.all());
  scratch.clear();
  Touch touch(memory);
  gather(bodies, now.t, memory, meetings.all(), touch, scratch);
  const DampingRate damping = find_damping(bodies, touch);
  joints::TouchReading reading;
  set_rates(bodies, touch, reading);
  reading.energy = touch.pads.energy;
  double largest = -1.0;
  PressureSum pressure;
  for (const TouchingPoint& at : touch.points.all()) {
    const Meeting& meeting = meetings[at.feature];
    const PointResponse response =
        law_.evaluate(at.motion, at.elastic, damping, at.before);
    ++reading.points;
    reading.normal_force += response.normal_force;
    reading.force_W += response.force_W;
    reading.friction_W += response.friction_W;
    reading.energy += at.elastic.energy + response.energy;
    reading.area += at.elastic.area;
    reading.depth = std::max(reading.depth, meeting.depth);
    reading.slips = reading.slips || response.slips;
    pressure.add(response.normal_force, meeting.p_W,
                 find_spread(at.elastic.area, meeting.normal_W));
    if (response.normal_force <= largest) continue;
    largest = response.normal_force;
    reading.friction_force = response.friction_W.norm();
    reading.normal_W = meeting.normal_W;
    reading.p_W = meeting.p_W;
  }
  reading.spread_W = pressure.spread_W();
  return reading;
}

}  // namespace limber::contact
