// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/patches/patch_moduli.hpp"
#include "limber/contact/patches/patch_sides.hpp"
#include "limber/contact/patches/patch_slip.hpp"
#include "limber/contact/shapes/shape_measures.hpp"
#include "limber/joints/pairs/step_place.hpp"

namespace limber::contact {
namespace {

using joints::PairBodies;
using joints::PairBody;

// Least radius of the points that carry the wrench, of the solids' size [-].
constexpr double kLeastRadius = 1e-2;

// Motion along the normal over all of it, where the correction of the elastic
// wrench over a step turns away from the normal [-].
constexpr double kAcross = 1e-3;

// Round-off of places and of what is found from them, of the places [-].
constexpr double kRounding = 32.0 * std::numeric_limits<double>::epsilon();

constexpr std::size_t kPoints = PatchPoints::kCount;

// Of places of B against A over a step.
std::array<Vector3, kPoints> find_ways(
    const joints::PairStep& step,
    std::span<const joints::PairPoint, kPoints> points) {
  std::array<Vector3, kPoints> ways;
  for (std::size_t i = 0; i < kPoints; ++i) {
    ways[i] = (find_position(step.end.B, points[i].on_B) -
               find_position(step.begin.B, points[i].on_B)) -
              (find_position(step.end.A, points[i].on_A) -
               find_position(step.begin.A, points[i].on_A));
  }
  return ways;
}

// Of places of both bodies in a gap or a way [m].
double find_rounding(const PairBodies& bodies, double size) {
  return kRounding * (size + bodies.A.p_WB.norm() + bodies.B.p_WB.norm());
}

// What an energy balance lacks, but for what may be round-off, which over a
// small motion would be a large force.
double drop_rounding(double lack, double rounding) {
  const double square = lack * lack;
  return square > 0.0 ? lack * square / (square + rounding * rounding) : 0.0;
}

// Against the slip of a step, so that friction's springs do not keep more than
// their motion gave; at most the friction itself.
Vector3 find_force_of_gain(const PatchResponse& response, const Vector6& motion,
                           double gain) {
  const Vector3& n = response.normal_W;
  const Vector3 way = motion.head<3>();
  const Vector3 slip = way - n.dot(way) * n;
  const double most = response.friction_W.norm() * slip.norm();
  if (!(gain > 0.0) || gain > most) return Vector3::Zero();
  return -gain / slip.squaredNorm() * slip;
}

}  // namespace

PatchPair::PatchPair(ContactSide A, ContactSide B,
                     const ContactParameters& parameters)
    : A_(std::move(A)),
      B_(std::move(B)),
      reach_A_(find_mode_reach(A_.shape)),
      reach_B_(find_mode_reach(B_.shape)),
      mass_(A_, B_, parameters),
      parameters_(parameters),
      moduli_(find_patch_moduli(A_, B_, parameters)),
      finder_(make_finder(A_, B_, moduli_.normal, parameters)),
      size_(contact::find_size(A_.shape, B_.shape)),
      law_(parameters, moduli_, finder_->is_point(), size_) {}

void PatchPair::describe_parameters(Manifest& out) const {
  describe(out, A_, B_, parameters_);
}

std::size_t PatchPair::memory_size() const {
  return finder_->count() * kPatchNumbers + OpposedMass::kNumbers;
}

std::size_t PatchPair::most_patches() const {
  return std::min(finder_->count(), kMostPatches);
}

void PatchPair::check(int modes_A, int modes_B) const {
  finder_->check(modes_A, modes_B);
}

// A wrench that does minus the rise of the energy along a motion. What the
// wrench lacks acts along the normal, as the pressure does, unless nearly all
// of the motion is across it.
Vector6 PatchPair::correct(const Vector6& elastic_W, const Patch& patch,
                           const Vector6& motion, double rise,
                           double rounding) const {
  Vector6 weighted = motion;
  weighted.tail<3>() *= size_ * size_;
  weighted =
      PatchLaw::find_approach(patch) * motion + kAcross * kAcross * weighted;
  const double length = motion.dot(weighted);
  if (!(length > 0.0)) return elastic_W;
  const double lack =
      drop_rounding(rise + elastic_W.dot(motion), patch.load() * rounding);
  return elastic_W - lack / length * weighted;
}

// Patches that only the bodies of an end of a step have.
void PatchPair::add_missing(const PairBodies& bodies,
                            const joints::PairResponse& at_bodies,
                            PatchTouches& touches) const {
  const bool has_all =
      std::ranges::all_of(at_bodies.parts(), [&](const joints::PairPart& part) {
        return touches.find(part.index) != nullptr;
      });
  if (has_all) return;
  for (const PatchTouch& other : finder_->find_patches(bodies, true)) {
    if (touches.find(other.index) == nullptr) touches.add(other);
  }
}

double PatchPair::find_energy(const PairBodies& bodies) const {
  double energy = 0.0;
  for (const PatchTouch& touch : finder_->find_patches(bodies, false)) {
    energy += touch.patch.energy;
  }
  return energy;
}

PatchPoints PatchPair::place_points(const Patch& patch) const {
  const Vector3 n = patch.normal_W();
  // Bodies that are deep in each other may have pressures that cancel.
  const double square = std::max(0.0, patch.spread_W.trace());
  return {patch.centre_W, n, std::max(std::sqrt(square), kLeastRadius * size_)};
}

void PatchPair::add_points(const PairBodies& bodies, const PatchTouch& touch,
                           const PatchPoints& points,
                           joints::PairResponse& out) const {
  for (const Vector3& place_W : points.places_W()) {
    finder_->set_places(bodies, touch, place_W, out.add());
  }
}

void PatchPair::add_masses(const PairBodies& bodies,
                           const PatchTouches& touches,
                           std::span<const double> memory,
                           PatchMotion& out) const {
  NormalLoad load;
  double F = 0.0;
  for (const PatchTouch& touch : touches) {
    load.add(bodies, touch.patch.centre_W, -touch.patch.gradient_W.head<3>());
    F += touch.patch.load();
  }
  out.inverse_mass = mass_.find_inverse(bodies, load, F, memory);
  if (!law_.rolls()) return;
  const FrictionFrame frame(load.force_W.normalized());
  for (const Vector3 axis_W : frame.plane_W.colwise()) {
    out.inverse_inertia +=
        0.5 * mass_.find_inverse(bodies,
                                 {.moment_A = axis_W, .moment_B = axis_W}, 1.0,
                                 memory);
  }
}

PatchMotion PatchPair::find_motion(const PairBodies& bodies,
                                   const PatchTouches& touches,
                                   std::span<const double> memory) const {
  PatchMotion all;
  for (const PatchTouch& touch : touches) {
    all.load += touch.patch.load();
    all.energy += touch.patch.energy;
    all.square += PatchLaw::find_square(
        touch.patch, find_twist({touch.A, touch.B}, touch.patch.centre_W));
  }
  add_masses(bodies, touches, memory, all);
  return all;
}

PatchResponse PatchPair::respond(const PatchTouch& touch,
                                 const PatchMotion& all,
                                 std::span<const double> memory) const {
  const Patch& patch = touch.patch;
  const PairBodies parts{touch.A, touch.B};
  return law_.evaluate(
      {.patch = patch,
       .elastic_W = -patch.gradient_W,
       .twist_W = find_twist(parts, patch.centre_W),
       .all = all,
       .slip = find_slip(parts, load_patch(find_slot(memory, touch.index)))});
}

// What friction's springs had where bodies no longer touch, since then [W].
double PatchPair::find_released(const PatchTouches& touches, double t,
                                std::span<const double> memory) const {
  double power = 0.0;
  if (!law_.has_friction()) return power;
  for (std::size_t i = 0; i < finder_->count(); ++i) {
    const std::span<const double> slot = find_slot(memory, i);
    if (!is_touching(slot) || touches.find(i) != nullptr) continue;
    const PatchMemory last = load_patch(slot);
    if (!(t > last.time)) continue;
    power += law_.find_energy(last.friction) / (t - last.time);
  }
  return power;
}

void PatchPair::evaluate(const PairBodies& bodies, const EvaluationTime& now,
                         std::span<const double> memory,
                         joints::PairResponse& out) const {
  const PatchTouches touches = finder_->find_patches(bodies, true);
  out.slip_power += find_released(touches, now.t, memory);
  if (touches.is_empty()) return;
  const PatchMotion all = find_motion(bodies, touches, memory);
  for (const PatchTouch& touch : touches) {
    const PatchResponse response = respond(touch, all, memory);
    const PatchPoints points = place_points(touch.patch);
    add_points(bodies, touch, points, out);
    points.set(response.wrench, out.points().size() - kPoints, out);
    out.energy += touch.patch.energy + response.energy;
    out.add_part(
        {touch.index, touch.patch.energy, response.energy, touch.A, touch.B});
    const double h = now.t - load_patch(find_slot(memory, touch.index)).time;
    if (h > 0.0) out.slip_power += response.slip_work / h;
    out.rubbed += response.rubbed;
    out.dissipation += response.damped + response.rubbed;
  }
}

void PatchPair::evaluate_over_step(const joints::PairStep& step,
                                   std::span<const double> memory,
                                   joints::PairResponse& out) const {
  PatchTouches touches = finder_->find_patches(step.middle, true);
  const std::size_t of_middle = touches.size();
  add_missing(step.begin, step.at_begin, touches);
  add_missing(step.end, step.at_end, touches);
  out.slip_power += find_released(touches, step.times.end, memory);
  if (touches.is_empty()) return;
  PatchMotion all;
  add_masses(step.middle, touches, memory, all);
  std::array<Vector6, kMostPatches> motions;
  std::size_t i = 0;
  for (const PatchTouch& touch : touches) {
    const PatchPoints points = place_points(touch.patch);
    add_points(step.middle, touch, points, out);
    for (joints::PairPoint& point : out.points().last<kPoints>()) {
      centre_over_step(step, point);
    }
    const Vector6 motion =
        points.find_motion(find_ways(step, out.points().last<kPoints>()));
    all.load += touch.patch.load();
    all.energy += touch.patch.energy;
    all.square += PatchLaw::find_square(touch.patch, motion / step.times.h);
    motions[i++] = motion;
  }
  const double rounding = find_rounding(step.middle, size_);
  i = 0;
  for (const PatchTouch& touch : touches) {
    const joints::PairPart* first = step.at_begin.find_part(touch.index);
    const joints::PairPart* last = step.at_end.find_part(touch.index);
    const double rise = (last != nullptr ? last->elastic_energy : 0.0) -
                        (first != nullptr ? first->elastic_energy : 0.0);
    const PatchMemory before = load_patch(find_slot(memory, touch.index));
    const PairBodies parts{last ? last->A : touch.A, last ? last->B : touch.B};
    const double fraction = i < of_middle ? 1.0 : 0.5;
    PatchResponse response = law_.evaluate(
        {.patch = touch.patch,
         .elastic_W = correct(-fraction * touch.patch.gradient_W, touch.patch,
                              motions[i], rise, rounding),
         .twist_W = motions[i] / step.times.h,
         .all = all,
         .slip = find_slip(parts, before),
         .way_by_motion = 2.0});
    // What friction takes from the bodies and its springs do not keep.
    const double kept = last != nullptr ? last->friction_energy : 0.0;
    const double lost = law_.find_energy(before.friction) - kept -
                        step.times.h * response.friction_power;
    response.wrench.wrench_W.head<3>() += find_force_of_gain(
        response, motions[i],
        drop_rounding(-lost, response.friction_W.norm() * rounding));
    place_points(touch.patch).set(response.wrench, kPoints * i++, out);
    const double rubbed = std::max(lost, 0.0) / step.times.h;
    out.rubbed += rubbed;
    out.dissipation += response.damped + rubbed;
  }
}

void PatchPair::commit(const PairBodies& bodies, double t,
                       std::span<double> memory,
                       joints::PairResponse& /*scratch*/) const {
  if (!law_.has_friction()) return;
  const PatchTouches touches = finder_->find_patches(bodies, true);
  PatchMotion all;
  if (!touches.is_empty()) all = find_motion(bodies, touches, memory);
  for (std::size_t i = 0; i < finder_->count(); ++i) {
    const PatchTouch* touch = touches.find(i);
    const std::span<double> slot = find_slot(memory, i);
    if (touch == nullptr) {
      if (is_touching(slot)) save_patch({}, slot);
      continue;
    }
    const PatchResponse response = respond(*touch, all, memory);
    save_patch(
        remember({touch->A, touch->B}, touch->patch.centre_W, t, response.next),
        slot);
  }
}

}  // namespace limber::contact
