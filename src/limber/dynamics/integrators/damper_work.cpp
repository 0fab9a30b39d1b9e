// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/damper_work.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/terms/maxwell.hpp"

namespace limber::dynamics {
namespace {

// Largest dissipation relative to the trapezoidal rule's: more is round-off
// [-].
constexpr double kMostByPath = 1.1;

// Work of a body's Maxwell dampers by the paths of the dampers, less that by
// powers.
double find_maxwell_correction(const BodyModel& body, const SystemState& from,
                               const SystemState& to, double h) {
  const VectorX& lambda = flexbody::rest_stiffness(body.elasticity);
  double sum = 0.0;
  for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
    const auto first = maxwell_of(body, from.maxwell).col(j);
    const auto last = maxwell_of(body, to.maxwell).col(j);
    const double rate = h / body.maxwell.times[j];
    for (Eigen::Index k = 0; k < body.modes; ++k) {
      const double d0 = first[k];
      const double d1 = last[k];
      const Eigen::Index i = body.offset + k;
      const double path = (d0 + d1) * (to.eta[i] - from.eta[i] - (d1 - d0));
      sum += 0.5 * body.maxwell.strengths[j] * lambda[k] *
             (std::max(path, 0.0) - rate * (d0 * d0 + d1 * d1));
    }
  }
  return sum;
}

}  // namespace

DamperWork::DamperWork(const SystemModel& model)
    : model_(model),
      now_(model.couplers.size() + model.transmissions.size()),
      before_(now_) {}

DamperWork::Link DamperWork::read(const CouplerTerms& coupler) {
  Link link;
  link.R = coupler.motion.R_FM;
  link.p = coupler.motion.p_FM_F;
  link.velocity << coupler.motion.v_FM_F, coupler.motion.w_FM_F;
  link.force.noalias() = coupler.response.damping * link.velocity;
  link.power = coupler.response.dissipation;
  return link;
}

DamperWork::Link DamperWork::read(const TransmissionTerms& transmission) {
  Link link;
  link.p[0] = transmission.motion.z;
  link.velocity[0] = transmission.motion.rate;
  link.force[0] = transmission.response.damping * transmission.motion.rate;
  link.power = transmission.response.dissipation;
  return link;
}

bool DamperWork::Link::is_linear() const {
  constexpr double kLinear = 1e-3;
  const double of_force = force.dot(velocity);
  return std::abs(of_force - power) <= kLinear * of_force;
}

void DamperWork::start(const SystemTerms& terms) {
  std::size_t i = 0;
  for (const CouplerTerms& coupler : terms.couplers) now_[i++] = read(coupler);
  for (const TransmissionTerms& t : terms.transmissions) now_[i++] = read(t);
}

double DamperWork::find_correction(const Link& first, const Link& last,
                                   double h) {
  if (first.force.isZero(0.0) && last.force.isZero(0.0)) return 0.0;
  if (!first.is_linear() || !last.is_linear()) return 0.0;
  const Matrix3 rotation = last.R * first.R.transpose();
  if (!(rotation.trace() > 1.0)) return 0.0;
  Vector6 path;
  path << last.p - first.p, log_rotation(rotation);
  const double by_path = 0.5 * (first.force + last.force).dot(path);
  const double by_power =
      0.5 * h *
      (first.force.dot(first.velocity) + last.force.dot(last.velocity));
  // Round-off of positions, times the force.
  if (by_path > kMostByPath * by_power) return 0.0;
  return std::max(by_path - by_power, -0.5 * h * (first.power + last.power));
}

void DamperWork::advance(const SystemState& from, const SystemState& to,
                         const SystemTerms& terms, double h, VectorX& losses) {
  now_.swap(before_);
  start(terms);
  Eigen::Index row = 0;
  for (const BodyModel& body : model_.bodies) {
    double& sum = losses[row++];
    for (Eigen::Index k = 0; k < body.modes; ++k) {
      const Eigen::Index i = body.offset + k;
      const double v0 = from.etadot[i];
      const double v1 = to.etadot[i];
      const double path = (v0 + v1) * (to.eta[i] - from.eta[i]);
      sum += 0.5 * body.damping[k] *
             (std::max(path, 0.0) - h * (v0 * v0 + v1 * v1));
    }
    sum += find_maxwell_correction(body, from, to, h);
  }
  for (std::size_t i = 0; i < now_.size(); ++i) {
    losses[row++] += find_correction(before_[i], now_[i], h);
  }
}

}  // namespace limber::dynamics
