// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/axial_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

constexpr double kClampedBeam = 12.0 * 2.467 / 12.362;
constexpr double kFreeBeam = 12.0 / 49.481;
constexpr double kSpunBar = 1.2;
constexpr double kLong = 0.1;  // of the largest second moment

// Lowest eigenvalue with attachment `a` fixed: the rigid motion follows from
// the modes [rad^2/s^2].
double find_held_eigenvalue(const BodyModel& body, const VectorX& lambda,
                            const Attachment& a) {
  const Matrix3X U = -a.Phi_B - skew(a.p_BF) * a.Psi_B;
  const VectorX scale = lambda.cwiseSqrt().cwiseInverse();
  MatrixX M = body.mass * U.transpose() * U;
  M += a.Psi_B.transpose() * body.J0 * a.Psi_B;
  M.diagonal().array() += 1.0;
  const MatrixX scaled = scale.asDiagonal() * M * scale.asDiagonal();
  return 1.0 / dense::find_eigenvalues(scaled).maxCoeff();
}

// s_k = a' int x phi_k' dm a of each mode, from J1 = tr(S) 1 - S, S = int x
// phi' + phi x' dm [kg^1/2 m].
VectorX find_stretch(const BodyModel& body, const Vector3& axis) {
  VectorX stretch(body.modes);
  for (int k = 0; k < body.modes; ++k) {
    const Matrix3 J1 = unpack_symmetric(Vector6(body.inertia->J1().row(k)));
    stretch[k] = 0.5 * (0.5 * J1.trace() - axis.dot(J1 * axis));
  }
  return stretch;
}

// Ends of couplers that can hold a body, on it.
std::vector<const Attachment*> find_holds(const SystemModel& model,
                                          BodyIndex body) {
  std::vector<const Attachment*> holds;
  for (const Coupler& coupler : model.couplers) {
    if (std::holds_alternative<joints::PointSpring>(coupler.law)) continue;
    for (const AttachmentIndex end : {coupler.frame_F, coupler.frame_M}) {
      const Attachment& a = model.attachments[index(end)];
      if (a.body == body) holds.push_back(&a);
    }
  }
  return holds;
}

}  // namespace

AxialLoad::AxialLoad(const SystemModel& model, BodyIndex body_index)
    : model_(&model), body_(body_index) {
  const BodyModel& body = model.bodies[index(body_)];
  stretch_ = VectorX::Zero(body.modes);
  if (body.modes == 0 || body.clamped || !body.reduced) return;
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const Coupler& coupler = model.couplers[c];
    if (is_on_body(coupler.frame_F) || is_on_body(coupler.frame_M)) {
      couplers_.push_back(c);
    }
  }
  const VectorX& lambda = require_eigenvalues(body, "advice on levels");
  double lowest = lambda.minCoeff();
  for (const Attachment* a : find_holds(model, body_)) {
    is_held_ = true;
    lowest = std::min(lowest, find_held_eigenvalue(body, lambda, *a));
  }
  frequency_ = std::sqrt(lowest);
  S0_ = 0.5 * body.J0.trace() * Matrix3::Identity() - body.J0;
  const auto [S, axes] = dense::find_eigenpairs(S0_);
  axes_ = axes;
  for (int k = 0; k < 3; ++k) {
    if (S[k] < kLong * S[2]) continue;
    loads_[k] = (is_held_ ? kClampedBeam : kFreeBeam) * lowest * S[k];
    const VectorX s = find_stretch(body, axes_.col(k));
    softness_[k] =
        s.cwiseAbs2().cwiseQuotient(lambda).sum() / (kSpunBar * S[k] * S[k]);
    stretch_ = stretch_.cwiseMax(s.cwiseAbs() / std::sqrt(S[k]));
  }
}

bool AxialLoad::is_on_body(AttachmentIndex frame) const {
  return model_->attachments[index(frame)].body == body_;
}

Matrix3 AxialLoad::calc_stress(const SystemState& state, Side side,
                               const SystemTerms& terms) const {
  const Vector3& w = state.bodies[index(body_)].w_WB_B;
  const Matrix3 R_BW = terms.bodies[index(body_)].R_WB.transpose();
  const Matrix3 rotation = skew(w) * skew(w);
  Matrix3 T = -S0_ * rotation;
  const auto add = [&](AttachmentIndex where, const Vector3& force_B) {
    if (!is_on_body(where)) return;
    T += terms.attachments[index(where)].arm_B * force_B.transpose();
  };
  for (const std::size_t c : couplers_) {
    const Coupler& coupler = model_->couplers[c];
    const Vector3 force_B =
        R_BW * (terms.attachments[index(coupler.frame_F)].R_WF *
                terms.couplers[c].applied.head<3>());
    add(coupler.frame_M, force_B);
    add(coupler.frame_F, -force_B);
  }
  for (std::size_t i = 0; i < model_->transmissions.size(); ++i) {
    const auto* path =
        std::get_if<PathCoordinate>(&model_->transmissions[i].coordinate);
    if (path == nullptr) continue;
    for (std::size_t k = 0; k < path->points.size(); ++k) {
      add(path->points[k],
          R_BW * (terms.transmissions[i].applied *
                  terms.transmissions[i].gradients[k].head<3>()));
    }
  }
  for (const Load& load : model_->loads) {
    const double factor = evaluate(load.function, now_of(state, side));
    add(load.where,
        factor * (load.in_world ? Vector3(R_BW * load.force) : load.force));
  }
  return 0.5 * (T + T.transpose());
}

AxialState AxialLoad::calc_state(const SystemState& state, Side side,
                                 const SystemTerms& terms) const {
  AxialState largest;
  if (loads_.isZero(0.0)) return largest;
  const Matrix3 T = calc_stress(state, side, terms);
  const auto include = [](double& most, double value) {
    if (std::abs(value) > std::abs(most)) most = value;
  };
  for (int k = 0; k < 3; ++k) {
    if (loads_[k] == 0.0) continue;
    const double along = axes_.col(k).dot(T * axes_.col(k));
    include(largest.fraction, along / loads_[k]);
    include(largest.strain, along * softness_[k]);
  }
  return largest;
}

std::vector<const Attachment*> find_interfaces(const SystemModel& model,
                                               BodyIndex body) {
  std::vector<const Attachment*> interfaces;
  for (const Attachment& a : model.attachments) {
    if (a.body == body) interfaces.push_back(&a);
  }
  return interfaces;
}

InterfaceRotation find_rotation(
    const std::vector<const Attachment*>& interfaces, const VectorX& eta) {
  InterfaceRotation rotation;
  for (auto a = interfaces.begin(); a != interfaces.end(); ++a) {
    if ((*a)->Psi_B.cols() != eta.size()) continue;
    const Vector3 own = (*a)->Psi_B * eta;
    rotation.own = std::max(rotation.own, own.norm());
    for (auto b = interfaces.begin(); b != a; ++b) {
      if ((*b)->Psi_B.cols() != eta.size()) continue;
      rotation.relative =
          std::max(rotation.relative, (own - (*b)->Psi_B * eta).norm());
    }
  }
  return rotation;
}

}  // namespace limber::dynamics
