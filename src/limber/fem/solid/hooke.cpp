// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/hooke.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"

namespace limber::fem {
namespace {

Tensor<double> to_tensor(const Matrix3& matrix) {
  Tensor<double> tensor;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      tensor[i][j] =
          matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  return tensor;
}

Matrix3 to_matrix(const Tensor<double>& tensor) {
  Matrix3 matrix;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          tensor[i][j];
    }
  }
  return matrix;
}

}  // namespace

Hooke::Hooke(const ElasticMaterial& material, const Vector3& x)
    : lame(find_lame_constants(material)) {
  if (material.anisotropy) C = find_stiffness(material, x);
}

Matrix3 Hooke::calc_stress(const Matrix3& strain) const {
  if (!C) {
    return lame.lambda * strain.trace() * Matrix3::Identity() +
           2.0 * lame.mu * strain;
  }
  Vector6 gamma = to_components(strain);
  gamma.tail<3>() *= 2.0;
  const Vector6 s = *C * gamma;
  Matrix3 stress;
  stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return stress;
}

Matrix3 Hooke::calc_stress(Elasticity law, const Matrix3& H) const {
  const Tensor<double> gradient = to_tensor(H);
  if (C) return calc_stress(to_matrix(calc_green_strain(gradient)));
  return to_matrix(fem::calc_stress(law, lame, gradient).S);
}

std::vector<Hooke> list_laws(const ElasticMaterial& material,
                             const Matrix3X& x) {
  const auto count = static_cast<std::size_t>(x.cols());
  if (!material.anisotropy || !material.anisotropy->axes.is_cylindrical)
    return std::vector<Hooke>(count, Hooke(material, Vector3::Zero()));
  std::vector<Hooke> laws;
  laws.reserve(count);
  for (Eigen::Index q = 0; q < x.cols(); ++q)
    laws.emplace_back(material, Vector3(x.col(q)));
  return laws;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> make_strain_rows(const Matrix3& F,
                                                          const Matrix3X& g) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> rows(6, 3 * g.cols());
  for (Eigen::Index a = 0; a < g.cols(); ++a) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index column = 3 * a + k;
      for (Eigen::Index i = 0; i < 3; ++i) rows(i, column) = F(k, i) * g(i, a);
      rows(3, column) = F(k, 0) * g(1, a) + F(k, 1) * g(0, a);
      rows(4, column) = F(k, 1) * g(2, a) + F(k, 2) * g(1, a);
      rows(5, column) = F(k, 0) * g(2, a) + F(k, 2) * g(0, a);
    }
  }
  return rows;
}

bool has_anisotropy(const std::vector<ElasticMaterial>& materials) {
  return std::any_of(
      materials.begin(), materials.end(),
      [](const ElasticMaterial& m) { return m.anisotropy.has_value(); });
}

void require_law(const Mesh& mesh,
                 const std::vector<ElasticMaterial>& materials,
                 Elasticity law) {
  if (law == Elasticity::st_venant_kirchhoff || !has_anisotropy(materials))
    return;
  throw InputError(fmt::format(
      "{}: the neo-Hookean law is isotropic, and a material is anisotropic. "
      "Use St. Venant-Kirchhoff's law",
      mesh.source));
}

}  // namespace limber::fem
