// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/nodal_body.hpp"

#include <algorithm>

#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"

namespace limber::dynamics {

UnknownRanges NodalBody::list_unknowns() const {
  const Eigen::Index dofs = full().dofs();
  UnknownRanges ranges;
  ranges.add({UnknownKind::nodes, first_row(), dofs,
              3.0 * body_.mass / static_cast<double>(dofs)});
  return ranges;
}

Vector3 NodalBody::find_translation(const SystemState& state,
                                    const VectorX& motion) const {
  return state.X_WH[f()].R *
         nodal_rows(model_, full(), motion).rowwise().mean();
}

double NodalBody::measure_squared(const SystemState& state,
                                  const VectorX& motion,
                                  const Vector3& translation) const {
  const Vector3 translation_H = state.X_WH[f()].R.transpose() * translation;
  const ConstNodes u_H = nodal_rows(model_, full(), motion);
  return (u_H.colwise() - translation_H).squaredNorm() /
         static_cast<double>(u_H.cols());
}

double NodalBody::find_rounded_square(const SystemState& state) const {
  // Forces of a whole mesh are differences of large ones: their round-off moves
  // soft modes by this factor more.
  constexpr double kNodalNoise = 100.0;
  const double r = radius_of_gyration(body_);
  const double reach =
      r * r + 3.0 *
                  state.u_H.segment(full().first, full().dofs()).squaredNorm() /
                  static_cast<double>(full().dofs());
  return reach * (kNodalNoise * kNodalNoise);
}

double NodalBody::measure_state(const SystemState& state) const {
  return state.u_H.segment(full().first, full().dofs()).squaredNorm();
}

BodyMomentum NodalBody::find_momentum(const SystemState& state,
                                      const SystemTerms& terms,
                                      Matrix3X& momenta) const {
  const FullTerms& t = terms.full[f()];
  const ConstNodes udot = nodes_of(full(), state.udot_H);
  momenta.resize(3, udot.cols());
  t.solver->multiply_mass(udot, momenta);
  const Matrix3& R_WH = state.X_WH[f()].R;
  return {.kinetic = 0.5 * momenta.cwiseProduct(udot).sum(),
          .momentum = R_WH * momenta.rowwise().sum(),
          .force = R_WH * t.force.rowwise().sum()};
}

void NodalBody::add_forces(const SystemState& state, const SystemTerms& terms,
                           WrenchSum& sum) const {
  const ConstNodes u_H = nodes_of(full(), state.u_H);
  const Pose& X_WH = state.X_WH[f()];
  const Matrix3X force = terms.full[f()].force - terms.full[f()].internal;
  for (Eigen::Index n = 0; n < force.cols(); ++n) {
    const Vector3 p = X_WH * (full().mesh->x_B.col(n) + u_H.col(n));
    sum.add(p, X_WH.R * force.col(n), Vector3::Zero());
  }
}

double NodalBody::sum_nodal_forces(const SystemTerms& terms) const {
  return terms.full[f()].force.norm();
}

void NodalBody::include(const joints::TouchReach& points,
                        SurfaceReach& reach) const {
  const Eigen::Index count = points.modes.size();
  reach.extent = std::max(reach.extent,
                          count > 0 ? points.modes[count - 1] : points.extent);
}

double NodalBody::find_speed(const SystemState& state,
                             const SurfaceReach& reach) const {
  return reach.extent *
         nodes_of(full(), state.udot_H).colwise().norm().maxCoeff();
}

PlaceChange NodalBody::change_place(const TangentPoint& at,
                                    const joints::PairPlace& place,
                                    const Vector3& /*arm_B*/,
                                    const VectorX& increments) const {
  const Matrix3 R_BH = at.terms.full[f()].frame.R_HB.transpose();
  const ConstNodes d_u = nodal_rows(model_, full(), increments);
  Vector3 moved = Vector3::Zero();
  for (Eigen::Index n = 0; n < d_u.cols(); ++n) {
    moved += place.Phi_B.middleCols<3>(3 * n) * (R_BH * d_u.col(n));
  }
  PlaceChange change;
  change.p = at.terms.pairs.bodies[b_].R_WB * moved;
  change.v = at.velocity * change.p;
  return change;
}

void NodalBody::add_force_change(const TangentPoint& at,
                                 const joints::PairPlace& place,
                                 const PlaceForce& force,
                                 const VectorX& /*increments*/,
                                 VectorX& residual) const {
  const Matrix3& R_HB = at.terms.full[f()].frame.R_HB;
  const Vector3 d_force_B =
      at.terms.pairs.bodies[b_].R_WB.transpose() * force.d_force;
  Nodes rows = nodal_rows(model_, full(), residual);
  for (Eigen::Index n = 0; n < rows.cols(); ++n) {
    if (full().mesh->held[static_cast<std::size_t>(n)] != 0) continue;
    const Vector3 part =
        place.Phi_B.middleCols<3>(3 * n).transpose() * d_force_B;
    rows.col(n) -= R_HB * part;
  }
}

void NodalBody::deform_nodes(std::span<const SystemState> states,
                             Eigen::Ref<MatrixX> u_B) const {
  Matrix3X deformation(3, full().mesh->node_count());
  for (Eigen::Index j = 0; j < u_B.cols(); ++j) {
    const SystemState& state = states[static_cast<std::size_t>(j)];
    MeanFrame frame;
    calc_mean_frame(model_, full(), state, frame);
    calc_deformation(full(), frame, nodes_of(full(), state.u_H), deformation);
    u_B.col(j) = deformation.reshaped();
  }
}

void NodalBody::place_nodes(std::span<const SystemState> states,
                            Eigen::Ref<MatrixX> p_WP) const {
  for (Eigen::Index j = 0; j < p_WP.cols(); ++j) {
    const SystemState& state = states[static_cast<std::size_t>(j)];
    const Pose& X_WH = state.X_WH[f()];
    const Matrix3X x = full().mesh->x_B + nodes_of(full(), state.u_H);
    p_WP.col(j).reshaped(3, x.cols()) = (X_WH.R * x).colwise() + X_WH.p;
  }
}

}  // namespace limber::dynamics
