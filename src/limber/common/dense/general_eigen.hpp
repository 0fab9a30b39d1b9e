// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/common/types.hpp"

/// Eigenvalues of square matrices without symmetry.
///
/// Source     Hessenberg form and QR with shifts: Golub and Van Loan, Matrix
///            Computations, 3rd ed., 7.4 to 7.6 [@golub1996]
namespace limber::dense {

/// A = U T U*, T upper triangular with the eigenvalues on its diagonal, U
/// unitary, all n x n.
struct ComplexSchur {
  Eigen::MatrixXcd U;
  Eigen::MatrixXcd T;
};

/// @returns nothing if the iteration does not converge
[[nodiscard]] std::optional<ComplexSchur> find_complex_schur(
    const Eigen::MatrixXcd& A);

/// Conjugate eigenvalues are neighbours, the one with the positive imaginary
/// part first; otherwise in no order.
struct GeneralEigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< columns of unit length; empty if not wanted
};

[[nodiscard]] GeneralEigenpairs find_general_eigenpairs(const MatrixX& A,
                                                        bool with_vectors);

}  // namespace limber::dense
