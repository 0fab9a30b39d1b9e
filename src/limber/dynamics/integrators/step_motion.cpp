// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/step_motion.hpp"

#include <cmath>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"

namespace limber::dynamics {
namespace {

void calc_body(const BodyState& begin, const BodyState& middle,
               const BodyState& end, double h, BodyStep& step) {
  const Matrix3 R0 = begin.quat_WB.toRotationMatrix();
  step.rotation = h * middle.w_WB_B;
  step.v_W = middle.v_WB_W;
  step.w_W = R0 * middle.w_WB_B;
  step.R_WB = 0.5 * (R0 + end.quat_WB.toRotationMatrix());
  step.dual_R = R0 + R0 * skew(0.5 * step.rotation);
  step.middle_R_WB = Quaternion(begin.quat_WB.coeffs() + end.quat_WB.coeffs())
                         .normalized()
                         .toRotationMatrix();
}

// f(q) = 2 tan(r / 2) / r, q = r^2, and its derivative: a = f psi makes cay(a)
// the rotation exp(psi).
struct Stretch {
  double value;
  double slope;
};
Stretch find_stretch(double q) {
  constexpr double kSmall = 0.01;  // first neglected term of the series: 1e-16
  if (q < kSmall) {
    return {
        1.0 + q * (1.0 / 12.0 +
                   q * (1.0 / 120.0 +
                        q * (17.0 / 20160.0 + q * (31.0 / 362880.0 +
                                                   q * (691.0 / 79833600.0))))),
        1.0 / 12.0 + q * (2.0 / 120.0 + q * (51.0 / 20160.0 +
                                             q * (124.0 / 362880.0 +
                                                  q * (3455.0 / 79833600.0))))};
  }
  const double r = std::sqrt(q);
  const double f = 2.0 * std::tan(0.5 * r) / r;
  return {f, (1.0 + 0.25 * f * f * q - f) / (2.0 * q)};
}

// (f(q1) - f(q0)) / (q1 - q0), by Gauss' rule of three points.
double find_mean_slope(double q0, double q1) {
  const double middle = 0.5 * (q0 + q1);
  const double reach = 0.5 * std::sqrt(0.6) * (q1 - q0);
  return (8.0 * find_stretch(middle).slope +
          5.0 * (find_stretch(middle - reach).slope +
                 find_stretch(middle + reach).slope)) /
         18.0;
}

// A with exp(psi1) = cay(A (psi1 - psi0)) exp(psi0).
Matrix3 find_secant_jacobian(const Vector3& psi0, const Vector3& psi1) {
  const double q0 = psi0.squaredNorm();
  const double q1 = psi1.squaredNorm();
  const double f0 = find_stretch(q0).value;
  const double f1 = find_stretch(q1).value;
  const Vector3 a0 = f0 * psi0;
  const Vector3 a1 = f1 * psi1;
  const Vector3 both = psi0 + psi1;
  // a1 - a0 = D (psi1 - psi0).
  Matrix3 D = (0.5 * find_mean_slope(q0, q1)) * both * both.transpose();
  D.diagonal().array() += 0.5 * (f0 + f1);
  return (D + skew(0.25 * (a0 + a1)) * D) / (1.0 + 0.25 * a0.dot(a1));
}

// Of an interface at level nonlinear, whose tables change linearly with the
// modes, the mean of both ends.
template <typename Table>
Vector3 combine_mean(const Table& table_of, const Attachment& attachment,
                     const AttachmentMotion& first,
                     const AttachmentMotion& last, const double* rates) {
  Vector3 begin = combine(table_of(attachment, first), rates);
  if (!attachment.second) return begin;
  return 0.5 * (begin + combine(table_of(attachment, last), rates));
}

void calc_flexibility(const BodyModel& body, const Attachment& attachment,
                      const AttachmentMotion& first,
                      const AttachmentMotion& last, const SystemState& middle,
                      const BodyStep& rigid, double h, FrameStep& frame) {
  const double* rates = middle.etadot.data() + body.offset;
  const Matrix3 A = find_secant_jacobian(first.psi, last.psi);
  const Vector3 psidot =
      combine_mean(rotation_of, attachment, first, last, rates);
  // The frame's rotation in the body, h A psidot, before the body's.
  const double both = 0.25 * h * rigid.rotation.dot(A * psidot);
  const double stretch = 1.0 + 0.25 * rigid.rotation.squaredNorm();
  frame.twist = (stretch / (1.0 - both)) * (rigid.R_WB * A);
  frame.v_W += rigid.dual_R *
               combine_mean(translation_of, attachment, first, last, rates);
  frame.w_W += frame.twist * psidot;
}

void rest_in_world(const Attachment& attachment, FrameStep& frame) {
  frame.R_WF = attachment.R_BF;
  frame.p_WF = frame.arm_W = attachment.p_BF;
  frame.v_W.setZero();
  frame.w_W.setZero();
}

// Relative motion of a coupler's frames, expressed in F.
void calc_coupler(const FrameStep& F, const FrameStep& M, const Matrix3& R0_WF,
                  const joints::RelativeMotion& begin,
                  const joints::RelativeMotion& end, double h,
                  CouplerStep& step) {
  step.arm_W = M.p_WF - F.p_WF;
  step.force_R = F.R_WF;
  const double both = 1.0 + 0.25 * h * h * F.w_W.dot(M.w_W);
  step.moment_R = (R0_WF + skew((0.5 * h) * F.w_W) * R0_WF) / both;
  step.mean.p_FM_F = 0.5 * (begin.p_FM_F + end.p_FM_F);
  step.mean.R_FM = 0.5 * (begin.R_FM + end.R_FM);
  step.mean.v_FM_F =
      step.force_R.transpose() * (M.v_W - F.v_W - F.w_W.cross(step.arm_W));
  step.mean.w_FM_F = step.moment_R.transpose() * (M.w_W - F.w_W);
}

}  // namespace

StepMotion make_step_motion(const SystemModel& model) {
  StepMotion motion;
  motion.bodies.resize(model.bodies.size());
  motion.frames.resize(model.attachments.size());
  motion.couplers.resize(model.couplers.size());
  return motion;
}

void calc_step_motion(const SystemModel& model, const SystemState& begin,
                      const SystemState& middle, const SystemState& end,
                      const SystemTerms& begin_terms,
                      const SystemTerms& end_terms, double h,
                      StepMotion& motion) {
  motion.h = h;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    calc_body(begin.bodies[b], middle.bodies[b], end.bodies[b], h,
              motion.bodies[b]);
  }
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const Attachment& attachment = model.attachments[i];
    FrameStep& frame = motion.frames[i];
    if (attachment.body == kWorld) {
      rest_in_world(attachment, frame);
      continue;
    }
    const auto b = index(attachment.body);
    const BodyModel& body = model.bodies[b];
    const BodyStep& rigid = motion.bodies[b];
    const AttachmentMotion& first = begin_terms.attachments[i];
    const AttachmentMotion& last = end_terms.attachments[i];
    frame.R_WF = 0.5 * (first.R_WF + last.R_WF);
    frame.arm_W = 0.5 * (first.R_WB * first.arm_B + last.R_WB * last.arm_B);
    frame.p_WF =
        0.5 * (begin.bodies[b].p_WB + end.bodies[b].p_WB) + frame.arm_W;
    frame.v_W = rigid.v_W + rigid.w_W.cross(frame.arm_W);
    frame.w_W = rigid.w_W;
    if (body.modes == 0) continue;
    calc_flexibility(body, attachment, first, last, middle, rigid, h, frame);
  }
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const auto F = index(model.couplers[c].frame_F);
    const auto M = index(model.couplers[c].frame_M);
    calc_coupler(motion.frames[F], motion.frames[M],
                 begin_terms.attachments[F].R_WF,
                 begin_terms.couplers[c].motion, end_terms.couplers[c].motion,
                 h, motion.couplers[c]);
  }
}

}  // namespace limber::dynamics
