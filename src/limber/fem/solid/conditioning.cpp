// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/conditioning.hpp"

#include <fmt/format.h>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/fem/solid/stiffness_product.hpp"

namespace limber::fem {
namespace {

struct PrincipalPositions {
  Matrix3X x;      ///< relative to the mean, principal axes [m]
  Vector3 extent;  ///< largest distance along each [m]
};

PrincipalPositions find_principal(const Matrix3X& x) {
  const Matrix3X d = x.colwise() - Vector3(x.rowwise().mean());
  const auto axes = dense::find_eigenpairs(Matrix3(d * d.transpose()));
  PrincipalPositions principal{axes.vectors.transpose() * d, {}};
  principal.extent = principal.x.cwiseAbs().rowwise().maxCoeff();
  return principal;
}

std::string describe_mesh(const StiffnessSpread& spread) {
  constexpr double kFlat = 1e3;
  constexpr double kContrast = 1e6;
  std::string text;
  if (spread.flatness > kFlat)
    text += fmt::format(
        " Element {} is nearly flat or a needle (its Jacobian's condition "
        "number is "
        "{:.2g}): correct the mesh there.",
        spread.flattest, spread.flatness);
  if (spread.stiffest > kContrast * spread.softest)
    text += fmt::format(
        " Young's moduli from {:.3g} to {:.3g} Pa meet in one body: make the "
        "stiff part rigid, or a body of its own.",
        spread.softest, spread.stiffest);
  return text;
}

}  // namespace

Matrix3X scale_positions(const Matrix3X& x) {
  const PrincipalPositions principal = find_principal(x);
  return principal.extent.cwiseInverse().asDiagonal() * principal.x;
}

std::string describe_conditioning(const StructuralMatrices& matrices,
                                  const Matrix3X& x) {
  const std::string mesh =
      matrices.product ? describe_mesh(matrices.product->spread()) : "";
  const Vector3 extent = find_principal(x).extent;
  return mesh +
         fmt::format(" The body is about {:.2g} times as long as thick{}.",
                     extent.maxCoeff() / extent.minCoeff(),
                     mesh.empty()
                         ? " and its elements are sound: divide it into "
                           "several bodies, or mesh it with fewer elements "
                           "across"
                         : "");
}

}  // namespace limber::fem
