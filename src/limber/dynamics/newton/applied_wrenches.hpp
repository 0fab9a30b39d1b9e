// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/terms/system_terms.hpp"

/// The iterates of wrenches in Newton's method, as one vector: six per coupler
/// [N, N m], then one per transmission [N or N m].
namespace limber::dynamics {

[[nodiscard]] Eigen::Index count_wrench_rows(const SystemTerms& terms);

/// Reads those of `terms`, without allocation if the size fits.
void get_applied(const SystemTerms& terms, VectorX& wrenches);

void set_applied(const VectorX& wrenches, SystemTerms& terms);

/// Stores what holds ideal joints: the solution, and from it and the last one
/// the wrench at the state, by a straight line.
/// @param ends of a step that the wrenches of `terms` are the sum of
/// @param time of their mean, up to the state's [s]
void store_constraint_wrenches(const SystemTerms& terms, double ends,
                               double time, SystemState& state);

/// @param increments of NewtonMatrix @param fraction of them that is added [-]
void add_to_applied(const std::vector<Vector6>& increments, SystemTerms& terms,
                    double fraction = 1.0);

}  // namespace limber::dynamics
