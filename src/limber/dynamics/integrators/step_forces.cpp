// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/step_forces.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/equations/coupler_forces.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/equations/transmission.hpp"
#include "limber/dynamics/integrators/step_pairs.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/terms/maxwell.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {
namespace {

using joints::CoordinateStep;
using joints::MotionStep;
using joints::StepTimes;

// Arguments of the functions below.
struct Step {
  const SystemModel& model;
  const SystemState& begin;
  const SystemState& middle;
  const SystemTerms& begin_terms;
  const SystemTerms& end_terms;
  const StepTimes& times;
  const StepMotion& motion;
};

// Moments are summed in world axes, and transformed at the end.
void add_wrench(const Step& step, AttachmentIndex attachment,
                const Vector3& force_W, const Vector3& moment_W,
                SystemTerms& terms) {
  const Attachment& a = step.model.attachments[index(attachment)];
  if (a.body == kWorld) return;
  const auto b = index(a.body);
  const FrameStep& frame = step.motion.frames[index(attachment)];
  BodyTerms& t = terms.bodies[b];
  t.force_W += force_W;
  t.moment_B += frame.arm_W.cross(force_W) + moment_W;
  if (step.model.bodies[b].modes == 0) return;
  const Vector3 force_B = step.motion.bodies[b].dual_R.transpose() * force_W;
  const Vector3 twist = frame.twist.transpose() * moment_W;
  AttachmentMotion& motion = terms.attachments[index(attachment)];
  const Matrix3X& Phi_B = translation_of(a, motion);
  const Matrix3X& Psi_B = rotation_of(a, motion);
  for (int k = 0; k < step.model.bodies[b].modes; ++k) {
    t.modal_force[k] += Phi_B.col(k).dot(force_B) + Psi_B.col(k).dot(twist);
  }
  if (!a.second) return;
  motion.wrench_B.head<3>() += force_B;
  motion.wrench_B.tail<3>() += twist;
}

// A force and moment on M, and the reaction on F.
void add_pair(const Step& step, CouplerIndex coupler, const Vector6& wrench_F,
              SystemTerms& terms) {
  const Coupler& c = step.model.couplers[index(coupler)];
  const CouplerStep& along = step.motion.couplers[index(coupler)];
  const Vector3 force = along.force_R * wrench_F.head<3>();
  const Vector3 moment = along.moment_R * wrench_F.tail<3>();
  add_wrench(step, c.frame_M, force, moment, terms);
  add_wrench(step, c.frame_F, -force, -moment - along.arm_W.cross(force),
             terms);
}

MotionStep motion_of(const Step& step, std::size_t coupler) {
  return {step.begin_terms.couplers[coupler].motion,
          step.end_terms.couplers[coupler].motion,
          step.motion.couplers[coupler].mean};
}

void apply_coupler(const Step& step, std::size_t c, SystemTerms& terms) {
  CouplerTerms& out = terms.couplers[c];
  const MotionStep motion = motion_of(step, c);
  out.motion = motion.mean;
  out.response = joints::evaluate_over_step(step.model.couplers[c].law, motion,
                                            step.begin.memory[c], step.times);
  out.response.wrench *= 2.0;
  if (out.ideal >= 0) {
    // Its wrench does no work along the mean directions if the end is where it
    // should be, as the begin is.
    joints::ConstraintGap& constraint = terms.constraints[index(out.ideal)];
    const joints::CouplerLaw& law = step.model.couplers[c].law;
    constraint = joints::find_constraint_gap(law, motion.mean);
    constraint.gap = constraint.directions *
                     joints::find_constraint_gap(law, motion.end).gap;
  }
  add_pair(step, static_cast<CouplerIndex>(c), 0.5 * out.applied, terms);
}

CoordinateStep find_path_step(const Step& step, const PathCoordinate& path,
                              std::vector<Vector6>& gradients) {
  CoordinateStep coordinate;
  for (Vector6& gradient : gradients) gradient.setZero();
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const auto from = index(path.points[i]);
    const auto to = index(path.points[i + 1]);
    const auto line = [&](const SystemTerms& at) {
      return (at.attachments[to].p_WF - at.attachments[from].p_WF).eval();
    };
    const Vector3 first = line(step.begin_terms);
    const Vector3 last = line(step.end_terms);
    const double length0 = first.norm();
    const double length1 = last.norm();
    const Vector3 direction = (first + last) / (length0 + length1);
    coordinate.z0 += length0;
    coordinate.rate += direction.dot(step.motion.frames[to].v_W -
                                     step.motion.frames[from].v_W);
    gradients[i].head<3>() -= direction;
    gradients[i + 1].head<3>() += direction;
  }
  coordinate.z1 = coordinate.z0 + step.times.h * coordinate.rate;
  return coordinate;
}

