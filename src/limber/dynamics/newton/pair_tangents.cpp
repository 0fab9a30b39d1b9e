// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/pair_tangents.hpp"

#include <algorithm>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {
namespace {

using Block = Eigen::Ref<MatrixX>;

// 3 rows: motion of a point, world frame, per increment. @param eta of the body
void fill_rows(const BodyModel& body, const Matrix3& R_WB, const double* eta,
               const joints::PairPlace& place, const Vector3& arm_B,
               double sign, Block rows) {
  rows.setZero();
  if (body.has_rigid_motion()) {
    rows.leftCols<3>().diagonal().setConstant(sign);
    rows.middleCols<3>(3) = (-sign * R_WB) * skew(arm_B);
  }
  const Eigen::Index products = place.Phi_B.cols() - body.modes;
  auto modes = rows.middleCols(6, body.modes);
  modes = place.Phi_B.leftCols(body.modes);
  flexbody::add_product_columns(paired_of(body),
                                place.Phi_B.rightCols(products), eta, modes);
  const Matrix3 rotation = sign * R_WB;
  for (Eigen::Index k = 0; k < body.modes; ++k) {
    const Vector3 column = modes.col(k);
    modes.col(k) = rotation * column;
  }
}

}  // namespace

PairTangents::PairTangents(const SystemModel& model)
    : counts_(model.pairs.size(), 0) {
  std::size_t points = 0;
  int modes = 0;
  for (const Pair& pair : model.pairs) {
    points = std::max(points, pair.law->most_points());
    for (const BodyIndex b : {pair.body_A, pair.body_B}) {
      if (b != kWorld) modes = std::max(modes, model.bodies[index(b)].modes);
    }
  }
  if (points == 0) return;
  const int blocks = 1 + (modes + 5) / 6;
  for (Columns* columns : {&A_, &B_}) {
    columns->acting = columns->moving = columns->forces =
        MatrixX::Zero(3 * static_cast<Eigen::Index>(points), 6 * blocks);
  }
}

bool PairTangents::update(const SystemTerms& terms) {
  bool differs = false;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const std::size_t count = terms.pairs.responses[i].points().size();
    differs = differs || (count > 0) != (counts_[i] > 0);
    counts_[i] = count;
  }
  return differs;
}

bool PairTangents::knows(const SystemTerms& terms) const {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (terms.pairs.responses[i].points().size() != counts_[i]) return false;
  }
  return true;
}

// Unreduced bodies count as the world; their motion: ResidualDerivative.
std::vector<BodyPair> PairTangents::active(const SystemModel& model) const {
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] == 0) continue;
    const auto find_kept = [&](BodyIndex b) {
      return b != kWorld && !has_dense_block(model, index(b)) ? kWorld : b;
    };
    pairs.emplace_back(find_kept(model.pairs[i].body_A),
                       find_kept(model.pairs[i].body_B));
  }
  return pairs;
}

void PairTangents::fill(const SystemModel& model, const Pair& pair, bool is_A,
                        const joints::PairResponse& response,
                        const SystemTerms& terms, const SystemTerms& end_terms,
                        double velocity, const LuPlan& plan, Columns& columns) {
  const BodyIndex b = is_A ? pair.body_A : pair.body_B;
  columns.blocks = 0;
  if (b == kWorld || !has_dense_block(model, index(b))) return;
  const RetainedUnknowns& retained =
      plan.retained[index(plan.retained_of_body[index(b)])];
  columns.first = retained.first;
  columns.blocks = retained.blocks;
  const BodyModel& body = model.bodies[index(b)];
  const double sign = is_A ? -1.0 : 1.0;
  const double* acting_eta = terms.pairs.bodies[index(b)].eta;
  const double* moving_eta = end_terms.pairs.bodies[index(b)].eta;
  Eigen::Index row = 0;
  for (const joints::PairPoint& point : response.points()) {
    const auto rows = [&](MatrixX& all) {
      return all.block(row, 0, 3, 6 * retained.blocks);
    };
    const joints::PairPlace& place = is_A ? point.on_A : point.on_B;
    fill_rows(body, terms.bodies[index(b)].R_WB, acting_eta, place,
              is_A ? point.acting.A : point.acting.B, sign,
              rows(columns.acting));
    fill_rows(body, end_terms.bodies[index(b)].R_WB, moving_eta, place,
              is_A ? point.moving.A : point.moving.B, sign,
              rows(columns.moving));
    const Matrix3 K = point.stiffness + velocity * point.damping;
    rows(columns.forces).noalias() = K.lazyProduct(rows(columns.moving));
    row += 3;
  }
  if (response.is_coupled()) add_coupling(response, velocity, columns);
}

void PairTangents::add_coupling(const joints::PairResponse& response,
                                double velocity, Columns& columns) {
  const std::size_t count = response.points().size();
  const auto rows = [&](MatrixX& all, std::size_t i) {
    return all.block(3 * static_cast<Eigen::Index>(i), 0, 3,
                     6 * columns.blocks);
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      if (j == i) continue;
      const Matrix3 K =
          response.coupling(i, j) + velocity * response.damping_coupling(i, j);
      rows(columns.forces, i).noalias() +=
          K.lazyProduct(rows(columns.moving, j));
    }
  }
}

void PairTangents::add(const SystemModel& model, const SystemTerms& terms,
                       const SystemTerms& end_terms, double velocity,
                       LuPlan& plan) {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] == 0) continue;
    const joints::PairResponse& response = terms.pairs.responses[i];
    fill(model, model.pairs[i], true, response, terms, end_terms, velocity,
         plan, A_);
    fill(model, model.pairs[i], false, response, terms, end_terms, velocity,
         plan, B_);
    const auto rows = static_cast<Eigen::Index>(3 * counts_[i]);
    for (const Columns* on : {&A_, &B_}) {
      for (const Columns* by : {&A_, &B_}) {
        for (int p = 0; p < on->blocks; ++p) {
          for (int q = 0; q < by->blocks; ++q) {
            plan.lu.block(on->first + p, by->first + q) +=
                on->acting.middleCols<6>(6 * p)
                    .topRows(rows)
                    .transpose()
                    .lazyProduct(by->forces.middleCols<6>(6 * q).topRows(rows));
          }
        }
      }
    }
  }
}

}  // namespace limber::dynamics
