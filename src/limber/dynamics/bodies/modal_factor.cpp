// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/modal_factor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/terms/attachment_jacobian.hpp"

namespace limber::dynamics {

void calc_stiffness(const SystemModel& model, const SystemState& state,
                    SystemTerms& terms) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (!has_dense_modes(body)) continue;
    flexbody::calc_elastic_tangent(body.elasticity,
                                   state.eta.segment(body.offset, body.modes),
                                   terms.bodies[b].stiffness);
    add_geometric_stiffness(model, b, terms, terms.bodies[b].stiffness);
  }
}

ModalFactor::ModalFactor(const BodyModel& body)
    : coupling_(Matrix3X::Zero(3, body.modes)),
      back_coupling_(Matrix3X::Zero(3, body.modes)) {
  answer_.setZero(body.modes, 3);
  if (!has_dense_modes(body)) {
    inverse_modes_ = VectorX::Zero(body.modes);
    return;
  }
  coupled_modes_.emplace(body.modes);
  diagonal_ = VectorX::Zero(body.modes);
}

void ModalFactor::update_modes(const BodyModel& body, const BodyTerms& terms,
                               const TangentCoefficients& c) {
  if (!coupled_modes_) {
    const VectorX& lambda = *flexbody::find_eigenvalues(body.elasticity);
    inverse_modes_.array() =
        (c.acceleration + c.velocity * body.damping.array() +
         (1.0 + terms.maxwell_stiffness) * lambda.array())
            .inverse();
    if (c.calming == nullptr) return;
    inverse_modes_.array() /=
        1.0 + inverse_modes_.array() *
                  c.calming->segment(body.offset, body.modes).array();
    return;
  }
  diagonal_.array() = c.acceleration + c.velocity * body.damping.array() +
                      terms.maxwell_stiffness *
                          flexbody::rest_stiffness(body.elasticity).array();
  if (c.calming != nullptr) {
    diagonal_ += c.calming->segment(body.offset, body.modes);
  }
  if (coupled_modes_->factor(diagonal_, terms.stiffness)) return;
  throw NumericalError(fmt::format(
      "body '{}': the matrix of its modes' inertia and elasticity is singular",
      body.name));
}

bool ModalFactor::update(const SystemModel& model, std::size_t b,
                         const SystemState& state, const SystemTerms& all_terms,
                         const Matrix3& T, const TangentCoefficients& c,
                         bool /*renews*/) {
  const BodyModel& body = model.bodies[b];
  const BodyTerms& terms = all_terms.bodies[b];
  const Vector3& w = state.bodies[b].w_WB_B;
  update_modes(body, terms, c);
  if (!body.has_rigid_motion()) return false;  // its rigid blocks remain zero
  inverse_mass_ = 1.0 / (c.acceleration * body.mass);
  // The step's rotation changes by T times the increments at its end.
  const Matrix3 gyroscopic = skew(w) * terms.J - skew(terms.J * w);
  rotation_ = (c.acceleration * terms.J + c.velocity * gyroscopic) * T;
  for (int k = 0; k < body.modes; ++k) {
    coupling_.col(k) = c.acceleration * terms.H().col(k);
    back_coupling_.col(k) = T.transpose() * coupling_.col(k);
  }
  answer_ = back_coupling_.transpose();
  for (int i = 0; i < 3; ++i) solve_modes(answer_.col(i));
  Matrix3 schur = rotation_;
  for (int k = 0; k < body.modes; ++k) {
    schur -= coupling_.col(k) * answer_.row(k);
  }
  inverse_rotation_ = schur.inverse();
  if (!inverse_rotation_.allFinite()) {
    throw NumericalError(
        fmt::format("body '{}': its inertia has become singular", body.name));
  }
  return false;
}

LinkEnd ModalFactor::make_end(const SystemModel& model, std::size_t b) const {
  const BodyModel& body = model.bodies[b];
  return {.row = body.row, .G = Matrix6X::Zero(6, 6 + body.modes)};
}

void ModalFactor::calc_rows(const SystemModel& model, std::size_t /*b*/,
                            const SystemState& /*state*/,
                            const SystemTerms& terms, const Matrix3& R_FW,
                            LinkEnd& end) const {
  const auto i = index(end.attachment);
  calc_modal_jacobian(model.attachments[i], terms.attachments[i], R_FW, end.G);
}

