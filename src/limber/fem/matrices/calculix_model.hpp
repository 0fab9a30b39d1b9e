// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/fem/matrices/input_deck.hpp"
#include "limber/fem/matrices/matrix_model.hpp"
#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// An element of shells or beams that CalculiX expanded to a solid.
struct ExpandedElement {
  std::vector<long> nodes;     ///< of the input file
  std::vector<long> topology;  ///< of the solid
};

/// Reads CalculiX's .12d. @throws InputError with file and line
[[nodiscard]] std::vector<ExpandedElement> read_expansion(
    const std::filesystem::path& file);

/// Reads the nodes of a CalculiX result file (.frd), written with *NODE FILE,
/// OUTPUT=3D: those of the solids that shells and beams were expanded to, with
/// six digits. @throws InputError with file and line
[[nodiscard]] ModelFile read_frd(const std::filesystem::path& file);

/// Replaces nodes of shells and beams in rows, sets and elements by those of
/// the solid. The .dof file names the rows of all nodes at one place alike, in
/// the order of their numbers; where their count differs (knots, supports) the
/// rows remain of unknown kind: their labels get a component above 6. So do
/// rows of nodes that are in no file (incompatible modes).
/// @param solid nodes of the .frd
void expand_nodes(const std::vector<ExpandedElement>& elements,
                  const ModelFile& solid, InputDeck& deck,
                  std::vector<RowLabel>& rows);

/// Names the rows of a rigid body's rotations as components 4 to 6 of its
/// reference node.
void name_rotations(const InputDeck& deck, std::vector<RowLabel>& rows);

/// Adds the constraints of the input file on condensed rows: nodes of
/// rigid bodies, first terms of equations. What cannot be derived from rows
/// alone is reported in `found`. @param model with tags, x and rows; `rows`
/// beside them
void add_constraints(const InputDeck& deck, const std::vector<RowLabel>& rows,
                     MatrixModel& model);

}  // namespace limber::fem
