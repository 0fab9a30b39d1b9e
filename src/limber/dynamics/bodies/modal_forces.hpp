// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"

/// Forces on a body's modes and, at level nonlinear, on their products.
namespace limber::dynamics {

/// Adds a force on a body at a place to the forces on its modes and on their
/// products. @param force_B body frame [N]
void add_modal_force(const BodyModel& body, const joints::PairPlace& place,
                     const Vector3& force_B, BodyTerms& terms,
                     ProductTerms& products);

/// Subtracts the modal forces at eta, products included, of a force on a body
/// at a place from the residual. @param force_B body frame [N]
void add_modal_residual(const BodyModel& body, const joints::PairPlace& place,
                        const double* eta, const Vector3& force_B,
                        double* residual);

/// Adds the forces on products to those on the modes, once all are known.
/// @param state supplies eta
void add_product_forces(const BodyModel& body, const SystemState& state,
                        const ProductTerms& products, BodyTerms& terms);

/// Adds the derivative of minus the modal forces with respect to the modes at
/// level nonlinear: the geometric stiffness of all forces on interfaces, points
/// and nodes, m x m. @param terms with forces
void add_geometric_stiffness(const SystemModel& model, std::size_t body,
                             const SystemTerms& terms,
                             Eigen::Ref<MatrixX> stiffness);

}  // namespace limber::dynamics
