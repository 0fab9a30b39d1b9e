// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "limber/common/files/file_stamp.hpp"
#include "limber/common/progress.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/reduction/matrices/matrix_body.hpp"
#include "limber/reduction/matrices/matrix_part.hpp"

/// Reduction of a model given by matrices. Part of limber_reduction.
namespace limber::flexbody {

/// Whether a source is a model with unknowns at nodes, given by its matrices,
/// as a deck of beams and shells, or as a mesh with sections.
[[nodiscard]] bool is_node_model(const MeshSource& source);

/// What a part was read from.
struct PartOrigin {
  std::vector<std::filesystem::path> paths;  ///< of a deck
  std::vector<FileStamp> stamps;             ///< of a mesh with sections
  bool is_repeatable = true;  ///< whether these alone determine it
};

/// Reads, and checks as make_matrix_part, what recipe.mesh.matrices names, or
/// assembles the beams and shells of recipe.mesh.file.
/// @param origin if given, is set, except of matrices
/// @throws InputError naming the file and line, the node or the value
[[nodiscard]] std::shared_ptr<const MatrixPart> read_matrix_part(
    const MeshSource& source, const Progress& progress = {},
    PartOrigin* origin = nullptr);

/// Makes the surfaces of a body that may touch others.
/// @param fields its modes at all nodes, six rows a node (field_row)
/// @param center of mass, in the model's frame [m]
using SurfaceMaker = std::function<std::vector<ContactSurface>(
    const MatrixBody& body, const ReducedBasis& basis, const MatrixX& fields,
    const Vector3& center)>;

/// Modes, static-deformation modes and tables like those of a mesh. The stored
/// rows are translations of nodes, also of condensed ones.
/// @param make_surfaces none: the body has none
/// @throws InputError as MatrixBody; NumericalError if an eigenpair or a solve
/// misses its tolerance
[[nodiscard]] ReducedBody reduce_matrices(
    const Recipe& recipe, const std::shared_ptr<const MatrixPart>& part,
    const Progress& progress = {}, const SurfaceMaker& make_surfaces = {});

}  // namespace limber::flexbody
