// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// A body with the lowest `count` modes of its basis alone, or all of them if
/// it has no more.
///
/// Equation   Phi' = the first columns of Phi, which stay M-orthonormal and
///            K-diagonal; all tables are sums over the mesh with Phi
/// Limits     The highest modes are mostly what static-deformation modes add:
///            without them a body is too stiff under its loads. The levers and
///            the records of its reduction remain those of all modes.
/// @throws InputError for a body with contact surfaces, second-order kinematics
/// or initial deformation, whose values depend on all modes, or if count < 1.
[[nodiscard]] ReducedBody keep_lowest_modes(ReducedBody body, int count);

/// Whether keep_lowest_modes takes the body.
[[nodiscard]] bool has_separable_modes(const ReducedBody& body);

}  // namespace limber::flexbody
