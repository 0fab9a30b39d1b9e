// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/piece_assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/flexbody/model/piece.hpp"

namespace limber::flexbody {
namespace {

constexpr Eigen::Index kWrench = 6;

const InterfaceTable* find_table(const ReducedBody& body,
                                 const std::string& name) {
  const auto found = std::find_if(
      body.interfaces.begin(), body.interfaces.end(),
      [&](const InterfaceTable& table) { return table.name == name; });
  return found == body.interfaces.end() ? nullptr : &*found;
}

/// x of A x = B for a symmetric A whose rows have different units, by rows and
/// columns divided by `scale`.
MatrixX solve_scaled(const MatrixX& A, const MatrixX& B, const VectorX& scale) {
  const VectorX d = scale.cwiseInverse();
  return d.asDiagonal() * dense::solve(d.asDiagonal() * A * d.asDiagonal(),
                                       MatrixX(d.asDiagonal() * B));
}

}  // namespace

Matrix6 calc_cut_stiffness(const Matrix6& F, const Matrix6& M) {
  // Lengths in units of the flexibilities' own, for the inverse's accuracy.
  const Matrix6 C = F + M;
  const VectorX scale = C.diagonal().cwiseSqrt().cwiseInverse();
  const auto L = dense::find_cholesky(
      MatrixX(scale.asDiagonal() * C * scale.asDiagonal()));
  if (!L) {
    throw InputError(
        "its pieces cannot be joined: a cut is a line or a point of nodes");
  }
  const MatrixX half = dense::solve_lower(*L, MatrixX(scale.asDiagonal()));
  return kCutStiffnessRatio * (half.transpose() * half);
}

PieceAssembly::PieceAssembly(const Bodies& pieces) : pieces_(pieces) {
  Eigen::Index rigid = 0, modes = 0;
  for (const auto& piece : pieces_) {
    first_rigid_.push_back(rigid);
    first_mode_.push_back(modes);
    rigid += piece->clamped ? 0 : kWrench;
    modes += piece->lambda.size();
    lambda_.conservativeResize(modes);
    lambda_.tail(piece->lambda.size()) = piece->lambda;
  }
  first_rigid_.push_back(rigid);
  first_mode_.push_back(modes);
  for (std::size_t second = 1; second < pieces_.size(); ++second)
    add_cuts(second);
}

bool PieceAssembly::is_free() const {
  return std::none_of(pieces_.begin(), pieces_.end(),
                      [](const auto& piece) { return piece->clamped; });
}

PieceAssembly::Rows PieceAssembly::find_rows(
    std::size_t piece, const InterfaceTable& table) const {
  Rows rows{MatrixX::Zero(kWrench, first_rigid_.back()),
            MatrixX::Zero(kWrench, lambda_.size())};
  if (!pieces_[piece]->clamped) {
    auto rigid = rows.rigid.middleCols<kWrench>(first_rigid_[piece]);
    rigid.setIdentity();
    rigid.topRightCorner<3, 3>() = -skew(table.p_B);
  }
  auto modes = rows.modes.middleCols(first_mode_[piece], table.Phi_B.cols());
  modes << table.Phi_B, table.Psi_B;
  return rows;
}

PieceAssembly::Rows PieceAssembly::find_rows(
    const std::string& interface) const {
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    const InterfaceTable* table = find_table(*pieces_[piece], interface);
    if (table != nullptr) return find_rows(piece, *table);
  }
  throw ContractError("no piece has interface '" + interface + "'");
}

void PieceAssembly::add_cuts(std::size_t second) {
  for (const InterfaceTable& table : pieces_[second]->interfaces) {
    if (!is_cut(table.name)) continue;
    for (std::size_t first = 0; first < second; ++first) {
      const InterfaceTable* other = find_table(*pieces_[first], table.name);
      if (other == nullptr) continue;
      const Rows F = find_rows(first, *other);
      const Rows M = find_rows(second, table);
      cuts_.push_back({{M.rigid - F.rigid, M.modes - F.modes},
                       other->flexibility,
                       table.flexibility});
    }
  }
}

