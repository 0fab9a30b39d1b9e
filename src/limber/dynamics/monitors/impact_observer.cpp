// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/impact_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/dynamics/monitors/impact_spectrum.hpp"
#include "limber/dynamics/monitors/joint_response.hpp"

namespace limber::dynamics {
namespace {

PairVelocities find_velocities(const joints::PairBodies& bodies) {
  return {bodies.B.v_WB_W - bodies.A.v_WB_W, bodies.A.R_WB * bodies.A.w_WB_B,
          bodies.B.R_WB * bodies.B.w_WB_B};
}

// Of A against B along a line at arms from both, towards B [m/s].
double find_approach(const PairVelocities& velocities, const Vector3& arm_A_W,
                     const Vector3& arm_B_W, const Vector3& normal_W) {
  return normal_W.dot(velocities.w_A_W.cross(arm_A_W) -
                      velocities.w_B_W.cross(arm_B_W) - velocities.v_WB_W);
}

double find_approach(const PairVelocities& velocities,
                     const NormalImpulse& along) {
  return find_approach(velocities, along.arm_A_W / along.sum,
                       along.arm_B_W / along.sum, along.impulse_W.normalized());
}

NormalImpulse find_load(const joints::PairBodies& bodies,
                        const joints::TouchReading& now) {
  const double N = now.normal_force;
  return {N, N * now.normal_W, N * (now.p_W - bodies.A.p_WB),
          N * (now.p_W - bodies.B.p_WB)};
}

void add(const NormalImpulse& load, double h, NormalImpulse& out) {
  out.sum += h * load.sum;
  out.impulse_W += h * load.impulse_W;
  out.arm_A_W += h * load.arm_A_W;
  out.arm_B_W += h * load.arm_B_W;
}

constexpr double kLeastImpactSpeed = 1e-9;  // [m/s]

// Of a pair since the start; the error is what steps lose that no law does.
ImpactEnergy find_energies(const EnergyObserver::PairStep& step,
                           const EnergyFlows& flows, Eigen::Index pair) {
  const Eigen::Index row =
      std::ssize(flows.dissipated) - std::ssize(flows.damped) + pair;
  const double damped = flows.damped[pair];
  const double rubbed = flows.rubbed[pair];
  return {.returned = step.returned,
          .stored = step.stored,
          .damped = damped,
          .rubbed = rubbed,
          .error = damped + rubbed - flows.dissipated[row]};
}

// What two sums agree on.
double find_common(double a, double b) {
  if ((a < 0.0) != (b < 0.0)) return 0.0;
  return std::abs(a) < std::abs(b) ? a : b;
}

const char* advise_on_impacts(IntegratorKind scheme) {
  if (scheme == IntegratorKind::implicit_euler) {
    return "use shorter steps or generalized-alpha";
  }
  return scheme == IntegratorKind::energy_conserving
             ? "use shorter steps or more impact_steps"
             : "use shorter steps, more impact_steps or energy-conserving";
}

}  // namespace

ImpactObserver::ImpactObserver(const SystemModel& model, IntegratorKind scheme,
                               double h)
    : model_(model),
      scheme_(scheme),
      rest_speed_(std::max(h * model.gravity_W.norm(), kLeastImpactSpeed)) {}

void ImpactObserver::begin(std::size_t i, const SystemState& state,
                           ContactStartObserver& touches) {
  OngoingContact& pair = pairs_[i];
  ContactRecord& record = pair.record;
  pair.is_touching = true;
  const double lasted = pair.left - record.time;
  const bool is_met = std::isfinite(touches.impact_duration(i));
  if (is_met && record.touches > 0 && state.t - pair.left <= lasted) {
    ++record.touches;
    return;
  }
  if (record.touches > 0) finished_.push_back(record);
  const Pair& of = model_.pairs[touches.pair_of(i)];
  const joints::PairTouch touch = touches.find_touch(i, state);
  pair.most_force = {};
  pair.most_depth = {};
  pair.own_error = pair.group_error = 0.0;
  pair.impulse = {};
  record = {.pair = of.name, .time = state.t, .touches = 1};
  record.rest_speed = rest_speed_;
  record.impact_duration = touches.impact_duration(i);
  const joints::PairBodies bodies = touches.find_bodies(i, state);
  pair.at_touch = find_velocities(bodies);
  record.touch_speed = find_approach(pair.at_touch, touch.p_W - bodies.A.p_WB,
                                     touch.p_W - bodies.B.p_WB, touch.normal_W);
}

void ImpactObserver::include(std::size_t i, const SystemState& state,
                             ContactStartObserver& touches, double h) {
  OngoingContact& pair = pairs_[i];
  ContactRecord& record = pair.record;
  const bool touched = pair.is_touching;
  const bool touches_now = touches.is_touching(i);
  if (!touched && !touches_now) return;
  joints::TouchReading now;
  if (touches_now) now = touches.read(i, state);
  if (!touched) begin(i, state, touches);
  if (touched) add(pair.load, 0.5 * h, pair.impulse);
  pair.load = {};
  if (now.normal_force > 0.0) {
    pair.load = find_load(touches.find_bodies(i, state), now);
  }
  if (touched) add(pair.load, 0.5 * h, pair.impulse);
  record.impulse = pair.impulse.sum;
  const bool is_strongest = now.normal_force > record.peak_force;
  pair.most_force.include(now.normal_force, state.t);
  pair.most_depth.include(now.depth, state.t);
  record.peak_force = pair.most_force.peak().value;
  record.peak_time = pair.most_force.peak().time;
  record.peak_depth = pair.most_depth.peak().value;
  if (now.area > 0.0) {
    record.peak_depth_over_radius =
        std::max(record.peak_depth_over_radius,
                 std::numbers::pi * now.depth * now.depth / now.area);
  }
  if (now.series_energy > pair.series_fraction * now.energy) {
    pair.series_fraction = now.series_energy / now.energy;
    pair.series_time = state.t;
  }
  if (is_strongest) keep_stiffest(state, record);
  pair.is_touching = touches_now;
  record.has_parted = !touches_now;
  record.duration = state.t - record.time;
  if (touches_now) return;
  pair.left = state.t;
  if (!(pair.impulse.sum > 0.0)) return;
  record.approach_speed = find_approach(pair.at_touch, pair.impulse);
  record.parting_speed = -find_approach(
      find_velocities(touches.find_bodies(i, state)), pair.impulse);
}

void ImpactObserver::balance(std::size_t i, std::size_t of, bool touched,
                             double t, const StepObserver& step_observer,
                             const EnergyFlows& flows) {
  OngoingContact& pair = pairs_[i];
  ImpactEnergy& energy = pair.record.energy;
  const EnergyObserver::PairStep step = step_observer.find_pair_step(of);
  const ImpactEnergy now =
      find_energies(step, flows, static_cast<Eigen::Index>(of));
  const bool is_new = !touched && pair.record.touches == 1;
  if (is_new) pair.before = now;
  if (touched && step.time == t) {
    pair.own_error += step.own_error;
    pair.group_error += step.group_error;
  }
  energy.returned = now.returned - pair.before.returned;
  energy.stored = now.stored - pair.before.stored;
  energy.damped = now.damped - pair.before.damped;
  energy.rubbed = now.rubbed - pair.before.rubbed;
  energy.error = now.error - pair.before.error +
                 find_common(pair.own_error, pair.group_error);
  energy.roundoff = step.roundoff;
  energy.in = energy.stored + energy.returned + energy.damped + energy.rubbed -
              energy.error;
}

void ImpactObserver::include(const SystemState& state,
                             ContactStartObserver& touches,
                             const StepObserver& step_observer,
                             const EnergyFlows& flows) {
  pairs_.resize(touches.count());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const bool touched = pairs_[i].is_touching;
    include(i, state, touches, state.t - time_);
    if (!touched && !pairs_[i].is_touching) continue;
    balance(i, touches.pair_of(i), touched, state.t, step_observer, flows);
  }
  time_ = state.t;
}

