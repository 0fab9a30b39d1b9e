// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/operating_state.hpp"

/// Shared helpers of operating states.
namespace limber::flexbody {

/// Net force and moment.
struct NetLoad {
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< about the given point [N m]
};
[[nodiscard]] NetLoad sum_load(const Matrix3X& x, const Matrix3X& load,
                               const Vector3& about);

/// @throws InputError for values that are not finite, or a zero load.
void check_load(const MeshedBody& body, const Matrix3X& load);

/// Fills the fields of a state that its deformation determines.
/// @param x on the free nodes [m]
/// @param load all nodal forces, inertia and friction included, 3 x N [N]
void fill_state(const MeshedBody& body, const VectorX& x, const Matrix3X& load,
                OperatingState& state);

/// A load whose net force or moment is at most this fraction of its size counts
/// as balanced, because meshes are not exactly symmetric [-].
inline constexpr double kBalanced = 1e-6;

}  // namespace limber::flexbody
