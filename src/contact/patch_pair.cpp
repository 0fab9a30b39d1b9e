// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patch_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/narrow_phase/nearest_cores.hpp"
#include "limber/contact/shape_measures.hpp"

namespace limber::contact {
namespace {

using joints::PairBodies;
using joints::PairBody;

// Slower touches begin as one of this speed [m/s].
constexpr double kLeastSpeed = 1e-5;
// Slope of edges that lie on a plane, at most [-].
constexpr double kLevel = 1e-9;
// Depth of a patch whose normal may be round-off, of the solids' size [-].
constexpr double kThin = 1e-10;
// Least radius of the points that carry the wrench, of the solids' size [-].
constexpr double kLeastRadius = 1e-2;

double find_modulus(const ContactSide& A, const ContactSide& B) {
  const auto moduli = find_pair_moduli(A.material, B.material);
  LIMBER_EXPECT(moduli);
  return moduli->normal;
}

double find_ratio(const ContactSide& A, const ContactSide& B) {
  return find_pair_moduli(A.material, B.material)->tangential_ratio();
}

// The twist of B against A about a point of the world.
Vector6 find_twist(const PairBodies& bodies, const Vector3& about_W) {
  const auto spin = [](const PairBody& body) -> Vector3 {
    return body.R_WB * body.w_WB_B;
  };
  const auto speed = [&](const PairBody& body) -> Vector3 {
    return body.v_WB_W + spin(body).cross(about_W - body.p_WB);
  };
  Vector6 twist;
  twist << speed(bodies.B) - speed(bodies.A), spin(bodies.B) - spin(bodies.A);
  return twist;
}

// From a place of A to one of B, apart from each other.
struct Gap {
  Vector3 normal_W = Vector3::Zero();  // 0: unknown
  Vector3 on_A = Vector3::Zero();
  Vector3 on_B = Vector3::Zero();
};

// The middle of all corners that are as low as the lowest one.
Vector3 find_lowest(const PlacedShape& box, const Vector3& up) {
  const Vector3& half = std::get<Box>(box.shape.kind).half_size;
  Vector3 lowest = box.X_WS.p;
  for (int k = 0; k < 3; ++k) {
    const Vector3 axis = box.X_WS.R.col(k);
    const double slope = up.dot(axis);
    if (std::abs(slope) < kLevel) continue;
    lowest -= std::copysign(half[k], slope) * axis;
  }
  return lowest;
}

Gap find_gap_to_plane(const PlacedShape& plane, const PlacedShape& box) {
  const Vector3 n = plane.X_WS.R.col(2);
  const Vector3 lowest = find_lowest(box, n);
  const double distance = n.dot(lowest - plane.X_WS.p);
  return {n, lowest - distance * n, lowest};
}

Gap find_gap(const PlacedShape& A, const PlacedShape& B) {
  if (std::holds_alternative<HalfSpace>(A.shape.kind)) {
    return find_gap_to_plane(A, B);
  }
  if (std::holds_alternative<HalfSpace>(B.shape.kind)) {
    const Gap gap = find_gap_to_plane(B, A);
    return {-gap.normal_W, gap.on_B, gap.on_A};
  }
  const NearestOfCores nearest = find_nearest(ConvexCore(A), ConvexCore(B));
  const Vector3 way = nearest.on_B - nearest.on_A;
  if (nearest.overlap || way.isZero(0.0)) return {};
  return {way.normalized(), nearest.on_A, nearest.on_B};
}

// What the bristle has done since the last commit: both places that were one.
PatchSlip find_slip(const PairBodies& bodies, const PatchMemory& memory,
                    const Vector3& normal_W) {
  PatchSlip slip;
  if (!memory.is_touching) return slip;
  const auto place = [](const PairBody& body, const Vector3& x) -> Vector3 {
    return body.p_WB + body.R_WB * x;
  };
  slip.way_W = place(bodies.B, memory.x_B) - place(bodies.A, memory.x_A);
  const Matrix3 turn_A = bodies.A.R_WB.transpose() * bodies.B.R_WB *
                         memory.turn_AB.toRotationMatrix().transpose();
  const Eigen::AngleAxisd turn(turn_A);
  slip.turn = normal_W.dot(bodies.A.R_WB * (turn.angle() * turn.axis()));
  // In the mean of both bodies' rotations since then.
  slip.spring_W =
      0.5 * (bodies.A.R_WB * memory.spring_A + bodies.B.R_WB * memory.spring_B);
  slip.spin = memory.spin;
  slip.stiffness = memory.stiffness;
  return slip;
}

PatchMemory remember(const PairBodies& bodies, const Vector3& p_W, double t,
                     const PatchSlip& slip) {
  PatchMemory memory;
  memory.is_touching = true;
  memory.time = t;
  memory.x_A = bodies.A.R_WB.transpose() * (p_W - bodies.A.p_WB);
  memory.x_B = bodies.B.R_WB.transpose() * (p_W - bodies.B.p_WB);
  memory.turn_AB =
      Quaternion(Matrix3(bodies.A.R_WB.transpose() * bodies.B.R_WB));
  memory.spring_A = bodies.A.R_WB.transpose() * slip.spring_W;
  memory.spring_B = bodies.B.R_WB.transpose() * slip.spring_W;
  memory.spin = slip.spin;
  memory.stiffness = slip.stiffness;
  return memory;
}

// Energy of the bristle's spring at the last commit [J].
double find_spring_energy(const PatchMemory& memory) {
  if (!(memory.stiffness > 0.0)) return 0.0;
  return 0.5 * (memory.spring_A.squaredNorm() + memory.spin * memory.spin) /
         memory.stiffness;
}

}  // namespace

bool PatchPair::suits(const ContactSide& A, const ContactSide& B,
                      const ContactParameters& parameters) {
  const bool has_own =
      parameters.radius || parameters.stiffness || parameters.damping;
  const auto is_bounded = [](const ContactSide& side) {
    return !std::holds_alternative<HalfSpace>(side.shape.kind);
  };
  return is_solid(A.shape.kind) && is_solid(B.shape.kind) &&
         (is_bounded(A) || is_bounded(B)) && !has_own &&
         find_pair_moduli(A.material, B.material).has_value();
}

PatchPair::PatchPair(ContactSide A, ContactSide B,
                     const ContactParameters& parameters)
    : A_(std::move(A)),
      B_(std::move(B)),
      mass_(A_, B_, parameters),
      parameters_(parameters),
      shapes_(A_.shape, B_.shape),
      potential_(A_.shape, B_.shape, find_modulus(A_, B_)),
      law_(parameters, find_ratio(A_, B_)),
      size_(contact::find_size(A_.shape, B_.shape)) {
  LIMBER_EXPECT(suits(A_, B_, parameters));
  (void)check_masses(A_, B_);
}

void PatchPair::describe_parameters(Manifest& out) const {
  describe(out, A_, B_, parameters_);
}

std::size_t PatchPair::memory_size() const {
  return kPatchNumbers + OpposedMass::kNumbers;
}

PatchPoints PatchPair::place_points(const Patch& patch) const {
  const Vector3 n = patch.normal_W();
  return {patch.centre_W, n,
          std::max(std::sqrt(patch.spread_W.trace()), kLeastRadius * size_)};
}

double PatchPair::find_inverse_mass(const PairBodies& bodies,
                                    const Patch& patch,
                                    std::span<const double> memory) const {
  NormalLoad load;
  load.add(bodies, patch.centre_W, patch.normal_W());
  return mass_.find_inverse(bodies, load, 1.0, memory);
}

PatchResponse PatchPair::respond(const PairBodies& bodies, const Patch& patch,
                                 std::span<const double> memory) const {
  const Vector3 n = patch.normal_W();
  return law_.evaluate(
      {.patch = patch,
       .elastic_W = -patch.gradient_W,
       .twist_W = find_twist(bodies, patch.centre_W),
       .inverse_mass = find_inverse_mass(bodies, patch, memory),
       .slip = find_slip(bodies, load_patch(memory), n)});
}

void PatchPair::evaluate(const PairBodies& bodies, const Instant& now,
                         std::span<const double> memory,
                         joints::PairResponse& out) const {
  const Patch patch = potential_.evaluate(bodies, true);
  if (!patch.touches) return;
  const PatchResponse response = respond(bodies, patch, memory);
  const PatchPoints points = place_points(patch);
  points.add(bodies, out);
  points.set(response.wrench, out);
  out.energy = patch.energy + response.energy;
  out.dissipation = response.damped + response.rubbed;
  const double h = now.t - load_patch(memory).time;
  if (h > 0.0) out.dissipation += response.slip_work / h;
}

void PatchPair::evaluate_over_step(const joints::PairStep& step,
                                   std::span<const double> memory,
                                   joints::PairResponse& out) const {
  const Patch patch = potential_.evaluate(step.middle, true);
  if (!patch.touches) return;
  const PatchPoints points = place_points(patch);
  points.add(step.middle, out);
  std::array<Vector3, PatchPoints::kCount> ways;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const joints::PairPoint& point = out.points()[i];
    ways[i] = (find_position(step.end.B, point.on_B) -
               find_position(step.begin.B, point.on_B)) -
              (find_position(step.end.A, point.on_A) -
               find_position(step.begin.A, point.on_A));
  }
  const Vector6 motion = points.find_motion(ways);
  Vector6 weighted = motion;
  weighted.tail<3>() *= size_ * size_;
  const Patch end = potential_.evaluate(step.end, false);
  const double rise =
      end.energy - potential_.evaluate(step.begin, false).energy;
  Vector6 elastic = -patch.gradient_W;
  const double length = motion.dot(weighted);
  if (length > 0.0) {
    elastic -= (rise + elastic.dot(motion)) / length * weighted;
  }
  const Vector3 n = patch.normal_W();
  const PatchMemory last = load_patch(memory);
  const PatchResponse response = law_.evaluate(
      {.patch = patch,
       .elastic_W = elastic,
       .twist_W = motion / step.times.h,
       .inverse_mass = find_inverse_mass(step.middle, patch, memory),
       .slip = find_slip(step.end, last, n),
       .way_by_motion = 2.0});
  points.set(response.wrench, out);
  // What friction takes from the bodies and the bristle does not keep.
  const double kept = end.touches ? respond(step.end, end, memory).energy : 0.0;
  const double lost =
      find_spring_energy(last) - kept - step.times.h * response.friction_power;
  out.dissipation = response.damped + std::max(lost, 0.0) / step.times.h;
}

