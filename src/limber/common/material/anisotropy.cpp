// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/anisotropy.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber {
namespace {

// Components of a symmetric tensor.
constexpr std::array<std::pair<int, int>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

// A condition on each of three values.
void require_positive(const Vector3& values, const char* letter,
                      const std::array<const char*, 3>& names,
                      std::vector<std::string>& problems) {
  for (int i = 0; i < 3; ++i) {
    if (values[i] > 0.0 && std::isfinite(values[i])) continue;
    problems.push_back(fmt::format("{}{} is {:g} Pa; expected > 0", letter,
                                   names[static_cast<std::size_t>(i)],
                                   values[i]));
  }
}

void require_ratio(double nu, double E_i, double E_j, const char* names,
                   std::vector<std::string>& problems) {
  const double limit = std::sqrt(E_i / E_j);
  if (std::abs(nu) < limit) return;
  problems.push_back(fmt::format(
      "nu{0} is {1:g}; a positive strain energy needs |nu{0}| < sqrt(E{2} / "
      "E{3}) = {4:.6g}",
      names, nu, names[0], names[1], limit));
}

}  // namespace

Matrix6 make_orthotropic(const EngineeringConstants& constants) {
  const auto& [E, nu, G] = constants;
  std::vector<std::string> problems;
  require_positive(E, "E", {"1", "2", "3"}, problems);
  require_positive(G, "G", {"12", "13", "23"}, problems);
  if (!problems.empty()) throw InputError(problems);
  require_ratio(nu[0], E[0], E[1], "12", problems);
  require_ratio(nu[1], E[0], E[2], "13", problems);
  require_ratio(nu[2], E[1], E[2], "23", problems);
  const double nu21 = nu[0] * E[1] / E[0];
  const double nu31 = nu[1] * E[2] / E[0];
  const double nu32 = nu[2] * E[2] / E[1];
  const double rest = 1.0 - nu[0] * nu21 - nu[2] * nu32 - nu[1] * nu31 -
                      2.0 * nu21 * nu32 * nu[1];
  if (problems.empty() && !(rest > 0.0)) {
    problems.push_back(fmt::format(
        "1 - nu12 nu21 - nu23 nu32 - nu13 nu31 - 2 nu21 nu32 nu13 is {:.6g}; a "
        "positive strain energy needs > 0",
        rest));
  }
  if (!problems.empty()) throw InputError(problems);
  Matrix3 compliance;
  compliance << 1.0 / E[0], -nu[0] / E[0], -nu[1] / E[0],  //
      -nu[0] / E[0], 1.0 / E[1], -nu[2] / E[1],            //
      -nu[1] / E[0], -nu[2] / E[1], 1.0 / E[2];
  const Matrix3 stiffness = compliance.inverse();
  Matrix6 C = Matrix6::Zero();
  C.topLeftCorner<3, 3>() = 0.5 * (stiffness + stiffness.transpose());
  C(3, 3) = G[0];
  C(4, 4) = G[2];
  C(5, 5) = G[1];
  return C;
}

Matrix6 make_anisotropic(const Constants21& upper) {
  Matrix6 C;
  std::size_t k = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) C(i, j) = C(j, i) = upper[k++];
  }
  if (const auto problems = find_inadmissible(C); !problems.empty())
    throw InputError(problems);
  return C;
}

std::vector<std::string> find_inadmissible(const Matrix6& C) {
  if (!C.allFinite()) return {"the stiffness contains values not finite"};
  for (int i = 0; i < 6; ++i) {
    if (!(C(i, i) > 0.0))
      return {fmt::format("C{0}{0} is {1:g} Pa; expected > 0", i + 1, C(i, i))};
  }
  // Pivots of Cholesky's factors, of the matrix with ones on its diagonal.
  constexpr double kSingular = 1e-12;
  const Vector6 scale = C.diagonal().cwiseSqrt().cwiseInverse();
  Matrix6 rest = scale.asDiagonal() * C * scale.asDiagonal();
  for (int k = 0; k < 6; ++k) {
    const double pivot = rest(k, k);
    if (!(pivot > kSingular)) {
      return {fmt::format(
          "the stiffness is not positive definite: the determinant of its "
          "first {} rows and columns is not positive (pivot {:.3g})",
          k + 1, pivot)};
    }
    const Vector6 column = rest.col(k);
    rest -= column * column.transpose() / pivot;
  }
  return {};
}

Constants21 list_constants(const Matrix6& C) {
  Constants21 upper{};
  std::size_t k = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) upper[k++] = C(i, j);
  }
  return upper;
}

Matrix6 turn_stiffness(const Matrix6& C, const Matrix3& directions) {
  const Matrix3& Q = directions;
  Matrix6 T;
  for (int row = 0; row < 6; ++row) {
    const auto [i, j] = kPairs[static_cast<std::size_t>(row)];
    for (int column = 0; column < 6; ++column) {
      const auto [k, l] = kPairs[static_cast<std::size_t>(column)];
      T(row, column) =
          k == l ? Q(i, k) * Q(j, l) : Q(i, k) * Q(j, l) + Q(i, l) * Q(j, k);
    }
  }
  const Matrix6 turned = T * C * T.transpose();
  return 0.5 * (turned + turned.transpose());
}

Matrix6 make_isotropic(double youngs_modulus, double poisson_ratio) {
  const double mu = youngs_modulus / (2.0 * (1.0 + poisson_ratio));
  const double lambda = 2.0 * mu * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
  Matrix6 C = Matrix6::Zero();
  C.topLeftCorner<3, 3>().setConstant(lambda);
  for (int i = 0; i < 3; ++i) {
    C(i, i) += 2.0 * mu;
    C(i + 3, i + 3) = mu;
  }
  return C;
}

SolidMaterial make_material(const Matrix6& C, const MaterialAxes& axes,
                            double density) {
  const double same = C.diagonal().head<3>().sum();
  const double other = C(0, 1) + C(1, 2) + C(0, 2);
  const double shear = C.diagonal().tail<3>().sum();
  const double bulk = (same + 2.0 * other) / 9.0;
  const double mu = (same - other + 3.0 * shear) / 15.0;
  SolidMaterial material;
  material.youngs_modulus = 9.0 * bulk * mu / (3.0 * bulk + mu);
  material.poisson_ratio = (3.0 * bulk - 2.0 * mu) / (2.0 * (3.0 * bulk + mu));
  material.density = density;
  material.anisotropy = Anisotropy{C, axes};
  return material;
}

Matrix6 find_stiffness(const SolidMaterial& material, const Vector3& x) {
  if (!material.anisotropy)
    return make_isotropic(material.youngs_modulus, material.poisson_ratio);
  return turn_stiffness(material.anisotropy->C,
                        material.anisotropy->axes.at(x));
}

Matrix3 find_axes(const SolidMaterial& material, const Vector3& x) {
  if (!material.anisotropy) return Matrix3::Identity();
  return material.anisotropy->axes.at(x);
}

}  // namespace limber
