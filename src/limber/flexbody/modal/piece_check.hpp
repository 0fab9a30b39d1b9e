// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/flexbody/modal/piece_assembly.hpp"
#include "limber/flexbody/model/recipe.hpp"

/// Error of cutting a link: its pieces, joined, compared with the whole.
namespace limber::flexbody {

/// A quantity of the link in one piece and in several.
struct PieceDifference {
  std::string quantity;
  std::string unit;
  double whole = 0.0;
  double pieces = 0.0;

  /// Of the pieces, relative to the whole [-].
  [[nodiscard]] double error() const { return pieces / whole - 1.0; }
};

struct PieceCheck {
  std::string link;
  int count = 0;  ///< number of pieces
  /// The largest one of the lowest frequencies, of translational and of
  /// rotational flexibilities between interfaces; none if `obstacle` says why
  /// the whole could not be reduced.
  std::vector<PieceDifference> differences;
  std::string obstacle;
};

/// Number of lowest elastic frequencies that are compared.
inline constexpr int kComparedFrequencies = 3;

/// The whole link with what the comparison needs, with the interfaces whose
/// static-deformation modes the pieces have.
[[nodiscard]] Recipe make_whole_recipe(const Recipe& of_pieces);

/// Compares the lowest frequencies of the free (or clamped) link, and the
/// flexibility at each interface of `whole` along its principal directions,
/// with the first that defines three rotations held. Directions in which the
/// link is a million times stiffer than in the softest are omitted.
///
/// @param whole the reduction of make_whole_recipe()
[[nodiscard]] std::vector<PieceDifference> compare_pieces(
    const std::shared_ptr<const ReducedBody>& whole,
    const PieceAssembly::Bodies& pieces);

/// "0.31 %, of elastic frequency 2 of the free link": the largest difference;
/// or why there is none.
[[nodiscard]] std::string describe_largest(const PieceCheck& check);

/// A text if a difference is above 1 %, or if none is known.
[[nodiscard]] std::optional<std::string> describe_excess(
    const PieceCheck& check);

}  // namespace limber::flexbody
