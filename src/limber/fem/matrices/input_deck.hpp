// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "limber/fem/matrices/model_file.hpp"
#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// A linear equation between displacements: sum of factors times rows = 0. The
/// first is eliminated.
struct DeckEquation {
  std::string place;  ///< "file:line"
  std::vector<std::pair<RowLabel, double>> terms;
};

/// Nodes that move with a reference node as a rigid body.
struct DeckRigid {
  std::string place;  ///< "file:line"
  long reference = 0;
  /// Node whose three displacements are the rotations; 0: one that CalculiX
  /// made.
  long rotation = 0;
  std::vector<long> nodes;
  std::array<bool, 3> translations = {true, true, true};  ///< that follow
};

/// Data of nodes in an input file of CalculiX or Abaqus.
struct InputDeck {
  ModelFile model;
  std::vector<DeckEquation> equations;
  std::vector<DeckRigid> rigids;  ///< *RIGID BODY, *COUPLING with *KINEMATIC
  std::vector<RowLabel> fixed;    ///< *BOUNDARY of the model, without value
  /// A constraint of another kind is there, which makes nodes of its own.
  bool has_other_constraints = false;
  bool has_transform = false;  ///< *TRANSFORM
};

/// Reads *NODE, *ELEMENT, *NSET, *ELSET, *BOUNDARY, *EQUATION, *RIGID BODY,
/// *COUPLING with *KINEMATIC and *INCLUDE; of parts, one instance that is not
/// moved. Other keywords are ignored.
/// Source: CalculiX 2.20 User's Manual, Abaqus Keywords Reference Guide.
/// @throws InputError with file and line, also for nodes that the program
/// generates or that are given in other coordinates (*NGEN, *SYSTEM ...)
[[nodiscard]] InputDeck read_input_deck(const std::filesystem::path& file);

}  // namespace limber::fem
