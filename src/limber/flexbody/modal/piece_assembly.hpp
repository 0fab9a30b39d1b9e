// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// Stiffness of a cut relative to that of its two pieces, in every direction
/// [-].
inline constexpr double kCutStiffnessRatio = 10000.0;

/// Stiffness of the joint of two pieces at a cut.
///
/// Equation   K = kCutStiffnessRatio (C_F + C_M)^-1, with C the flexibility of
///            each piece at its side of the cut: the cut adds at most 0.01 % to
///            the flexibility of the pieces, in tension as in bending
/// @param F, M flexibilities, 6 x 6, translation first [m/N, rad/(N m)]
/// @throws InputError for a cut of nodes on a line or of a single node.
[[nodiscard]] Matrix6 calc_cut_stiffness(const Matrix6& F, const Matrix6& M);

/// Small motions of the pieces of a link, joined at their cuts; a whole body is
/// an assembly of one piece. All quantities are in the axes of the mesh.
class PieceAssembly {
 public:
  using Bodies = std::vector<std::shared_ptr<const ReducedBody>>;

  /// @throws InputError as calc_cut_stiffness() does.
  explicit PieceAssembly(const Bodies& pieces);

  /// A free link has six rigid motions.
  [[nodiscard]] bool is_free() const;

  /// Lowest elastic frequencies, ascending; fewer than `count` if there are not
  /// as many [Hz]. @throws InputError as calc_cut_stiffness() does.
  [[nodiscard]] VectorX find_frequencies(Eigen::Index count) const;

  /// Motion of the interface `at` under unit forces and moments there, 6 x 6,
  /// translation first [m/N, rad/(N m)]. The mean motion of the interface
  /// `held` is zero; empty for a clamped link.
  ///
  /// Equation   [0  B^T; B  -(A + S Lambda^-1 S^T)] [r; w]
  ///                = [T^T; -S Lambda^-1 D^T],
  ///            r: rigid motions of the pieces, w: forces and moments of cuts
  ///            and of the held interface, A: inverse stiffness of the cuts,
  ///            B and S: relative motions there, T and D: motion of `at`, by r
  ///            and by the modes. Without penalties, accurate for any
  ///            slenderness
  [[nodiscard]] Matrix6 find_flexibility(const std::string& at,
                                         const std::string& held) const;

 private:
  /// 6 rows of motion by all rigid motions and modes.
  struct Rows {
    MatrixX rigid;
    MatrixX modes;
  };
  struct Cut {
    Rows gap;  ///< motion of one side relative to the other
    Matrix6 flexibility_F, flexibility_M;
  };

  [[nodiscard]] Rows find_rows(std::size_t piece,
                               const InterfaceTable& table) const;
  [[nodiscard]] Rows find_rows(const std::string& interface) const;
  void add_cuts(std::size_t second);

  Bodies pieces_;
  std::vector<Eigen::Index> first_rigid_, first_mode_;  // and the totals
  VectorX lambda_;                                      // of all modes
  std::vector<Cut> cuts_;
};

}  // namespace limber::flexbody
