// SPDX-License-Identifier: BSD-3-Clause
// PatchPair as Touching: where it touches, begins and ends, and what it reads.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/contact/law/impact_estimate.hpp"
#include "limber/contact/law/pressure_sum.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/patches/patch_slip.hpp"
#include "limber/contact/shapes/shape_measures.hpp"

namespace limber::contact {
namespace {

using joints::PairBodies;
using joints::PairBody;

// Slower touches begin as one of this speed [m/s].
constexpr double kLeastSpeed = 1e-5;
// Depth of a patch whose normal may be round-off, of the solids' size [-].
constexpr double kThin = 1e-10;

}  // namespace

struct PatchPair::Nearest {
  joints::PairTouch touch;
  std::size_t index = 0;  // of the pair of parts
  PairBody A;             // both parts, as bodies without modes
  PairBody B;
};

// The deepest patch, or else the parts that are nearest to each other.
PatchPair::Nearest PatchPair::find_nearest_parts(
    const PairBodies& bodies) const {
  const PatchTouches touches = finder_->find_patches(bodies, true);
  const PatchTouch* deepest =
      std::max_element(touches.begin(), touches.end(),
                       [](const PatchTouch& a, const PatchTouch& b) {
                         return a.patch.depth < b.patch.depth;
                       });
  Nearest nearest;
  joints::PairTouch& touch = nearest.touch;
  const auto take_gap = [&touch](const SolidGap& gap) {
    touch.normal_W = gap.normal_W;
    touch.p_W = 0.5 * (gap.on_A + gap.on_B);
  };
  if (deepest != touches.end()) {
    const Patch& patch = deepest->patch;
    nearest.index = deepest->index;
    nearest.A = deepest->A;
    nearest.B = deepest->B;
    touch.depth = patch.depth;
    touch.normal_W = patch.normal_W();
    touch.p_W = patch.centre_W;
    if (patch.depth <= kThin * size_) {  // the normal may be round-off
      const SolidGap gap = finder_->find_pair(bodies, nearest.index).gap;
      if (!gap.normal_W.isZero(0.0)) take_gap(gap);
    }
  } else {
    const PatchFinder::Nearest apart = finder_->find_nearest(bodies);
    nearest.index = apart.index;
    nearest.A = apart.A;
    nearest.B = apart.B;
    touch.depth = -std::max(apart.gap.distance, 0.0);
    touch.is_enclosed =
        apart.gap.normal_W.isZero(0.0) && !(apart.gap.distance > 0.0);
    take_gap(apart.gap);
    if (touch.is_enclosed) touch.p_W = nearest.B.p_WB;
  }
  touch.rate = -touch.normal_W.dot(
      find_twist({nearest.A, nearest.B}, touch.p_W).head<3>());
  return nearest;
}

joints::PairTouch PatchPair::find_touch(
    const PairBodies& bodies, joints::PairResponse& /*scratch*/) const {
  return find_nearest_parts(bodies).touch;
}

double PatchPair::find_clearance(const PairBodies& bodies) const {
  return std::max(finder_->find_distance(bodies), 0.0);
}

double PatchPair::find_speed_bound(const PairBodies& bodies) const {
  return (bodies.B.v_WB_W - bodies.A.v_WB_W).norm() +
         find_own_speed(A_.shape, reach_A_, bodies.A) +
         find_own_speed(B_.shape, reach_B_, bodies.B);
}

joints::TouchReach PatchPair::find_reach_A() const {
  return find_reach(A_.shape, reach_A_);
}

joints::TouchReach PatchPair::find_reach_B() const {
  return find_reach(B_.shape, reach_B_);
}

// The way in which the energy of both bodies is stored, over the speed, times
// kHertzDuration of balls, and 3 of others: pi of flats, less of edges.
double PatchPair::find_duration(const PairBodies& bodies,
                                const joints::PairTouch& touch,
                                double inverse_mass) const {
  constexpr int kHalvings = 40;
  const double speed = std::max(touch.rate, kLeastSpeed);
  const double energy = 0.5 * speed * speed / inverse_mass;
  PairBody B = bodies.B;
  const auto store = [&](double way) {
    B.p_WB = bodies.B.p_WB - way * touch.normal_W;
    return find_energy(PairBodies{bodies.A, B});
  };
  double long_way = kThin * size_;
  while (long_way < size_ && store(long_way) < energy) long_way *= 2.0;
  double short_way = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double way = 0.5 * (long_way + short_way);
    (store(way) > energy ? long_way : short_way) = way;
  }
  return (law_.is_point() ? kHertzDuration : 3.0) * long_way / speed;
}

double PatchPair::begin_touch(const PairBodies& bodies, double t,
                              std::span<double> memory,
                              joints::PairResponse& /*scratch*/) const {
  const Nearest nearest = find_nearest_parts(bodies);
  const joints::PairTouch& touch = nearest.touch;
  if (touch.normal_W.isZero(0.0))
    return std::numeric_limits<double>::infinity();
  NormalLoad load;
  load.add(bodies, touch.p_W, touch.normal_W);
  const std::span<double> slot = find_slot(memory, nearest.index);
  if (!load_patch(slot).is_touching) {
    const PairBodies parts{nearest.A, nearest.B};
    save_patch(remember(parts, touch.p_W, t,
                        keep_friction({}, FrictionFrame(touch.normal_W),
                                      {parts.A.R_WB, parts.B.R_WB})),
               slot);
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
                                     const EvaluationTime& /*now*/,
                                     std::span<const double> memory,
                                     joints::PairResponse& /*scratch*/) const {
  constexpr double kMostDamping = 4.0;
  joints::TouchReading reading;
  const PatchTouches touches = finder_->find_patches(bodies, true);
  if (touches.is_empty()) return reading;
  const PatchMotion all = find_motion(bodies, touches, memory);
  Vector3 normals = Vector3::Zero();
  PressureSum pressure;
  for (const PatchTouch& touch : touches) {
    const Patch& patch = touch.patch;
    const PatchResponse response = respond(touch, all, memory);
    const double elastic = patch.load();
    reading.normal_force += response.normal_force;
    reading.friction_W += response.friction_W;
    reading.force_W += response.wrench.wrench_W.head<3>();
    normals += elastic * response.normal_W;
    pressure.add(elastic, patch.centre_W, patch.spread_W);
    reading.depth = std::max(reading.depth, patch.depth - patch.series_depth);
    // Of a round flat, or a ball, with this force and energy.
    const double p = patch.exponent;
    const double depth =
        (p + 1.0) * (patch.energy - patch.series_energy) / elastic;
    const double modulus = finder_->modulus(touch.index);
    reading.area +=
        std::numbers::pi * std::pow(p * elastic / (2.0 * modulus * depth), 2);
    reading.energy += patch.energy + response.energy;
    reading.series_energy += patch.series_energy;
    reading.slips = reading.slips || response.slips;
    ++reading.points;
  }
  reading.friction_force = reading.friction_W.norm();
  reading.normal_W = normals.normalized();
  reading.p_W = pressure.centre_W();
  reading.spread_W = pressure.spread_W();
  // Root mean square of the pressure's rates along the normals.
  reading.normal_speed = std::sqrt(std::max(all.square, 0.0) / all.load);
  reading.elastic_speed = std::sqrt(2.0 * all.energy * all.inverse_mass);
  reading.frequency = all.load * all.inverse_mass / reading.elastic_speed *
                      std::clamp(law_.damping_factor(), 1.0, kMostDamping);
  return reading;
}

}  // namespace limber::contact
