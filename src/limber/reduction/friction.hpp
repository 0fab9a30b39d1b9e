// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reduction/meshed_body.hpp"

namespace limber::flexbody {

/// Damping of a body: D = mass_rate M + stiffness_time K + surface S, with S
/// from fem::assemble_surface_matrix. The stiffness part does not resist rigid
/// motion, and so no steady motion.
struct Friction {
  double mass_rate = 0.0;       ///< >= 0, Rayleigh's alpha [1/s]
  double stiffness_time = 0.0;  ///< >= 0, Rayleigh's beta [s]
  double surface = 0.0;         ///< >= 0, drag per speed and area [N s/m^3]
};

/// D_s of D = D_s (x) I_3 + stiffness_time K: N x N on all nodes [N s/m].
/// @throws InputError for values below zero or not finite, and if nothing
/// resists rigid motion.
[[nodiscard]] fem::SparseMatrix make_drag(const MeshedBody& body,
                                          const Friction& friction);

/// D X on the free nodes, 3n x k [N for m/s].
[[nodiscard]] MatrixX multiply_damping(const MeshedBody& body,
                                       const Friction& friction,
                                       const MatrixX& X);

}  // namespace limber::flexbody