void ImpactObserver::keep_stiffest(const SystemState& state,
                                   const ContactRecord& record) {
  if (traits_of(scheme_).is_implicit) return;
  if (!(record.peak_force > strongest_.peak_force)) return;
  stiffest_ = state;
  strongest_ = record;
}

std::vector<ContactRecord> ImpactObserver::find_records() const {
  std::vector<ContactRecord> records = finished_;
  for (const OngoingContact& pair : pairs_) {
    if (pair.record.touches > 0) records.push_back(pair.record);
  }
  std::stable_sort(records.begin(), records.end(),
                   [](const ContactRecord& a, const ContactRecord& b) {
                     return a.time < b.time;
                   });
  return records;
}

void ImpactObserver::add_warnings(std::vector<std::string>& warnings) const {
  const std::vector<ContactRecord> records = find_records();
  for (const ImpactSpectrum& spectrum : find_impact_spectra(model_, records)) {
    if (!spectrum.is_enough()) warnings.push_back(describe(spectrum));
  }
  for (const JointResponse& joint : find_joint_responses(model_, records)) {
    if (!joint.is_enough()) warnings.push_back(describe(joint));
  }
  add_deep(records, warnings);
  add_soft(warnings);
  add_unbalanced(records, warnings);
  add_unmet(records, warnings);
  add_stable_step(warnings);
}