CoordinateStep find_sum_step(const Step& step, const JointSum& sum,
                             std::vector<Vector6>& gradients) {
  CoordinateStep coordinate;
  coordinate.z0 = coordinate.z1 = -sum.offset;
  for (std::size_t i = 0; i < sum.terms.size(); ++i) {
    const JointSum::Term& term = sum.terms[i];
    const auto c = index(term.coupler);
    const auto j = index(term.coordinate);
    const CoordinateStep own = joints::find_coordinate_step(
        joints::coordinates_of(step.model.couplers[c].law)[j],
        motion_of(step, c), step.begin.memory[c].near[j], step.times.h);
    coordinate.z0 += term.factor * own.z0;
    coordinate.z1 += term.factor * own.z1;
    coordinate.rate += term.factor * own.rate;
    gradients[i] = term.factor * own.gradient;
  }
  return coordinate;
}

void apply_transmission(const Step& step, std::size_t i, SystemTerms& terms) {
  const Transmission& transmission = step.model.transmissions[i];
  const joints::CouplerMemory& memory =
      step.begin.memory[step.model.couplers.size() + i];
  TransmissionTerms& out = terms.transmissions[i];
  const auto* path = std::get_if<PathCoordinate>(&transmission.coordinate);
  const auto* sum = std::get_if<JointSum>(&transmission.coordinate);
  const CoordinateStep coordinate =
      path ? find_path_step(step, *path, out.gradients)
           : find_sum_step(step, *sum, out.gradients);
  out.motion = {0.5 * (coordinate.z0 + coordinate.z1), coordinate.rate};
  out.response = {};
  std::size_t first = 0;  // index of a law's first switch
  for (const joints::ScalarLaw& law : transmission.laws) {
    out.response += joints::evaluate_over_step(
        law, coordinate, step.times,
        {memory.switches[first], memory.switches[first + 1]});
    first += index(joints::switch_count(law));
  }
  out.response.force *= 2.0;
  const double force = 0.5 * out.applied;
  for (std::size_t k = 0; k < out.gradients.size(); ++k) {
    if (path) {
      add_wrench(step, path->points[k], force * out.gradients[k].head<3>(),
                 Vector3::Zero(), terms);
    } else {
      add_pair(step, sum->terms[k].coupler, force * out.gradients[k], terms);
    }
  }
}

// A force and a moment on a whole body, and their power.
void add_to_body(const Step& step, std::size_t b, const Vector3& force_W,
                 const Vector3& moment_W, SystemTerms& terms) {
  if (!step.model.bodies[b].has_rigid_motion()) return;
  terms.bodies[b].force_W += force_W;
  terms.bodies[b].moment_B += moment_W;
  terms.bodies[b].supplied += force_W.dot(step.motion.bodies[b].v_W) +
                              moment_W.dot(step.motion.bodies[b].w_W);
}

void add_to_mode(const Step& step, std::size_t b, int k, double force,
                 SystemTerms& terms) {
  terms.bodies[b].modal_force[k] += force;
  terms.bodies[b].supplied +=
      force * step.middle.etadot[step.model.bodies[b].offset + k];
}

// Of the product of modes i and j in the middle, on the way.
double find_product_rate(const Step& step, std::size_t b, int i, int j,
                         bool is_square) {
  const double* eta = step.middle.eta.data() + step.model.bodies[b].offset;
  const double* rate = step.middle.etadot.data() + step.model.bodies[b].offset;
  return is_square ? eta[i] * rate[i] : eta[i] * rate[j] + eta[j] * rate[i];
}

void apply_load(const Step& step, const Load& load, SystemTerms& terms) {
  const double factor = evaluate(
      load.function, {step.times.middle(), Side::right, step.times.inputs});
  const Attachment& a = step.model.attachments[index(load.where)];
  if (factor == 0.0 || a.body == kWorld) return;
  const auto b = index(a.body);
  const BodyModel& body = step.model.bodies[b];
  const Matrix3& R_WB = step.motion.bodies[b].middle_R_WB;
  const Matrix3 R = load.in_world ? Matrix3(Matrix3::Identity()) : R_WB;
  const Vector3 force_W = R * (factor * load.force);
  const Vector3 moment_W = R * (factor * load.moment);
  if (is_coupled(body.fidelity)) {
    const FrameStep& frame = step.motion.frames[index(load.where)];
    add_wrench(step, load.where, force_W, moment_W, terms);
    terms.bodies[b].supplied +=
        force_W.dot(frame.v_W) + moment_W.dot(frame.w_W);
    return;
  }
  // Levels without feedback use the undeformed body.
  const Vector3 force_B = R_WB.transpose() * force_W;
  const Vector3 moment_B = R_WB.transpose() * moment_W;
  for (int k = 0; k < body.modes; ++k) {
    add_to_mode(step, b, k,
                a.Phi_B.col(k).dot(force_B) + a.Psi_B.col(k).dot(moment_B),
                terms);
  }
  add_to_body(step, b, force_W, (R_WB * a.p_BF).cross(force_W) + moment_W,
              terms);
}

