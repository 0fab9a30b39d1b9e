// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/maxwell_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

constexpr Eigen::Index kMostElements = 12;
constexpr double kLossError = 0.03;  // relative
// The ends of the band are fitted as well as its middle if the elements reach
// beyond them by this factor [-].
constexpr double kBeyond = 1.5;

VectorX space_logarithmically(const FrequencyBand& band, Eigen::Index n) {
  return VectorX::LinSpaced(n, std::log(band.low), std::log(band.high))
      .array()
      .exp();
}

// min |A x - b|, x >= 0, by coordinate descent: a convex problem of a few
// unknowns.
VectorX solve_non_negative(const MatrixX& A, const VectorX& b) {
  constexpr int kMostSweeps = 20000;
  constexpr double kSettled = 1e-12;
  const MatrixX H = A.transpose() * A;
  const VectorX c = A.transpose() * b;
  VectorX x = VectorX::Zero(A.cols());
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double change = 0.0;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double next =
          std::max(0.0, x[k] - (H.row(k).dot(x) - c[k]) / H(k, k));
      change = std::max(change, std::abs(next - x[k]));
      x[k] = next;
    }
    if (change <= kSettled * x.maxCoeff()) break;
  }
  return x;
}

MaxwellElements fit_elements(double eta, const FrequencyBand& band,
                             const VectorX& omega, Eigen::Index n) {
  MaxwellElements elements;
  elements.times =
      space_logarithmically({band.low / kBeyond, band.high * kBeyond}, n)
          .cwiseInverse();
  MatrixX A(omega.size(), n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::ArrayXd x = omega.array() * elements.times[j];
    A.col(j) = (x - eta * x.square()) / (1.0 + x.square());
  }
  elements.strengths =
      solve_non_negative(A, VectorX::Constant(omega.size(), eta));
  return elements;
}

// Largest relative error of the loss factor [-].
double measure_error(const MaxwellElements& elements, double eta,
                     const VectorX& omega) {
  double most = 0.0;
  for (const double w : omega) {
    const auto G = find_dynamic_stiffness(elements, {0.0, w});
    most = std::max(most, std::abs(G.imag() / G.real() / eta - 1.0));
  }
  return most;
}

}  // namespace

std::complex<double> find_dynamic_stiffness(const MaxwellElements& elements,
                                            std::complex<double> s) {
  std::complex<double> G = 1.0;
  for (Eigen::Index j = 0; j < elements.size(); ++j) {
    const std::complex<double> x = s * elements.times[j];
    G += elements.strengths[j] * x / (1.0 + x);
  }
  return G;
}

MaxwellElements find_maxwell_elements(double loss_factor,
                                      const FrequencyBand& band) {
  constexpr Eigen::Index kSamples = 200;
  if (!(loss_factor > 0.0) || !std::isfinite(loss_factor)) {
    throw InputError(
        fmt::format("a loss factor of {:g}; expected > 0", loss_factor));
  }
  if (!(band.low > 0.0) || !(band.high > band.low) ||
      !std::isfinite(band.high)) {
    throw InputError(fmt::format(
        "a band of {:g} to {:g} rad/s; expected finite frequencies > 0 that "
        "increase",
        band.low, band.high));
  }
  const VectorX omega = space_logarithmically(band, kSamples);
  double error = 0.0;
  for (Eigen::Index n = 2; n <= kMostElements; ++n) {
    MaxwellElements elements = fit_elements(loss_factor, band, omega, n);
    error = measure_error(elements, loss_factor, omega);
    if (!(error <= kLossError)) continue;
    elements.scale =
        1.0 / find_dynamic_stiffness(elements, {0.0, band.low}).real();
    return elements;
  }
  throw InputError(fmt::format(
      "a loss factor of {:g} from {:.4g} to {:.4g} rad/s: {} Maxwell elements "
      "are off by {:.2g} %, expected at most {:g} %; a smaller loss factor "
      "can be met",
      loss_factor, band.low, band.high, kMostElements, 100.0 * error,
      100.0 * kLossError));
}

void set_linear_step(const MaxwellElements& elements, double h,
                     MaxwellStep& step) {
  step.stiffness = 0.0;
  for (Eigen::Index j = 0; j < elements.size(); ++j) {
    const double x = h / elements.times[j];
    step.keep[j] = std::exp(-x);
    step.gain[j] = x > 0.0 ? -std::expm1(-x) / x : 1.0;
    step.stiffness += elements.strengths[j] * step.gain[j];
  }
}

void set_middle_step(const MaxwellElements& elements, double h,
                     MaxwellStep& step) {
  step.stiffness = 0.0;
  for (Eigen::Index j = 0; j < elements.size(); ++j) {
    const double k = 0.5 * h / elements.times[j];
    step.keep[j] = (1.0 - k) / (1.0 + k);
    step.gain[j] = 1.0 / (1.0 + k);
    step.stiffness += elements.strengths[j] * step.gain[j];
  }
}

}  // namespace limber::flexbody
