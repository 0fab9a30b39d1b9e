// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/free_vibration.hpp"

#include <cmath>

#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

/// sum_j g_j d_j^2 of a mode.
template <typename Mode>
double sum_elements(const Mode& mode, const SystemState& state) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < mode.elements->size(); ++j) {
    const double d = state.maxwell[mode.first + j * mode.stride];
    sum += mode.elements->strengths[j] * d * d;
  }
  return sum;
}

/// Of a mode and its elements [J].
template <typename Mode>
double find_energy(const Mode& mode, const SystemState& state) {
  const double q = state.eta[mode.index];
  const double v = state.etadot[mode.index];
  return 0.5 * (v * v +
                mode.oscillator.lambda() * (q * q + sum_elements(mode, state)));
}

}  // namespace

FreeVibration::Workspace::Workspace(Eigen::Index elements)
    : rates(MatrixX::Zero(elements + 3, elements + 3)),
      begin(elements + 3),
      end(elements + 2),
      exponential(elements + 3) {}

FreeVibration::FreeVibration(const SystemModel& model) {
  for (Eigen::Index b = 0; b < std::ssize(model.bodies); ++b) {
    add_body(model.bodies[index(b)], b);
  }
}

void FreeVibration::add_body(const BodyModel& body, Eigen::Index index) {
  const VectorX& lambda = flexbody::rest_stiffness(body.elasticity);
  const Eigen::Index elements = body.maxwell.size();
  for (int k = 0; k < body.modes; ++k) {
    modes_.push_back({flexbody::ModalOscillator(lambda[k], body.damping[k]),
                      &body.maxwell, index, body.offset + k, body.row + 6 + k,
                      body.maxwell_offset + k, body.modes});
    if (elements > 0) modes_.back().flow.resize(elements + 2, elements + 3);
  }
  while (std::ssize(workspaces_) <= elements) {
    workspaces_.emplace_back(std::ssize(workspaces_));
  }
}

FreeVibration::Workspace& FreeVibration::workspace_of(const Mode& mode) {
  return workspaces_[static_cast<std::size_t>(mode.elements->size())];
}

void FreeVibration::set_time(double time) {
  if (time == time_) return;
  time_ = time;
  for (Mode& mode : modes_) {
    if (mode.elements->size() > 0) {
      set_flow(mode);
    } else {
      mode.response = mode.oscillator.find_free_response(time);
    }
  }
}

// Displacements are scaled to velocities, so that the matrix is nearly normal.
void FreeVibration::set_flow(Mode& mode) {
  const double lambda = mode.oscillator.lambda();
  const double s = lambda > 0.0 ? std::sqrt(lambda) : 1.0;
  const Eigen::Index count = mode.elements->size();
  Workspace& w = workspace_of(mode);
  w.rates.setZero();
  w.rates(0, 1) = s;
  w.rates(1, 0) = -lambda / s;
  w.rates(1, 1) = -mode.oscillator.damping();
  for (Eigen::Index j = 0; j < count; ++j) {
    w.rates(1, 2 + j) = -lambda / s * mode.elements->strengths[j];
    w.rates(2 + j, 1) = s;
    w.rates(2 + j, 2 + j) = -1.0 / mode.elements->times[j];
  }
  w.rates(1, 2 + count) = 1.0;
  w.rates *= time_;
  mode.flow = w.exponential(w.rates).topRows(count + 2);
  for (Eigen::Index i = 0; i < count + 2; ++i) {
    if (i == 1) continue;  // q'
    mode.flow.row(i) /= s;
    mode.flow.col(i) *= s;
  }
}

void FreeVibration::move_with_elements(const Mode& mode, double load,
                                       SystemState& state) {
  const Eigen::Index count = mode.elements->size();
  const auto element = [&](Eigen::Index j) -> double& {
    return state.maxwell[mode.first + j * mode.stride];
  };
  Workspace& w = workspace_of(mode);
  w.begin[0] = state.eta[mode.index];
  w.begin[1] = state.etadot[mode.index];
  for (Eigen::Index j = 0; j < count; ++j) w.begin[2 + j] = element(j);
  w.begin[2 + count] = load;
  w.end.noalias() = mode.flow * w.begin;
  state.eta[mode.index] = w.end[0];
  state.etadot[mode.index] = w.end[1];
  for (Eigen::Index j = 0; j < count; ++j) element(j) = w.end[2 + j];
}

void FreeVibration::move(Mode& mode, double load, SystemState& state) {
  if (mode.elements->size() > 0) return move_with_elements(mode, load, state);
  const flexbody::FreeResponse& r = mode.response;
  const double eta = state.eta[mode.index];
  const double etadot = state.etadot[mode.index];
  state.eta[mode.index] = r.stay * eta + r.impulse * etadot + r.step * load;
  state.etadot[mode.index] = -mode.oscillator.lambda() * r.impulse * eta +
                             r.keep * etadot + r.impulse * load;
}

void FreeVibration::move(SystemState& state, VectorX& losses) {
  for (Mode& mode : modes_) {
    const bool is_damped =
        mode.oscillator.damping() > 0.0 || mode.elements->size() > 0;
    const double before = is_damped ? find_energy(mode, state) : 0.0;
    move(mode, 0.0, state);
    if (is_damped) losses[mode.body] += before - find_energy(mode, state);
  }
}

void FreeVibration::move(const VectorX& loads, SystemState& state) {
  for (Mode& mode : modes_) move(mode, loads[mode.row], state);
}

void FreeVibration::add_own_forces(const SystemState& state,
                                   VectorX& accelerations) const {
  for (const Mode& mode : modes_) {
    double stretch = state.eta[mode.index];
    for (Eigen::Index j = 0; j < mode.elements->size(); ++j) {
      stretch += mode.elements->strengths[j] *
                 state.maxwell[mode.first + j * mode.stride];
    }
    accelerations[mode.row] +=
        mode.oscillator.lambda() * stretch +
        mode.oscillator.damping() * state.etadot[mode.index];
  }
}

}  // namespace limber::dynamics
