// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "limber/common/types.hpp"

/// Tools of linear systems theory on the complex Schur form.
namespace limber::dynamics {

/// A = U T U*, T upper triangular, U unitary.
struct SchurForm {
  Eigen::MatrixXcd U;  ///< [-]
  Eigen::MatrixXcd T;  ///< [A's]
};

/// @param comes_first which eigenvalues come first on T's diagonal
/// Source     exchanges of neighbours by rotations: Golub and Van Loan, Matrix
///            Computations, 3rd ed., 7.6.2 [@golub1996]
/// @throws NumericalError if the eigenvalues do not converge.
[[nodiscard]] SchurForm find_schur_form(
    const MatrixX& A,
    const std::function<bool(const std::complex<double>&)>& comes_first = {});

/// Solves T X + X T* + B B* = 0 for the factor L of X = L L*, L upper
/// triangular.
///
/// Source     Hammarling, IMA J. Numer. Anal. 2, 1982 [@hammarling1982]
/// @param T upper triangular, all eigenvalues with a negative real part
[[nodiscard]] Eigen::MatrixXcd find_gramian_factor(const Eigen::MatrixXcd& T,
                                                   const Eigen::MatrixXcd& B);

/// Solves T1 X - X T2 = R; T1 and T2 upper triangular without a common
/// eigenvalue.
/// Source     back substitution [@golub1996, 7.6.3]
[[nodiscard]] Eigen::MatrixXcd solve_sylvester(const Eigen::MatrixXcd& T1,
                                               const Eigen::MatrixXcd& T2,
                                               const Eigen::MatrixXcd& R);

}  // namespace limber::dynamics
