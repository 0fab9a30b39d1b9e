// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/transmission.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::dynamics {
namespace {

// A segment of a path from one point to the next.
struct Stretch {
  Vector3 direction;
  double length;
  double rate;
};

Stretch find_stretch(const Vector3& from, const Vector3& to,
                     const Vector3& v_from, const Vector3& v_to) {
  const Vector3 line = to - from;
  const double length = line.norm();
  if (!(length > 0.0)) {
    throw NumericalError(
        "two points of its path meet, so that the stretch between them has no "
        "direction");
  }
  const Vector3 direction = line / length;
  return {direction, length, direction.dot(v_to - v_from)};
}

void calc_path(const PathCoordinate& path, const SystemTerms& terms,
               TransmissionTerms& out) {
  for (Vector6& gradient : out.gradients) gradient.setZero();
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const AttachmentMotion& from = terms.attachments[index(path.points[i])];
    const AttachmentMotion& to = terms.attachments[index(path.points[i + 1])];
    const Stretch stretch =
        find_stretch(from.p_WF, to.p_WF, from.v_WF_W, to.v_WF_W);
    out.motion.z += stretch.length;
    out.motion.rate += stretch.rate;
    out.gradients[i].head<3>() -= stretch.direction;
    out.gradients[i + 1].head<3>() += stretch.direction;
  }
}

joints::CoordinateValue evaluate_term(const SystemModel& model,
                                      const SystemState& state,
                                      const JointSum::Term& term,
                                      const joints::RelativeMotion& motion) {
  const auto c = index(term.coupler);
  const auto i = index(term.coordinate);
  return joints::evaluate(joints::coordinates_of(model.couplers[c].law)[i],
                          motion, state.memory[c].near[i]);
}

}  // namespace

std::vector<TransmissionTerms> make_transmission_terms(
    const SystemModel& model) {
  std::vector<TransmissionTerms> all;
  for (const Transmission& transmission : model.transmissions) {
    TransmissionTerms terms;
    terms.gradients.resize(std::visit(
        Overloaded{
            [](const PathCoordinate& path) { return path.points.size(); },
            [](const JointSum& sum) { return sum.terms.size(); }},
        transmission.coordinate));
    all.push_back(std::move(terms));
  }
  return all;
}

void calc_coordinate(const SystemModel& model, const SystemState& state,
                     const Transmission& transmission, const SystemTerms& terms,
                     TransmissionTerms& out) {
  out.motion = {};
  if (const auto* path =
          std::get_if<PathCoordinate>(&transmission.coordinate)) {
    calc_path(*path, terms, out);
    return;
  }
  const auto& sum = std::get<JointSum>(transmission.coordinate);
  out.motion.z = -sum.offset;
  for (std::size_t i = 0; i < sum.terms.size(); ++i) {
    const JointSum::Term& term = sum.terms[i];
    const joints::CoordinateValue value = evaluate_term(
        model, state, term, terms.couplers[index(term.coupler)].motion);
    out.motion.z += term.factor * value.z;
    out.motion.rate += term.factor * value.rate;
    out.gradients[i] = term.factor * value.gradient;
  }
}

joints::ScalarResponse evaluate_laws(const Transmission& transmission,
                                     const joints::ScalarMotion& motion,
                                     const joints::CouplerMemory& memory,
                                     const EvaluationTime& now) {
  joints::ScalarResponse sum;
  std::size_t first = 0;  // of a law's switches
  for (const joints::ScalarLaw& law : transmission.laws) {
    sum += joints::evaluate(
        law, motion, now, {memory.switches[first], memory.switches[first + 1]});
    first += index(joints::switch_count(law));
  }
  return sum;
}

joints::ScalarMotion find_motion(const SystemModel& model,
                                 const SystemState& state,
                                 const Transmission& transmission) {
  joints::ScalarMotion motion;
  if (const auto* path =
          std::get_if<PathCoordinate>(&transmission.coordinate)) {
    FrameMotion from = find_frame_motion(model, state, path->points[0]);
    for (std::size_t i = 1; i < path->points.size(); ++i) {
      const FrameMotion to = find_frame_motion(model, state, path->points[i]);
      const Stretch stretch =
          find_stretch(from.X_WF.p, to.X_WF.p, from.v_WF_W, to.v_WF_W);
      motion.z += stretch.length;
      motion.rate += stretch.rate;
      from = to;
    }
    return motion;
  }
  const auto& sum = std::get<JointSum>(transmission.coordinate);
  motion.z = -sum.offset;
  for (const JointSum::Term& term : sum.terms) {
    const joints::CoordinateValue value = evaluate_term(
        model, state, term, find_relative_motion(model, state, term.coupler));
    motion.z += term.factor * value.z;
    motion.rate += term.factor * value.rate;
  }
  return motion;
}

}  // namespace limber::dynamics
