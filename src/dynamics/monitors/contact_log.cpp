// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/contact_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/dynamics/monitors/impact_spectrum.hpp"
#include "limber/dynamics/monitors/joint_response.hpp"

namespace limber::dynamics {
namespace {

Vector3 find_rigid_velocity(const joints::PairBody& body, const Vector3& p_W) {
  const Vector3 w_W = body.R_WB * body.w_WB_B;
  return body.v_WB_W + w_W.cross(p_W - body.p_WB);
}

}  // namespace

ContactLog::ContactLog(const SystemModel& model, IntegratorKind scheme)
    : model_(model), scheme_(scheme) {}

double ContactLog::find_approach(const Pair& pair, const SystemState& state,
                                 const Vector3& p_W,
                                 const Vector3& normal_W) const {
  const PairMotion motion = find_pair_motion(model_, pair, state);
  const joints::PairBodies bodies = motion.bodies();
  return normal_W.dot(find_rigid_velocity(bodies.A, p_W) -
                      find_rigid_velocity(bodies.B, p_W));
}

void ContactLog::begin(std::size_t i, const SystemState& state,
                       TouchWatch& touches) {
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
  record = {.pair = of.name, .time = state.t, .touches = 1};
  record.impact_duration = touches.impact_duration(i);
  record.touch_speed = find_approach(of, state, touch.p_W, touch.normal_W);
}

void ContactLog::include(std::size_t i, const SystemState& state,
                         TouchWatch& touches, double h) {
  OngoingContact& pair = pairs_[i];
  ContactRecord& record = pair.record;
  const bool touched = pair.is_touching;
  const bool touches_now = touches.is_touching(i);
  if (!touched && !touches_now) return;
  joints::TouchReading now;
  if (touches_now) now = touches.read(i, state);
  if (!touched) begin(i, state, touches);
  if (touched) {
    record.impulse += 0.5 * h * (pair.force + now.normal_force);
  }
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
  if (is_strongest) keep_stiffest(state, record);
  pair.force = now.normal_force;
  pair.is_touching = touches_now;
  record.has_parted = !touches_now;
  record.duration = state.t - record.time;
  if (touches_now) return;
  pair.left = state.t;
  const joints::PairTouch touch = touches.find_touch(i, state);
  record.parting_speed = -find_approach(model_.pairs[touches.pair_of(i)], state,
                                        touch.p_W, touch.normal_W);
}

void ContactLog::include(const SystemState& state, TouchWatch& touches) {
  pairs_.resize(touches.count());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    include(i, state, touches, state.t - time_);
  }
  time_ = state.t;
}

void ContactLog::keep_stiffest(const SystemState& state,
                               const ContactRecord& record) {
  if (traits_of(scheme_).is_implicit) return;
  if (!(record.peak_force > strongest_.peak_force)) return;
  stiffest_ = state;
  strongest_ = record;
}

std::vector<ContactRecord> ContactLog::find_records() const {
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

void ContactLog::add_warnings(std::vector<std::string>& warnings) const {
  const std::vector<ContactRecord> records = find_records();
  for (const ImpactSpectrum& spectrum : find_impact_spectra(model_, records)) {
    if (!spectrum.is_enough()) warnings.push_back(describe(spectrum));
  }
  for (const JointResponse& joint : find_joint_responses(model_, records)) {
    if (!joint.is_enough()) warnings.push_back(describe(joint));
  }
  add_deep(records, warnings);
  add_unmet(records, warnings);
  add_stable_step(warnings);
}

void ContactLog::add_deep(const std::vector<ContactRecord>& records,
                          std::vector<std::string>& warnings) const {
  std::set<std::string> said;
  for (const ContactRecord& record : records) {
    const double over_extent = record.peak_depth / find_extent(record.pair);
    const double over_radius = record.peak_depth_over_radius;
    const bool is_round = over_radius > kDeepest;
    if (!is_round && !(over_extent > kDeepest)) continue;
    if (!said.insert(record.pair).second) continue;
    warnings.push_back(fmt::format(
        "contact '{}': the impact at t = {:.6g} s is {:.3g} m deep, {:.2g} of "
        "the {}; Hertz's law is that of small deformation: beyond {:g} do not "
        "trust its force and energy",
        record.pair, record.time, record.peak_depth,
        is_round ? over_radius : over_extent,
        is_round ? "radius of curvature" : "smaller body's extent", kDeepest));
  }
}

// Once per pair, for touches without a common normal (Touching::begin_touch).
void ContactLog::add_unmet(const std::vector<ContactRecord>& records,
                           std::vector<std::string>& warnings) const {
  std::set<std::string> said;
  for (const ContactRecord& record : records) {
    if (!std::isinf(record.impact_duration)) continue;
    if (!said.insert(record.pair).second) continue;
    warnings.push_back(fmt::format(
        "contact '{}': at t = {:.6g} s surfaces meet that do not face each "
        "other, as where an open one is met from behind: there is no force, "
        "and both may pass through each other",
        record.pair, record.time));
  }
}

// Extent of the smaller body of a pair, from its origin [m].
double ContactLog::find_extent(const std::string& pair) const {
  const auto found =
      std::find_if(model_.pairs.begin(), model_.pairs.end(),
                   [&pair](const Pair& other) { return other.name == pair; });
  const joints::Touching& touching = *found->law->touching();
  return std::min(touching.find_reach_A().extent,
                  touching.find_reach_B().extent);
}

void ContactLog::add_stable_step(std::vector<std::string>& warnings) const {
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

void ContactLog::exchange_memory(Archive& archive) {
  archive(pairs_, finished_, time_, stiffest_, strongest_);
}

}  // namespace limber::dynamics
