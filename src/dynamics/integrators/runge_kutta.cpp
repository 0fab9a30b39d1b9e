// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/runge_kutta.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/maxwell.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/integrators/finite_check.hpp"

namespace limber::dynamics {
namespace {

/// to = from + increment with compensation: round-off of the sum goes to
/// `carry`, and that of the last sum is added if `from` is still its result
/// `left`. Exact whichever summand is larger.
template <typename From, typename Left, typename Increment, typename Carry,
          typename To>
void add(const From& from, const Left& left, const Increment& increment,
         Carry&& carry, To&& to) {
  for (Eigen::Index i = 0; i < from.size(); ++i) {
    const double old = from[i];
    const double step = increment[i] + (old == left[i] ? carry[i] : 0.0);
    const double sum = old + step;
    const double added = sum - old;
    carry[i] = (old - (sum - added)) + (step - added);
    to[i] = sum;
  }
}

/// q exp(theta) - q, including the correction of |q| to 1.
Eigen::Vector4d find_turn(const Quaternion& q, const Vector3& theta) {
  Quaternion less_one = exp_quaternion(theta);
  less_one.w() = -less_one.vec().squaredNorm() / (1.0 + less_one.w());
  return (q * less_one).coeffs() + (1.0 / q.norm() - 1.0) * q.coeffs();
}

/// A state of zeros: no round-off yet.
void clear(SystemState& carry) {
  for (BodyState& body : carry.bodies) {
    body = BodyState{};
    body.quat_WB.coeffs().setZero();
  }
  carry.eta.setZero();
  carry.etadot.setZero();
  carry.maxwell.setZero();
  carry.u_H.setZero();
  carry.udot_H.setZero();
}

}  // namespace

RungeKutta4::RungeKutta4(const SystemModel& model)
    : model_(model),
      terms_(make_terms(model)),
      accelerations_(make_accelerations(model)),
      flows_(make_flows(model)),
      theta_(model.bodies.size(), Vector3::Zero()),
      stage_(make_state(model)),
      left_(make_state(model)),
      carry_(make_state(model)) {
  clear(carry_);
  const std::vector<Vector3> zero(model.bodies.size(), Vector3::Zero());
  const VectorX modes = VectorX::Zero(model.modal_count);
  const VectorX nodes = VectorX::Zero(model.nodal_count);
  const VectorX elements = VectorX::Zero(model.maxwell_count);
  slopes_.fill({zero, zero, zero, zero, modes, modes, elements, nodes, nodes});
}

void RungeKutta4::exchange_memory(Archive& archive, const SystemState& state) {
  archive(carry_);
  if (archive.reads()) left_ = state;
}

void RungeKutta4::calc_slope(const SystemState& at,
                             const std::vector<Vector3>& theta, Side side,
                             Slope& slope) {
  calc_terms(model_, at, side, terms_);
  solve_accelerations(model_, terms_, accelerations_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    slope.pdot[b] = at.bodies[b].v_WB_W;
    slope.thetadot[b] = right_jacobian_inverse(theta[b]) * at.bodies[b].w_WB_B;
    slope.vdot[b] = accelerations_.a_WB_W[b];
    slope.wdot[b] = accelerations_.dw_WB_B[b];
  }
  slope.etadot = at.etadot;
  slope.etaddot = accelerations_.etaddot;
  for (const BodyModel& body : model_.bodies) {
    for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
      maxwell_of(body, slope.maxwelldot).col(j) =
          maxwell_of(body, at.maxwell).col(j) / -body.maxwell.times[j];
    }
  }
  stretch_maxwell(model_, at.etadot, 1.0, slope.maxwelldot);
  slope.udot_H = at.udot_H;
  slope.uddot_H = accelerations_.uddot_H;
}

