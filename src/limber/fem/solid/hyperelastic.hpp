// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "limber/fem/solid/material.hpp"

namespace limber::fem {

/// Isotropic elasticity for large rotation. Both laws reduce to Hooke's for
/// small strain.
enum class Elasticity {
  /// W = lambda tr(E)^2/2 + mu E:E, E = (F^T F - I)/2. For moderate strain: in
  /// compression it softens, and it cannot resist collapse.
  st_venant_kirchhoff,
  /// W = mu (tr(C) - 3 - 2 ln J)/2 + lambda (ln J)^2/2, C = F^T F, J = det F.
  /// Source: [@bonet2008, sec. 6.4.3]
  neo_hookean,
};

/// 3 x 3 tensor of numbers or of SIMD lanes.
template <class T>
using Tensor = std::array<std::array<T, 3>, 3>;

/// Lame's constants [Pa].
template <class T>
struct LameConstants {
  T lambda;
  T mu;
};
[[nodiscard]] LameConstants<double> find_lame_constants(
    const ElasticMaterial& material);

/// Components xx, yy, zz, xy, yz, xz of a symmetric tensor.
[[nodiscard]] Vector6 to_components(const Matrix3& tensor);

/// Second derivative of S by Green's strain at rest along the symmetric parts
/// of A and B [Pa]; zero of St. Venant-Kirchhoff's law.
///
/// Equation   -4 mu (a b + b a) - 2 lambda (a : b I + tr(a) b + tr(b) a), a =
///            sym A, b = sym B: of the neo-Hookean S = mu (I - C^-1) + lambda
///            ln J C^-1 to second order in E
[[nodiscard]] Matrix3 calc_stress_curvature(Elasticity law,
                                            const LameConstants<double>& lame,
                                            const Matrix3& A, const Matrix3& B);

/// Second Piola-Kirchhoff stress [Pa] and energy density W [J/m^3].
template <class T>
struct Stress {
  Tensor<T> S;
  T W;
};

template <class T>
[[nodiscard]] T determinant(const Tensor<T>& F) {
  return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
         F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
         F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
}

/// Green strain from the displacement gradient H = F - I, without cancellation
/// at small strain: E = (H + H^T + H^T H)/2.
template <class T>
[[nodiscard]] Tensor<T> calc_green_strain(const Tensor<T>& H) {
  Tensor<T> E;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      E[i][j] = 0.5 * (H[i][j] + H[j][i] + H[0][i] * H[0][j] +
                       H[1][i] * H[1][j] + H[2][i] * H[2][j]);
      E[j][i] = E[i][j];
    }
  }
  return E;
}

template <class T>
[[nodiscard]] Stress<T> calc_st_venant_kirchhoff(const LameConstants<T>& lame,
                                                 const Tensor<T>& H) {
  Stress<T> stress{calc_green_strain(H), T()};
  const Tensor<T>& E = stress.S;
  const T trace = E[0][0] + E[1][1] + E[2][2];
  stress.W = 0.5 * lame.lambda * trace * trace;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      stress.W += lame.mu * E[i][j] * E[i][j];
      stress.S[i][j] *= 2.0 * lame.mu;
    }
    stress.S[i][i] += lame.lambda * trace;
  }
  return stress;
}

/// Stress of 21 constants C, the upper triangle by rows. Components (xx, yy,
/// zz, xy, yz, xz), engineering shear strains.
template <class T, class Constants>
[[nodiscard]] std::array<T, 6> multiply_constants(
    const Constants& C, const std::array<T, 6>& gamma) {
  std::array<T, 6> sigma;
  sigma.fill(0.0 * gamma[0]);
  std::size_t k = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    sigma[i] += C[k++] * gamma[i];
    for (std::size_t j = i + 1; j < 6; ++j, ++k) {
      sigma[i] += C[k] * gamma[j];
      sigma[j] += C[k] * gamma[i];
    }
  }
  return sigma;
}

/// St. Venant-Kirchhoff's law with 21 constants: W = gamma . C gamma / 2.
template <class T>
[[nodiscard]] Stress<T> calc_st_venant_kirchhoff(const std::array<T, 21>& C,
                                                 const Tensor<T>& H) {
  const Tensor<T> E = calc_green_strain(H);
  const std::array<T, 6> gamma = {E[0][0],       E[1][1],       E[2][2],
                                  2.0 * E[0][1], 2.0 * E[1][2], 2.0 * E[0][2]};
  const std::array<T, 6> s = multiply_constants<T>(C, gamma);
  T W = 0.5 * s[0] * gamma[0];
  for (std::size_t i = 1; i < 6; ++i) W += 0.5 * s[i] * gamma[i];
  return {{{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}}, W};
}

/// The caller checks that det F > 0.
template <class T>
[[nodiscard]] Stress<T> calc_neo_hookean(const LameConstants<T>& lame,
                                         const Tensor<T>& H) {
  using std::log1p;
  const Tensor<T> E = calc_green_strain(H);
  const T trace = E[0][0] + E[1][1] + E[2][2];
  const T minors = E[0][0] * E[1][1] + E[1][1] * E[2][2] + E[2][2] * E[0][0] -
                   E[0][1] * E[0][1] - E[1][2] * E[1][2] - E[2][0] * E[2][0];
  // det C - 1, from E as well.
  const T growth = 2.0 * trace + 4.0 * minors + 8.0 * determinant(E);
  const T log_J = 0.5 * log1p(growth);
  Tensor<T> C;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) C[i][j] = 2.0 * E[i][j];
    C[i][i] += 1.0;
  }
  const T fraction = (lame.lambda * log_J - lame.mu) / (1.0 + growth);
  Stress<T> stress;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {  // cofactors of C
      const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
      const std::size_t m = (j + 1) % 3, n = (j + 2) % 3;
      stress.S[i][j] = fraction * (C[k][m] * C[l][n] - C[k][n] * C[l][m]);
    }
    stress.S[i][i] += lame.mu;
  }
  stress.W = lame.mu * (trace - log_J) + 0.5 * lame.lambda * log_J * log_J;
  return stress;
}

/// @param H displacement gradient du_i/dX_j, with det(I + H) > 0
template <class T>
[[nodiscard]] Stress<T> calc_stress(Elasticity law,
                                    const LameConstants<T>& lame,
                                    const Tensor<T>& H) {
  return law == Elasticity::st_venant_kirchhoff
             ? calc_st_venant_kirchhoff(lame, H)
             : calc_neo_hookean(lame, H);
}

}  // namespace limber::fem