void apply_body_load(const Step& step, const BodyLoad& load,
                     SystemTerms& terms) {
  const flexbody::NodalLoad& history = load.history;
  const Eigen::Index i =
      find_interval(history.times, step.times.middle(), Side::right);
  if (i < 0) return;
  const auto b = index(load.body);
  const BodyModel& body = step.model.bodies[b];
  Vector3 moment_B = history.moment.col(i);
  const Eigen::Index first = i * count_coordinates(body);
  const double* eta = step.middle.eta.data() + body.offset;
  for (int k = 0; k < body.modes; ++k) {
    if (is_coupled(body.fidelity)) {
      moment_B += history.moment_by_mode.col(first + k) * eta[k];
    }
    add_to_mode(step, b, k, history.modal(k, i), terms);
  }
  flexbody::for_each_product(
      paired_of(body), [&](Eigen::Index pair, int k, int l, bool is_square) {
        const double force = history.modal(body.modes + pair, i);
        terms.products[b].force[pair] += force;
        terms.bodies[b].supplied +=
            force * find_product_rate(step, b, k, l, is_square);
        moment_B += history.moment_by_mode.col(first + body.modes + pair) *
                    ((is_square ? 0.5 : 1.0) * eta[k] * eta[l]);
      });
  const Matrix3& R_WB = step.motion.bodies[b].middle_R_WB;
  add_to_body(step, b, R_WB * history.force.col(i), R_WB * moment_B, terms);
}

void reset_body(const Step& step, std::size_t b, SystemTerms& terms) {
  const BodyModel& body = step.model.bodies[b];
  const Vector3& gravity_W = step.model.gravity_W;
  BodyTerms& t = terms.bodies[b];
  t.R_WB = step.motion.bodies[b].middle_R_WB;
  t.J = step.end_terms.bodies[b].J;
  t.by_mode.middleCols<3>(6) =
      step.end_terms.bodies[b].by_mode.middleCols<3>(6);
  t.supplied = t.dissipated = 0.0;
  t.force_W.setZero();
  t.moment_B.setZero();
  t.modal_force.setZero();
  terms.products[b].force.setZero();
  t.dissipated += find_maxwell_loss(body, step.middle.maxwell);
  const bool has_weight = body.P.cols() > 0;  // in its modes
  for (int k = 0; k < body.modes; ++k) {
    const double rate = step.middle.etadot[body.offset + k];
    t.dissipated += body.damping[k] * rate * rate;
    if (!has_weight) continue;
    const Vector3 P_W = t.R_WB * body.P.col(k);
    add_to_mode(step, b, k, P_W.dot(gravity_W), terms);
  }
  if (has_weight) {
    const Vector3 gravity_B = t.R_WB.transpose() * gravity_W;
    flexbody::for_each_product(
        paired_of(body), [&](Eigen::Index pair, int i, int j, bool is_square) {
          const double force = body.P.col(body.modes + pair).dot(gravity_B);
          terms.products[b].force[pair] += force;
          terms.bodies[b].supplied +=
              force * find_product_rate(step, b, i, j, is_square);
        });
  }
  add_to_body(step, b, body.mass * gravity_W, Vector3::Zero(), terms);
}

// In the form that NewtonMatrix expects.
void set_attachment(const Step& step, std::size_t i, SystemTerms& terms) {
  const Attachment& a = step.model.attachments[i];
  AttachmentMotion& out = terms.attachments[i];
  out = step.end_terms.attachments[i];
  out.R_WF = step.motion.frames[i].R_WF;
  out.p_WF = step.motion.frames[i].p_WF;
  if (a.body == kWorld) return;
  out.R_WB = step.motion.bodies[index(a.body)].middle_R_WB;
  out.arm_B = out.R_WB.transpose() * step.motion.frames[i].arm_W;
  if (!a.second) return;
  // Tables are linear in the modes, so that their means times the increments
  // are the changes.
  const AttachmentMotion& first = step.begin_terms.attachments[i];
  const AttachmentMotion& last = step.end_terms.attachments[i];
  out.Phi_B = 0.5 * (first.Phi_B + last.Phi_B);
  out.Psi_B = 0.5 * (first.Psi_B + last.Psi_B);
  out.wrench_B.setZero();
}

}  // namespace

void calc_step_forces(const SystemModel& model, const SystemState& begin,
                      const SystemState& middle, const SystemTerms& begin_terms,
                      const SystemTerms& end_terms,
                      const joints::StepTimes& times, const StepMotion& motion,
                      SystemTerms& terms) {
  const Step step{model, begin, middle, begin_terms, end_terms, times, motion};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    reset_body(step, b, terms);
  }
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    set_attachment(step, i, terms);
  }
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    name_coupler(model.couplers[c].name, times.end,
                 [&] { apply_coupler(step, c, terms); });
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    name_coupler(model.transmissions[i].name, times.end,
                 [&] { apply_transmission(step, i, terms); });
  }
  apply_pairs_over_step(model, begin, middle, begin_terms, end_terms, times,
                        motion, terms);
  for (const Load& load : model.loads) apply_load(step, load, terms);
  for (const BodyLoad& load : model.body_loads) {
    apply_body_load(step, load, terms);
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    BodyTerms& t = terms.bodies[b];
    add_product_forces(model.bodies[b], middle, terms.products[b], t);
    t.moment_B = motion.bodies[b].dual_R.transpose() * t.moment_B.eval();
  }
}

}  // namespace limber::dynamics
