// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/step_pairs.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

// Motion of a material point over a step.
struct PlaceStep {
  Vector3 arm_W = Vector3::Zero();       // mean of both ends, from Bo [m]
  Vector3 end_arm_B = Vector3::Zero();   // [m]
  Vector3 velocity_W = Vector3::Zero();  // mean [m/s]
};

PlaceStep find_place_step(const joints::PairBody& begin,
                          const joints::PairBody& end,
                          const joints::PairPlace& place, double h) {
  PlaceStep step;
  step.end_arm_B = find_arm(end, place);
  const Vector3 first = begin.R_WB * find_arm(begin, place);
  const Vector3 last = end.R_WB * step.end_arm_B;
  step.arm_W = 0.5 * (first + last);
  step.velocity_W = ((end.p_WB - begin.p_WB) + (last - first)) / h;
  return step;
}

void set_middle(const SystemModel& model, const SystemState& middle,
                const SystemTerms& begin_terms, const SystemTerms& end_terms,
                const StepMotion& motion, SystemTerms& terms) {
  for (const std::size_t b : terms.pairs.members) {
    joints::PairBody& body = terms.pairs.bodies[b];
    body.R_WB = motion.bodies[b].middle_R_WB;
    body.p_WB = 0.5 * (begin_terms.pairs.bodies[b].p_WB +
                       end_terms.pairs.bodies[b].p_WB);
    body.v_WB_W = motion.bodies[b].v_W;
    body.w_WB_B = middle.bodies[b].w_WB_B;
    body.modes = count_coordinates(model.bodies[b]);
    body.eta = middle.eta.data() + model.bodies[b].offset;
    body.etadot = middle.etadot.data() + model.bodies[b].offset;
    if (paired_of(model.bodies[b]).empty()) continue;
    // The products' means, and their change over the step.
    const ProductTerms& first = begin_terms.products[b];
    const ProductTerms& last = end_terms.products[b];
    ProductTerms& own = terms.products[b];
    own.eta = 0.5 * (first.eta + last.eta);
    own.etadot = (last.eta - first.eta) / motion.h;
    body.eta = own.eta.data();
    body.etadot = own.etadot.data();
  }
}

void add_force(const SystemModel& model, BodyIndex b, const PlaceStep& step,
               const joints::PairPlace& place, const Vector3& force_W,
               const StepMotion& motion, SystemTerms& terms) {
  if (b == kWorld) return;
  BodyTerms& t = terms.bodies[index(b)];
  t.force_W += force_W;
  t.moment_B += step.arm_W.cross(force_W);
  const Vector3 force_B = motion.bodies[index(b)].dual_R.transpose() * force_W;
  add_modal_force(model.bodies[index(b)], place, force_B, t,
                  terms.products[index(b)]);
}

// In the axes that NewtonMatrix takes for those of the body.
Vector3 find_acting_arm(BodyIndex b, const PlaceStep& step,
                        const StepMotion& motion) {
  if (b == kWorld) return step.arm_W;
  return motion.bodies[index(b)].middle_R_WB.transpose() * step.arm_W;
}

}  // namespace

void apply_pairs_over_step(const SystemModel& model, const SystemState& begin,
                           const SystemState& middle,
                           const SystemTerms& begin_terms,
                           const SystemTerms& end_terms,
                           const joints::StepTimes& times,
                           const StepMotion& motion, SystemTerms& terms) {
  set_middle(model, middle, begin_terms, end_terms, motion, terms);
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    const Pair& pair = model.pairs[i];
    joints::PairResponse& response = terms.pairs.responses[i];
    response.clear();
    if (is_far(begin, i)) continue;
    const joints::PairBodies first = find_bodies(pair, begin_terms.pairs);
    const joints::PairBodies last = find_bodies(pair, end_terms.pairs);
    name_pair(pair.name, times.end, [&] {
      pair.law->evaluate_over_step(
          {first, find_bodies(pair, terms.pairs), last, times,
           begin_terms.pairs.responses[i], end_terms.pairs.responses[i]},
          memory_of(pair, begin), response);
      check_finite(response);
    });
    for (joints::PairPoint& point : response.points()) {
      const PlaceStep A = find_place_step(first.A, last.A, point.on_A, times.h);
      const PlaceStep B = find_place_step(first.B, last.B, point.on_B, times.h);
      point.acting = {find_acting_arm(pair.body_A, A, motion),
                      find_acting_arm(pair.body_B, B, motion)};
      point.moving = {A.end_arm_B, B.end_arm_B};
      point.velocity_W = B.velocity_W - A.velocity_W;
      add_force(model, pair.body_A, A, point.on_A, -point.force_W, motion,
                terms);
      add_force(model, pair.body_B, B, point.on_B, point.force_W, motion,
                terms);
    }
  }
}

}  // namespace limber::dynamics