VectorX PieceAssembly::find_frequencies(Eigen::Index count) const {
  const Eigen::Index rigid = first_rigid_.back();
  const Eigen::Index size = rigid + lambda_.size();
  MatrixX K = MatrixX::Zero(size, size);
  MatrixX M = MatrixX::Identity(size, size);
  K.diagonal().tail(lambda_.size()) = lambda_;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    if (pieces_[p]->clamped) continue;
    const Eigen::Index at = first_rigid_[p];
    M.block<3, 3>(at, at) *= pieces_[p]->mass;
    M.block<3, 3>(at + 3, at + 3) = pieces_[p]->inertia();
  }
  for (const Cut& cut : cuts_) {
    MatrixX gap(kWrench, size);
    gap << cut.gap.rigid, cut.gap.modes;
    K += gap.transpose() *
         calc_cut_stiffness(cut.flexibility_F, cut.flexibility_M) * gap;
  }
  const VectorX lambda = dense::find_eigenpairs(K, M).values;
  const Eigen::Index skipped = is_free() ? kWrench : 0;
  const Eigen::Index found = std::min(count, lambda.size() - skipped);
  return lambda.segment(skipped, found).cwiseMax(0.0).cwiseSqrt() /
         (2.0 * std::numbers::pi);
}

Matrix6 PieceAssembly::find_flexibility(const std::string& at,
                                        const std::string& held) const {
  const Eigen::Index rigid = first_rigid_.back();
  const auto cuts = static_cast<Eigen::Index>(cuts_.size());
  const Eigen::Index wrenches = kWrench * (cuts + (held.empty() ? 0 : 1));
  MatrixX B(wrenches, rigid), S(wrenches, lambda_.size());
  MatrixX C = MatrixX::Zero(wrenches, wrenches);
  for (Eigen::Index c = 0; c < cuts; ++c) {
    const Cut& cut = cuts_[static_cast<std::size_t>(c)];
    B.middleRows<kWrench>(kWrench * c) = cut.gap.rigid;
    S.middleRows<kWrench>(kWrench * c) = cut.gap.modes;
    C.block<kWrench, kWrench>(kWrench * c, kWrench * c) =
        (cut.flexibility_F + cut.flexibility_M) / kCutStiffnessRatio;
  }
  if (!held.empty()) {
    const Rows root = find_rows(held);
    B.bottomRows<kWrench>() = root.rigid;
    S.bottomRows<kWrench>() = root.modes;
  }
  const MatrixX S_flexible = S * lambda_.cwiseInverse().asDiagonal();
  C += S_flexible * S.transpose();
  const Rows tip = find_rows(at);

  MatrixX A = MatrixX::Zero(rigid + wrenches, rigid + wrenches);
  A.topRightCorner(rigid, wrenches) = B.transpose();
  A.bottomLeftCorner(wrenches, rigid) = B;
  A.bottomRightCorner(wrenches, wrenches) = -C;
  MatrixX loads(rigid + wrenches, kWrench);
  loads << tip.rigid.transpose(), -S_flexible * tip.modes.transpose();
  VectorX scale(rigid + wrenches);
  scale.tail(wrenches) = C.diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < rigid; ++i)
    scale[i] = B.col(i).cwiseQuotient(scale.tail(wrenches)).norm();
  const MatrixX x = solve_scaled(A, loads, scale);
  const MatrixX modal =
      tip.modes.transpose() - S.transpose() * x.bottomRows(wrenches);
  const Matrix6 motion =
      tip.rigid * x.topRows(rigid) +
      tip.modes * lambda_.cwiseInverse().asDiagonal() * modal;
  return 0.5 * (motion + motion.transpose());
}

}  // namespace limber::flexbody