void PatchPair::commit(const PairBodies& bodies, double t,
                       std::span<double> memory,
                       joints::PairResponse& /*scratch*/) const {
  if (!law_.has_friction()) return;
  const Patch patch = potential_.evaluate(bodies, false);
  if (!patch.touches) {
    save_patch({}, memory);
    return;
  }
  const PatchResponse response = respond(bodies, patch, memory);
  save_patch(remember(bodies, patch.centre_W, t, response.next), memory);
}

joints::PairTouch PatchPair::find_touch(
    const PairBodies& bodies, joints::PairResponse& /*scratch*/) const {
  const Patch patch = potential_.evaluate(bodies, false);
  joints::PairTouch touch;
  touch.depth = patch.touches ? patch.depth : -find_clearance(bodies);
  const Gap gap = patch.depth > kThin * size_
                      ? Gap{}
                      : find_gap({A_.shape, bodies.A}, {B_.shape, bodies.B});
  touch.normal_W = gap.normal_W;
  touch.p_W = 0.5 * (gap.on_A + gap.on_B);
  if (patch.touches && gap.normal_W.isZero(0.0)) {
    touch.normal_W = patch.normal_W();
    touch.p_W = patch.centre_W;
  }
  touch.rate = -touch.normal_W.dot(find_twist(bodies, touch.p_W).head<3>());
  return touch;
}

