// SPDX-License-Identifier: BSD-3-Clause
// ContactPair over a step of the energy-conserving scheme.
#include <algorithm>
#include <cmath>

#include "limber/contact/contact_pair.hpp"
#include "limber/contact/feature_slots.hpp"
#include "limber/contact/meeting_order.hpp"
#include "limber/contact/point_numbers.hpp"
#include "limber/contact/shapes/shape_measures.hpp"
#include "limber/contact/touch.hpp"
#include "limber/joints/pairs/step_place.hpp"

namespace limber::contact {
namespace {

// Below this share of the change of depth the motion along the normal does not
// determine the force [-].
constexpr double kLeastWay = 0.1;

// A feature of another instant at the present positions of its points.
Meeting carry(const Shape& A, const Shape& B, const joints::PairBodies& bodies,
              const Meeting& known, joints::PairPoint& scratch) {
  const Vector3 p_A = find_point(bodies.A, A, known.on_A, scratch.on_A);
  const Vector3 p_B = find_point(bodies.B, B, known.on_B, scratch.on_B);
  Meeting meeting = known;
  meeting.depth = known.normal_W.dot(p_A - p_B);
  meeting.p_W = 0.5 * (p_A + p_B);
  return meeting;
}

}  // namespace

ElasticPoint ContactPair::find_step_force(const joints::PairStep& step,
                                          const PointMotion& motion,
                                          const joints::PairPoint& point,
                                          const Meeting& begin,
                                          const Meeting& end) const {
  const HertzLaw::StepResponse mean =
      law_.find_law(motion.curvature, motion.residual, motion.share)
          .evaluate_over_step(begin.depth, end.depth);
  const auto first = find_law(begin, begin.share).evaluate(begin.depth);
  const auto last = find_law(end, end.share).evaluate(end.depth);
  ElasticPoint elastic{.force = {mean.force, mean.stiffness, 0.5 * last.force},
                       .energy = 0.5 * (first.energy() + last.energy())};
  // Motion and energies are nearly those of that law: the normal rotates, and
  // curvature and residual vary.
  const Vector3 way = (find_position(step.end.B, point.on_B) -
                       find_position(step.begin.B, point.on_B)) -
                      (find_position(step.end.A, point.on_A) -
                       find_position(step.begin.A, point.on_A));
  const double deepening = -motion.normal_W.dot(way);
  const double work = last.energy() - first.energy();
  if (std::abs(deepening) > kLeastWay * std::abs(end.depth - begin.depth)) {
    elastic.force.force = std::max(work / deepening, 0.0);
  }
  return elastic;
}

void ContactPair::meet(const joints::PairStep& step,
                       std::span<const double> memory, std::span<Meeting> begin,
                       std::span<Meeting> middle,
                       std::span<Meeting> end) const {
  const std::size_t ordered = shapes_.ordered_count();
  if (ordered == end.size()) {
    meet(step.end, kInfinity, memory, end);
    shapes_.find(step.begin, kInfinity, begin);
    shapes_.find(step.middle, kInfinity, middle);
    if (!shapes_.has_loose_features()) return;
    follow(end, begin);
    follow(end, middle);
    return;
  }
  meet(step.begin, kInfinity, memory, begin);
  shapes_.find(step.end, kInfinity, end);
  shapes_.find(step.middle, kInfinity, middle);
  const auto others = [ordered](std::span<Meeting> all) {
    return all.subspan(ordered);
  };
  take_slots(std::span<const Meeting>(others(begin)), size_, others(end));
  take_slots(std::span<const Meeting>(others(end)), size_, others(middle));
}

void ContactPair::evaluate_over_step(const joints::PairStep& step,
                                     std::span<const double> memory,
                                     joints::PairResponse& out) const {
  if (find_clearance(step.begin) > 0.0 && find_clearance(step.end) > 0.0) {
    return;
  }
  Meetings begin(count_features());
  Meetings middle(count_features());
  Meetings end(count_features());
  meet(step, memory, begin.all(), middle.all(), end.all());
  Touch touch(memory);
  if (pads_) {
    add_pads_over_step(step, {begin.all(), middle.all(), end.all()}, memory,
                       touch, out);
  }
  for (std::size_t i = shapes_.pad_count(); i < count_features(); ++i) {
    if (!(begin[i].depth > 0.0) && !(end[i].depth > 0.0)) continue;
    TouchingPoint& at = touch.points.add();
    at.feature = i;
    at.point = out.points().size();
    joints::PairPoint& point = out.add();
    // A feature that exists at one instant only.
    const Meeting& known = end[i].depth > 0.0 ? end[i] : begin[i];
    const auto complete = [&](const joints::PairBodies& bodies,
                              Meeting& meeting) {
      if (meeting.depth != Meeting{}.depth) return;
      meeting = carry(A_.shape, B_.shape, bodies, known, point);
    };
    complete(step.begin, begin.all()[i]);
    complete(step.middle, middle.all()[i]);
    complete(step.end, end.all()[i]);
    at.before = load_memory(numbers_of(i, memory));
    at.motion =
        place(step.middle, middle[i], at.before, step.times.middle(), point);
    centre_over_step(step, point);
    at.elastic = find_step_force(step, at.motion, point, begin[i], end[i]);
    touch.sum(step.middle, middle[i].p_W, at);
  }
  const std::size_t placed = out.points().size();
  respond(step.middle, middle.all(), touch, out);
  for (joints::PairPoint& point : out.points().subspan(placed)) {
    centre_over_step(step, point);  // of a twist
  }
}

// As HertzLaw::evaluate_over_step for all pads together: the mean of the forces
// at both ends, and the remaining energy by the pads' motion.
void ContactPair::add_pads_over_step(const joints::PairStep& step,
                                     const StepMeetings& meetings,
                                     std::span<const double> memory,
                                     Touch& touch,
                                     joints::PairResponse& out) const {
  PadLaw::Response begin;
  PadLaw::Response end;
  evaluate_pads(meetings.begin, begin);
  evaluate_pads(meetings.end, end);
  PadLaw::Response& mean = touch.pads;
  touch.motion.energy = 0.5 * (begin.energy + end.energy);
  mean.force = 0.5 * (begin.force + end.force);
  mean.stiffness = 0.5 * end.stiffness;
  PadLaw::Vector ways = PadLaw::Vector::Zero(mean.force.size());
  joints::PairPoint& scratch = out.add();
  for (std::size_t i = 0; i < shapes_.pad_count(); ++i) {
    const Meeting& middle = meetings.middle[i];
    if (middle.depth == Meeting{}.depth) continue;
    const PointMotion motion =
        place(step.middle, middle, {}, step.times.middle(), scratch);
    centre_over_step(step, scratch);
    const Vector3 way = (find_position(step.end.B, scratch.on_B) -
                         find_position(step.begin.B, scratch.on_B)) -
                        (find_position(step.end.A, scratch.on_A) -
                         find_position(step.begin.A, scratch.on_A));
    ways[static_cast<Eigen::Index>(i)] = -motion.normal_W.dot(way);
  }
  out.clear();
  const double square = ways.squaredNorm();
  if (square > 0.0) {
    const double left = end.energy - begin.energy - mean.force.dot(ways);
    mean.force += left / square * ways;
  }
  for (std::size_t i = 0; i < shapes_.pad_count(); ++i) {
    const auto pad = static_cast<Eigen::Index>(i);
    const Meeting& middle = meetings.middle[i];
    if (middle.depth == Meeting{}.depth) continue;
    if (begin.force[pad] <= 0.0 && end.force[pad] <= 0.0) continue;
    mean.force[pad] = std::max(mean.force[pad], 0.0);
    TouchingPoint& at = touch.points.add();
    at.feature = i;
    at.point = out.points().size();
    at.before = load_memory(numbers_of(i, memory));
    joints::PairPoint& point = out.add();
    at.motion =
        place(step.middle, middle, at.before, step.times.middle(), point);
    centre_over_step(step, point);
    at.elastic.force = {mean.force[pad], mean.stiffness(pad, pad),
                        0.5 * end.force[pad]};
    at.elastic.flat_stiffness =
        pads_->law().uniform_stiffness(static_cast<int>(i));
    touch.sum(step.middle, middle.p_W, at);
  }
}

}  // namespace limber::contact
