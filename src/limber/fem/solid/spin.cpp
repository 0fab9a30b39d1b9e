// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/spin.hpp"

#include <Spectra/SymGEigsSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "limber/common/errors.hpp"

namespace limber::fem {
namespace {

/// P^T M E with Spectra's interface, scaled: its tolerance has an absolute
/// part.
class CentrifugalProduct {
 public:
  using Scalar = double;

  CentrifugalProduct(const ElasticInverse& inverse, const Vector3& axis)
      : inverse_(inverse), axis_(axis) {}
  [[nodiscard]] Eigen::Index rows() const {
    return inverse_.matrices().dof_count();
  }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  [[nodiscard]] VectorX multiply(const VectorX& x) const {
    return inverse_.project_load(
        multiply_mass(inverse_.matrices().M_s, project_normal(axis_, x)));
  }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<VectorX>(out, rows()) =
        scale_ * multiply(Eigen::Map<const VectorX>(in, rows()));
  }
  void scale_by(double scale) { scale_ = scale; }

 private:
  const ElasticInverse& inverse_;
  Vector3 axis_;
  double scale_ = 1.0;
};

/// K and K^+ with Spectra's interface.
class EnergyProduct {
 public:
  using Scalar = double;

  explicit EnergyProduct(const ElasticInverse& inverse) : inverse_(inverse) {}
  [[nodiscard]] Eigen::Index rows() const {
    return inverse_.matrices().dof_count();
  }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  void perform_op(const double* in, double* out) const {
    const MatrixX x = Eigen::Map<const VectorX>(in, rows());
    Eigen::Map<VectorX>(out, rows()) =
        multiply_stiffness(inverse_.matrices(), x);
  }
  void solve(const double* in, double* out) const {
    const MatrixX f = Eigen::Map<const VectorX>(in, rows());
    Eigen::Map<VectorX>(out, rows()) = inverse_.solve(f);
  }

 private:
  const ElasticInverse& inverse_;
};

VectorX make_random(Eigen::Index size) {
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
  VectorX x(size);
  for (double& value : x) value = normal(random);
  return x;
}

/// Omega^2 of one deformation: x^T K x / x^T M E x [rad^2/s^2].
double calc_quotient(const ElasticInverse& inverse,
                     const CentrifugalProduct& product, const VectorX& x) {
  return x.dot(multiply_stiffness(inverse.matrices(), x).col(0)) /
         x.dot(product.multiply(x));
}

/// Solves P^T (K - Omega^2 M E) x = F for loads without a rigid part.
class SpunSolver {
 public:
  SpunSolver(const ElasticInverse& inverse, const Vector3& axis, double speed)
      : inverse_(inverse), product_(inverse, axis), square_(speed * speed) {}

  [[nodiscard]] VectorX multiply(const VectorX& x) const {
    const VectorX Kx = multiply_stiffness(inverse_.matrices(), x);
    return inverse_.project_load(Kx) - square_ * product_.multiply(x);
  }

  /// Conjugate gradients, to a tolerance that refinement completes.
  [[nodiscard]] VectorX iterate(VectorX residual) const {
    constexpr double kTolerance = 1e-8;
    constexpr int kMaxSteps = 500;
    VectorX x = VectorX::Zero(residual.size());
    VectorX z = inverse_.solve_shifted(residual);
    VectorX direction = z;
    double energy = residual.dot(z);
    const double enough = kTolerance * kTolerance * energy;
    for (int step = 0; step < kMaxSteps && energy > enough; ++step) {
      const VectorX image = multiply(direction);
      const double curvature = direction.dot(image);
      if (!(curvature > 0.0))
        throw NumericalError(fmt::format(
            "at {:.6g} rad/s the stiffness less the centrifugal softening is "
            "not positive definite: the speed is critical or above.",
            std::sqrt(square_)));
      const double length = energy / curvature;
      x += length * direction;
      residual -= length * image;
      z = inverse_.solve_shifted(residual);
      const double next = residual.dot(z);
      direction = z + (next / energy) * direction;
      energy = next;
    }
    return x;
  }

  [[nodiscard]] VectorX solve(const VectorX& F) const {
    constexpr int kMaxSteps = 30;
    constexpr double kTolerance = 1e-13;  // correction, relative
    constexpr double kStalled = 1e-9;     // roundoff allowed for a hard matrix
    const VectorX load = inverse_.project_load(F);
    VectorX x = VectorX::Zero(load.size());
    double previous = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMaxSteps; ++step) {
      const VectorX correction = iterate(load - multiply(x));
      x += correction;
      const double change =
          correction.norm() /
          std::max(x.norm(), std::numeric_limits<double>::min());
      if (change <= kTolerance) return x;
      if (change > 0.5 * previous && change <= kStalled) return x;
      previous = change;
    }
    throw NumericalError(fmt::format(
        "deformation at {:.6g} rad/s: after {} refinements the correction is "
        "{:.3g} of the answer (tolerance {:.0g}).",
        std::sqrt(square_), kMaxSteps, previous, kStalled));
  }

 private:
  const ElasticInverse& inverse_;
  CentrifugalProduct product_;
  double square_;
};

}  // namespace

MatrixX project_normal(const Vector3& axis, const MatrixX& X) {
  LIMBER_EXPECT(X.rows() % 3 == 0);
  MatrixX normal = X;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    Eigen::Map<Matrix3X> nodal(normal.col(k).data(), 3, X.rows() / 3);
    nodal -= axis * (axis.transpose() * nodal).eval();
  }
  return normal;
}

double find_critical_speed(const ElasticInverse& inverse, const Vector3& axis) {
  constexpr double kTolerance = 1e-12;
  constexpr Eigen::Index kWidth = 20;
  constexpr Eigen::Index kRestarts = 200;
  CentrifugalProduct product(inverse, axis);
  EnergyProduct stiffness(inverse);
  const VectorX start =
      inverse.solve(product.multiply(make_random(product.rows())));
  product.scale_by(calc_quotient(inverse, product, start));
  const Eigen::Index room = product.rows() - inverse.rigid_count();
  Spectra::SymGEigsSolver<CentrifugalProduct, EnergyProduct,
                          Spectra::GEigsMode::RegularInverse>
      solver(product, stiffness, 1,
             std::clamp(room / 2, Eigen::Index{2}, kWidth));
  solver.init(start.data());
  if (solver.compute(Spectra::SortRule::LargestAlge, kRestarts, kTolerance) < 1)
    throw NumericalError(fmt::format(
        "critical speed: Lanczos does not converge in {} restarts.{}",
        kRestarts, inverse.conditioning()));
  return std::sqrt(
      calc_quotient(inverse, product, solver.eigenvectors().col(0)));
}

VectorX solve_spun(const ElasticInverse& inverse, const Vector3& axis,
                   double speed, const VectorX& F) {
  LIMBER_EXPECT(F.size() == inverse.matrices().dof_count());
  return SpunSolver(inverse, axis, speed).solve(F);
}

}  // namespace limber::fem