// x := modal block^-1 x.
void ModalFactor::solve_modes(Eigen::Ref<VectorX> x) {
  if (coupled_modes_) {
    coupled_modes_->solve(x);
  } else {
    x.array() *= inverse_modes_.array();
  }
}

void ModalFactor::solve(double* x) {
  Eigen::Map<Vector3> translation(x);
  Eigen::Map<Vector3> rotation(x + 3);
  Eigen::Map<VectorX> modes(x + 6, coupling_.cols());
  translation *= inverse_mass_;
  solve_modes(modes);
  const Vector3 turned =
      inverse_rotation_ * (rotation - combine(coupling_, modes.data()));
  rotation = turned;
  modes -= answer_.lazyProduct(turned);
}

void ModalFactor::solve_coupled_rows(const Matrix6X& G,
                                     Matrix6X& result) const {
  const Eigen::Index m = coupling_.cols();
  result.leftCols<3>() = inverse_mass_ * G.leftCols<3>();
  coupled_modes_->solve_rows(G.rightCols(m), result.rightCols(m));
  Eigen::Matrix<double, 6, 3> right = G.middleCols<3>(3);
  for (Eigen::Index k = 0; k < m; ++k) {
    right.noalias() -= result.col(6 + k) * coupling_.col(k).transpose();
  }
  const Eigen::Matrix<double, 6, 3> turned =
      right * inverse_rotation_.transpose();
  result.middleCols<3>(3) = turned;
  for (Eigen::Index k = 0; k < m; ++k) {
    result.col(6 + k) -= turned * answer_.row(k).transpose();
  }
}

// A row of G at a time, through D's arrow shape.
void ModalFactor::solve_rows(const Matrix6X& G, Matrix6X& result) const {
  if (coupled_modes_) {
    solve_coupled_rows(G, result);
    return;
  }
  result.leftCols<3>() = inverse_mass_ * G.leftCols<3>();
  Eigen::Matrix<double, 6, 3> right = G.middleCols<3>(3);
  for (Eigen::Index k = 0; k < inverse_modes_.size(); ++k) {
    result.col(6 + k) = inverse_modes_[k] * G.col(6 + k);
    right.noalias() -= result.col(6 + k) * coupling_.col(k).transpose();
  }
  const Eigen::Matrix<double, 6, 3> turned =
      right * inverse_rotation_.transpose();
  result.middleCols<3>(3) = turned;
  for (Eigen::Index k = 0; k < inverse_modes_.size(); ++k) {
    result.col(6 + k) -= inverse_modes_[k] * (turned * back_coupling_.col(k));
  }
}

// Six modes by six, with the identity where there are none.
Matrix6 ModalFactor::modal_block(int row, int column) const {
  const Eigen::Index modes = coupling_.cols();
  const Eigen::Index i = Eigen::Index{6} * row - 6;
  const Eigen::Index j = Eigen::Index{6} * column - 6;
  const Eigen::Index rows = std::min<Eigen::Index>(6, modes - i);
  const Eigen::Index columns = std::min<Eigen::Index>(6, modes - j);
  Matrix6 D = Matrix6::Zero();
  if (row == column) D.setIdentity();
  if (coupled_modes_) {
    D.topLeftCorner(rows, columns) =
        coupled_modes_->matrix().block(i, j, rows, columns);
  } else if (row == column) {
    D.diagonal().head(rows) = inverse_modes_.segment(i, rows).cwiseInverse();
  }
  return D;
}

Matrix6 ModalFactor::block(int row, int column) const {
  if (row > 0 && column > 0) return modal_block(row, column);
  const Eigen::Index modes = coupling_.cols();
  const auto first_mode = [](int i) { return Eigen::Index{6} * i - 6; };
  const auto count = [&](int i) {
    return std::min<Eigen::Index>(6, modes - first_mode(i));
  };
  Matrix6 D = Matrix6::Zero();
  if (row == column) {
    D.setIdentity();
    if (inverse_mass_ > 0.0) {
      D.topLeftCorner<3, 3>() /= inverse_mass_;
      D.bottomRightCorner<3, 3>() = rotation_;
    }
  } else if (row == 0) {
    D.block(3, 0, 3, count(column)) =
        coupling_.middleCols(first_mode(column), count(column));
  } else if (column == 0) {
    D.block(0, 3, count(row), 3) =
        back_coupling_.middleCols(first_mode(row), count(row)).transpose();
  }
  return D;
}

}  // namespace limber::dynamics
