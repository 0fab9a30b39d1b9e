// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/fem/mesh/mesh_pieces.hpp"

namespace limber::fem {

/// Cuts a mesh into `count` pieces of about equal volume along its length,
/// between elements.
///
/// Equation   elements in the order of f, the lowest mode of diffusion in the
///            solid: div grad f + mu f = 0, no flow through the surface. Along
///            a straight or curved bar f is a cosine of the place on its
///            centre line, so that cuts are across it. A cut is moved to the
///            nearest large step of f, between two layers of elements
/// Source     spectral bisection: [@fiedler1975]; here of the solid itself
/// Limits     needs a body with one long direction: throws if a piece would
///            consist of two parts, as in a ring cut into three
/// @throws InputError for pieces without elements or in several parts
[[nodiscard]] CutMesh cut_mesh(const Mesh& mesh, int count);

/// Number of pieces that suits a mesh's slenderness.
struct PieceAdvice {
  int count = 1;
  std::string reason;  ///< why it stays whole
};

/// A piece shorter than this many times its thickness gains nothing [-].
inline constexpr double kLeastSlenderness = 5.0;

/// Advises two pieces for a mesh that is slender enough, else one.
///
/// Equation   slenderness = length / thickness, length = pi / sqrt(mu) of the
///            mode above, thickness = the largest extent of a cut in the middle
[[nodiscard]] PieceAdvice advise_pieces(const Mesh& mesh);

}  // namespace limber::fem