double PatchPair::find_clearance(const PairBodies& bodies) const {
  return shapes_.find_clearance(bodies);
}

double PatchPair::find_speed_bound(const PairBodies& bodies) const {
  return (bodies.B.v_WB_W - bodies.A.v_WB_W).norm() +
         find_own_speed(A_.shape, {}, bodies.A) +
         find_own_speed(B_.shape, {}, bodies.B);
}

joints::TouchReach PatchPair::find_reach_A() const {
  return find_reach(A_.shape, {});
}

joints::TouchReach PatchPair::find_reach_B() const {
  return find_reach(B_.shape, {});
}

// Three times the way in which the energy of both bodies is stored, over the
// speed: 3.14 of a spring, 2.94 of a ball.
double PatchPair::find_duration(const PairBodies& bodies,
                                const joints::PairTouch& touch,
                                double inverse_mass) const {
  constexpr int kHalvings = 40;
  const double speed = std::max(touch.rate, kLeastSpeed);
  const double energy = 0.5 * speed * speed / inverse_mass;
  PairBody B = bodies.B;
  const auto store = [&](double way) {
    B.p_WB = bodies.B.p_WB - way * touch.normal_W;
    return potential_.evaluate({bodies.A, B}, false).energy;
  };
  double long_way = size_;
  double short_way = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double way = 0.5 * (long_way + short_way);
    (store(way) > energy ? long_way : short_way) = way;
  }
  return 3.0 * long_way / speed;
}

