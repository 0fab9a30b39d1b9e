// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/runge_kutta.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/integrators/finite_check.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/terms/maxwell.hpp"

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
Eigen::Vector4d find_change(const Quaternion& q, const Vector3& theta) {
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
      flows_(make_flows(model)),
      moved_(make_unknowns(model)),
      v_(moved_),
      work_(moved_),
      stage_(make_state(model)),
      left_(make_state(model)),
      carry_(make_state(model)) {
  clear(carry_);
  slopes_.fill({moved_, moved_, VectorX::Zero(model.maxwell_count)});
}

void RungeKutta4::exchange_memory(Archive& archive, const SystemState& state) {
  archive(carry_);
  if (archive.reads()) left_ = state;
}

void RungeKutta4::calc_slope(const SystemState& at, Side side, Slope& slope) {
  calc_terms(model_, at, side, terms_);
  solve_accelerations(model_, terms_, slope.acceleration);
  get_velocities(model_, at, slope.motion);
  for (const BodyModel& body : model_.bodies) {
    const Vector3 w = rotation_rows(body, slope.motion);
    const Vector3 theta = rotation_rows(body, moved_);
    rotation_rows(body, slope.motion) = right_jacobian_inverse(theta) * w;
    for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
      maxwell_of(body, slope.maxwell).col(j) =
          maxwell_of(body, at.maxwell).col(j) / -body.maxwell.times[j];
    }
  }
  stretch_maxwell(model_, slope.motion, 1.0, slope.maxwell);
}

void RungeKutta4::displace(const SystemState& from, const Slope& slope,
                           double h, double t) {
  stage_.t = t;
  stage_.bodies = from.bodies;
  stage_.eta = from.eta;
  stage_.X_WH = from.X_WH;
  stage_.u_H = from.u_H;
  moved_ = h * slope.motion;
  dynamics::displace(model_, moved_, 1.0, stage_);
  work_ = v_ + h * slope.acceleration;
  set_velocities(model_, work_, stage_);
  stage_.maxwell = from.maxwell + h * slope.maxwell;
}

void RungeKutta4::advance(const SystemState& from, const Slope& slope, double h,
                          double t) {
  stage_.t = t;
  stage_.X_WH = from.X_WH;
  moved_ = h * slope.motion;
  work_ = h * slope.acceleration;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& model = model_.bodies[b];
    const BodyState& old = from.bodies[b];
    const BodyState& left = left_.bodies[b];
    BodyState& carry = carry_.bodies[b];
    BodyState& body = stage_.bodies[b];
    add(old.p_WB, left.p_WB, translation_rows(model, moved_), carry.p_WB,
        body.p_WB);
    add(old.quat_WB.coeffs(), left.quat_WB.coeffs(),
        find_change(old.quat_WB, rotation_rows(model, moved_)),
        carry.quat_WB.coeffs(), body.quat_WB.coeffs());
    add(old.v_WB_W, left.v_WB_W, translation_rows(model, work_), carry.v_WB_W,
        body.v_WB_W);
    add(old.w_WB_B, left.w_WB_B, rotation_rows(model, work_), carry.w_WB_B,
        body.w_WB_B);
    const auto modes = [&model](auto& all) {
      return all.segment(model.offset, model.modes);
    };
    add(modes(from.eta), modes(left_.eta), mode_rows(model, moved_),
        modes(carry_.eta), modes(stage_.eta));
    add(modes(from.etadot), modes(left_.etadot), mode_rows(model, work_),
        modes(carry_.etadot), modes(stage_.etadot));
  }
  add(from.maxwell, left_.maxwell, h * slope.maxwell, carry_.maxwell,
      stage_.maxwell);
  add(from.u_H, left_.u_H, nodal_rows(model_, moved_), carry_.u_H, stage_.u_H);
  add(from.udot_H, left_.udot_H, nodal_rows(model_, work_), carry_.udot_H,
      stage_.udot_H);
}

StepResult RungeKutta4::step(SystemState& state, double h, double end) {
  moved_.setZero();
  get_velocities(model_, state, v_);
  copy_step_constants(state, stage_);
  calc_slope(state, Side::right, slopes_[0]);
  flows_.clear();
  add_powers(terms_, h / 6.0, flows_);
  const std::array<double, 3> fractions = {0.5, 0.5, 1.0};
  for (std::size_t s = 0; s < 3; ++s) {
    const bool at_end = s == 2;
    displace(state, slopes_[s], fractions[s] * h,
             at_end ? end : state.t + fractions[s] * h);
    calc_slope(stage_, at_end ? Side::left : Side::right, slopes_[s + 1]);
    add_powers(terms_, (at_end ? 1.0 : 2.0) * h / 6.0, flows_);
  }
  // The weighted mean of the slopes, gathered in the first.
  auto& k = slopes_;
  for (const auto member :
       {&Slope::motion, &Slope::acceleration, &Slope::maxwell}) {
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
