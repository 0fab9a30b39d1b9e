// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/flexbody/model/reduced_body.hpp"

/// Reduced bodies as other programs read them, each the bytes of a file.
namespace limber::results {

/// Simscape Multibody's Reduced Order Flexible Solid, a MAT file: P, origins of
/// the interface frames (one a row) [m]; K, M, D in their coordinates, six a
/// frame (translations, rotations), then modal ones; `interfaces`, the frames'
/// names. In the frame of the mesh.
///
/// Equation   z = Psi u + N q: Psi least strain energy (constraint modes), N
///            modes at fixed interfaces, as Craig and Bampton
/// Source     Simscape Multibody, "Reduced Order Flexible Solid"
/// @param ratio of damping of the free body's modes [-]
/// @throws InputError if the body is clamped, has no interface, one without
/// three rotations, or fewer coordinates than interfaces need
[[nodiscard]] std::string make_simscape_file(const flexbody::ReducedBody& body,
                                             double ratio);

/// Flexible body of NASA's simulator 42 (Flex_*.txt): its modes at the
/// interfaces, which are the analysis nodes, and the integrals of second order.
///
/// Equation   L_ijm = int x_i phi_jm dm = S1_m, N_ijml = int phi_im phi_jl dm =
///            S2_ml
/// Source     42, 42init.c, InitFlexModes; 42dynamics.c, FindFlexTerms
/// @throws InputError if the body is clamped, or its S1 and S2 are not known
[[nodiscard]] std::string make_flex42_file(const flexbody::ReducedBody& body,
                                           double ratio);

/// The same program's table of the body's analysis nodes (YAML).
[[nodiscard]] std::string make_nodes42_file(const flexbody::ReducedBody& body);

/// Universal file: units (164), stored nodes (2411, or 15 as programs of modal
/// tests expect) and modes (55), in the frame of the mesh.
/// Source     SDRC, Universal File Datasets 15, 55, 164, 2411
[[nodiscard]] std::string make_universal_file(const flexbody::ReducedBody& body,
                                              double ratio, bool is_of_test);

}  // namespace limber::results