void RungeKutta4::displace(const SystemState& from, const Slope& slope,
                           double h, double t) {
  stage_.t = t;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyState& old = from.bodies[b];
    BodyState& body = stage_.bodies[b];
    theta_[b] = h * slope.thetadot[b];
    body.p_WB = old.p_WB + h * slope.pdot[b];
    body.quat_WB = old.quat_WB * exp_quaternion(theta_[b]);
    body.v_WB_W = old.v_WB_W + h * slope.vdot[b];
    body.w_WB_B = old.w_WB_B + h * slope.wdot[b];
  }
  stage_.eta = from.eta + h * slope.etadot;
  stage_.etadot = from.etadot + h * slope.etaddot;
  stage_.maxwell = from.maxwell + h * slope.maxwelldot;
  stage_.X_WH = from.X_WH;
  stage_.u_H = from.u_H + h * slope.udot_H;
  stage_.udot_H = from.udot_H + h * slope.uddot_H;
}

void RungeKutta4::advance(const SystemState& from, const Slope& slope, double h,
                          double t) {
  stage_.t = t;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyState& old = from.bodies[b];
    const BodyState& left = left_.bodies[b];
    BodyState& carry = carry_.bodies[b];
    BodyState& body = stage_.bodies[b];
    add(old.p_WB, left.p_WB, Vector3(h * slope.pdot[b]), carry.p_WB, body.p_WB);
    add(old.quat_WB.coeffs(), left.quat_WB.coeffs(),
        find_turn(old.quat_WB, h * slope.thetadot[b]), carry.quat_WB.coeffs(),
        body.quat_WB.coeffs());
    add(old.v_WB_W, left.v_WB_W, Vector3(h * slope.vdot[b]), carry.v_WB_W,
        body.v_WB_W);
    add(old.w_WB_B, left.w_WB_B, Vector3(h * slope.wdot[b]), carry.w_WB_B,
        body.w_WB_B);
  }
  add(from.eta, left_.eta, h * slope.etadot, carry_.eta, stage_.eta);
  add(from.etadot, left_.etadot, h * slope.etaddot, carry_.etadot,
      stage_.etadot);
  add(from.maxwell, left_.maxwell, h * slope.maxwelldot, carry_.maxwell,
      stage_.maxwell);
  stage_.X_WH = from.X_WH;
  add(from.u_H, left_.u_H, h * slope.udot_H, carry_.u_H, stage_.u_H);
  add(from.udot_H, left_.udot_H, h * slope.uddot_H, carry_.udot_H,
      stage_.udot_H);
}

StepResult RungeKutta4::step(SystemState& state, double h, double end) {
  for (Vector3& theta : theta_) theta.setZero();
  copy_step_constants(state, stage_);
  calc_slope(state, theta_, Side::right, slopes_[0]);
  flows_.clear();
  add_powers(terms_, h / 6.0, flows_);
  const std::array<double, 3> shares = {0.5, 0.5, 1.0};
  for (std::size_t s = 0; s < 3; ++s) {
    const bool at_end = s == 2;
    displace(state, slopes_[s], shares[s] * h,
             at_end ? end : state.t + shares[s] * h);
    calc_slope(stage_, theta_, at_end ? Side::left : Side::right,
               slopes_[s + 1]);
    add_powers(terms_, (at_end ? 1.0 : 2.0) * h / 6.0, flows_);
  }
  // The weighted mean of the slopes, gathered in the first.
  auto& k = slopes_;
  const auto mean = [&](auto member) {
    auto& sum = k[0].*member;
    for (std::size_t b = 0; b < sum.size(); ++b) {
      sum[b] = (sum[b] + 2.0 * (k[1].*member)[b] + 2.0 * (k[2].*member)[b] +
                (k[3].*member)[b]) /
               6.0;
    }
  };
  mean(&Slope::pdot);
  mean(&Slope::thetadot);
  mean(&Slope::vdot);
  mean(&Slope::wdot);
  for (const auto member : {&Slope::etadot, &Slope::etaddot, &Slope::maxwelldot,
                            &Slope::udot_H, &Slope::uddot_H}) {
    VectorX& sum = k[0].*member;
    sum += 2.0 * k[1].*member + 2.0 * k[2].*member + k[3].*member;
    sum /= 6.0;
  }
  advance(state, k[0], h, end);
  try {
    require_finite(model_, stage_, h);
  } catch (const NumericalError&) {
    clear(carry_);
    throw;
  }
  left_ = stage_;
  std::swap(state, stage_);
  StepResult result;
  set_work(flows_, result);
  return result;
}

}  // namespace limber::dynamics