void ImpactObserver::add_deep(const std::vector<ContactRecord>& records,
                              std::vector<std::string>& warnings) const {
  std::set<std::string> reported;
  for (const ContactRecord& record : records) {
    const double over_extent = record.peak_depth / find_extent(record.pair);
    const double over_radius = record.peak_depth_over_radius;
    const bool is_round = over_radius > kDeepest;
    if (!is_round && !(over_extent > kDeepest)) continue;
    if (!reported.insert(record.pair).second) continue;
    warnings.push_back(fmt::format(
        "contact '{}': the impact at t = {:.6g} s penetrates by {:.3g} m, "
        "{:.2g} of the {}; Hertz's law assumes small deformation: beyond {:g} "
        "its force and energy are not reliable",
        record.pair, record.time, record.peak_depth,
        is_round ? over_radius : over_extent,
        is_round ? "radius of curvature" : "smaller body's extent", kDeepest));
  }
}

// Of bodies that yield more by what their modes leave out than by the surfaces.
void ImpactObserver::add_soft(std::vector<std::string>& warnings) const {
  for (const OngoingContact& pair : pairs_) {
    if (!(pair.series_fraction > kSoftest)) continue;
    warnings.push_back(fmt::format(
        "contact '{}': at t = {:.6g} s {:.2g} % of its energy is in "
        "deformation that the modes leave out, which has no inertia; use more "
        "modes, until force and duration no longer change",
        pair.record.pair, pair.series_time, 100.0 * pair.series_fraction));
  }
}

// Once per pair, of its worst impact.
void ImpactObserver::add_unbalanced(const std::vector<ContactRecord>& records,
                                    std::vector<std::string>& warnings) const {
  struct Worst {
    const ContactRecord* record = nullptr;
    int impacts = 0;
    int open = 0;
  };
  std::map<std::string, Worst> pairs;
  for (const ContactRecord& record : records) {
    if (!record.is_impact()) continue;
    Worst& worst = pairs[record.pair];
    const double fraction = record.energy.unbalanced_fraction();
    ++worst.impacts;
    if (!(fraction > kReportedDrift)) continue;
    ++worst.open;
    if (worst.record == nullptr ||
        fraction > worst.record->energy.unbalanced_fraction()) {
      worst.record = &record;
    }
  }
  for (const auto& [name, worst] : pairs) {
    if (worst.record == nullptr) continue;
    const ImpactEnergy& energy = worst.record->energy;
    warnings.push_back(fmt::format(
        "contact '{}': energy error in the impact at t = {:.6g} s: {:.3g} J "
        "{}, {:.3g} % of its {:.3g} J, so that its restitution is not met; {} "
        "of {} impacts have more than {:g} %; {}",
        name, worst.record->time, std::abs(energy.error),
        energy.error < 0.0 ? "lost" : "gained",
        100.0 * energy.unbalanced_fraction(),
        std::max(energy.in, energy.returned), worst.open, worst.impacts,
        100.0 * kReportedDrift, advise_on_impacts(scheme_)));
  }
}

// Once per pair, for touches without a common normal (Touching::begin_touch).
void ImpactObserver::add_unmet(const std::vector<ContactRecord>& records,
                               std::vector<std::string>& warnings) const {
  std::set<std::string> reported;
  for (const ContactRecord& record : records) {
    if (!std::isinf(record.impact_duration)) continue;
    if (!reported.insert(record.pair).second) continue;
    warnings.push_back(fmt::format(
        "contact '{}': at t = {:.6g} s the surfaces in contact do not face "
        "each other, for example an open surface hit from behind: no force "
        "acts, and the bodies may pass through each other",
        record.pair, record.time));
  }
}

// Extent of the smaller body of a pair, from its origin [m].
double ImpactObserver::find_extent(const std::string& pair) const {
  const auto found =
      std::find_if(model_.pairs.begin(), model_.pairs.end(),
                   [&pair](const Pair& other) { return other.name == pair; });
  const joints::Touching& touching = *found->law->touching();
  return std::min(touching.find_reach_A().extent,
                  touching.find_reach_B().extent);
}

void ImpactObserver::add_stable_step(std::vector<std::string>& warnings) const {
  if (!(strongest_.peak_force > 0.0)) return;
  const bool is_known = scheme_ != IntegratorKind::explicit_euler;
  const double longest = is_known ? find_stable_step(model_, stiffest_, scheme_)
                                  : find_stable_step(model_, stiffest_);
  warnings.push_back(fmt::format(
      "contact '{}': {} is stable up to {:.3g} s at t = {:.6g} s, where its "
      "force is largest, {:.4g} N",
      strongest_.pair, is_known ? to_string(scheme_) : "an explicit scheme",
      longest, strongest_.peak_time, strongest_.peak_force));
}

void ImpactObserver::exchange_memory(Archive& archive) {
  archive(pairs_, finished_, time_, stiffest_, strongest_);
}

}  // namespace limber::dynamics
