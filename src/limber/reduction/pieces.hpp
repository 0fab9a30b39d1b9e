// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/mesh_cut.hpp"
#include "limber/flexbody/model/piece.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/reduction/modal/interfaces.hpp"

/// Bodies of a part of a mesh. Part of limber_reduction.
namespace limber::flexbody {

/// A piece of a recipe's mesh, to be reduced as a body of its own.
struct PieceOfMesh {
  std::shared_ptr<const fem::TracedMesh> mesh;
  Recipe recipe;  ///< with the names that the piece has
  /// The recipe's interfaces in the piece, and its sides of the cuts.
  std::vector<Interface> interfaces;
};

/// The pieces of a mesh.
///
/// Interfaces keep their nodes and weights of the whole mesh. An interface
/// whose nodes are all in one piece belongs to it, at a cut to the first piece.
/// Interfaces where pieces 1 and 2 meet are called "cut:1-2", with ".2" and so
/// on for further faces between the same two; their weights are those of a load
/// spread by area, and their static-deformation modes enter the basis.
class Pieces {
 public:
  explicit Pieces(std::shared_ptr<const fem::TracedMesh> whole);

  [[nodiscard]] PieceAdvice advise() const;

  /// @throws InputError for an interface that spans two pieces, and for nodal
  /// forces and fields, which need the whole mesh.
  [[nodiscard]] PieceOfMesh take(const Recipe& recipe, const Piece& piece);

 private:
  const fem::CutMesh& get_cut(int count);

  std::shared_ptr<const fem::TracedMesh> whole_;
  std::map<int, fem::CutMesh> cuts_;  // by the number of pieces
};

}  // namespace limber::flexbody