double PatchPair::begin_touch(const PairBodies& bodies, double t,
                              std::span<double> memory,
                              joints::PairResponse& scratch) const {
  const joints::PairTouch touch = find_touch(bodies, scratch);
  if (touch.normal_W.isZero(0.0))
    return std::numeric_limits<double>::infinity();
  NormalLoad load;
  load.add(bodies, touch.p_W, touch.normal_W);
  if (!load_patch(memory).is_touching) {
    save_patch(remember(bodies, touch.p_W, t, {}), memory);
  }
  return find_duration(bodies, touch,
                       mass_.find_inverse(bodies, load, 1.0, memory));
}

void PatchPair::set_mobility(const joints::PairMobility& mobility,
                             std::span<double> memory) const {
  OpposedMass::keep(mobility, memory);
}

void PatchPair::end_touch(std::span<double> memory) const {
  std::fill(memory.begin(), memory.end(), 0.0);
}

// Frequency of a spring with the same force and energy, k = N^2 / (2 W).
joints::TouchReading PatchPair::read(const PairBodies& bodies,
                                     const Instant& /*now*/,
                                     std::span<const double> memory,
                                     joints::PairResponse& /*scratch*/) const {
  constexpr double kMostDamping = 4.0;
  joints::TouchReading reading;
  const Patch patch = potential_.evaluate(bodies, false);
  if (!patch.touches) return reading;
  const PatchResponse response = respond(bodies, patch, memory);
  const double inverse_mass = find_inverse_mass(bodies, patch, memory);
  const double elastic = patch.load();
  reading.normal_force = response.normal_force;
  reading.friction_W = response.friction_W;
  reading.friction_force = response.friction_W.norm();
  reading.normal_W = response.normal_W;
  reading.p_W = patch.centre_W;
  reading.force_W = response.wrench.wrench_W.head<3>();
  reading.depth = patch.depth;
  // Of a flat with this force and energy.
  const double depth = 2.0 * patch.energy / elastic;
  reading.area = std::numbers::pi *
                 std::pow(elastic / (2.0 * potential_.modulus() * depth), 2);
  reading.energy = patch.energy + response.energy;
  // Root mean square of the pressure's rates along the normal.
  const Vector6 twist = find_twist(bodies, patch.centre_W);
  const Vector3 turn = response.normal_W.cross(Vector3(twist.tail<3>()));
  reading.normal_speed =
      std::hypot(response.normal_W.dot(twist.head<3>()),
                 std::sqrt(std::max(turn.dot(patch.spread_W * turn), 0.0)));
  reading.elastic_speed = std::sqrt(2.0 * patch.energy * inverse_mass);
  reading.frequency = elastic * inverse_mass / reading.elastic_speed *
                      std::clamp(law_.damping_factor(), 1.0, kMostDamping);
  reading.points = 1;
  reading.slips = response.slips;
  return reading;
}

}  // namespace limber::contact
