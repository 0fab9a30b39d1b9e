// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::results {

/// Writes a free body as stiffness and mass matrix of some displacements of its
/// nodes, which replace its modal coordinates, and how all its other nodes
/// follow: a folder that `--matrices` reads. Files: K.mtx, M.mtx; S_xx.mtx and
/// five more (second moments of the mass); nodes.csv, rows.csv;
/// otm.mtx and otm_rows.csv (recovery rows). Interfaces are nodes of their own.
/// In SI units, in the frame of the mesh.
///
/// Equation   z = T q with q = rows of the nodes chosen by Gram and Schmidt's
///            method with pivoting, then modal coordinates where the nodes do
///            not move in a mode; K = T^T diag(0, lambda) T
/// @throws InputError if the body is clamped, its S1 and S2 are not known, or
/// a file cannot be written
void write_matrix_folder(const std::filesystem::path& folder,
                         const flexbody::ReducedBody& body);

}  // namespace limber::results
