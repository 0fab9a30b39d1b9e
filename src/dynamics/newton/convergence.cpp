// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/convergence.hpp"

#include <algorithm>

namespace limber::dynamics {
namespace {

constexpr double kErrorShare = 0.01;
constexpr double kMostShare = 1e-9;  // of the step's motion [-]
// Contraction above which the remaining error is not estimated [-].
constexpr double kPromising = 0.5;
// Relative difference of a correction from the reversed previous one [-].
constexpr double kReversed = 0.1;
// Largest correction between two faces, of the step's motion [-].
constexpr double kBetweenFaces = 1e-3;

double find_rest(double size, double before) {
  const double c = before > 0.0 ? size / before : 1.0;
  return c < kPromising ? size * c / (1.0 - c) : size;
}

}  // namespace

CorrectionSize find_limit(const CorrectionSize& predictor_errors, double gamma,
                          double motion) {
  const auto choose = [&](double predictor_error) {
    return std::clamp(kErrorShare * predictor_error / (12.0 * gamma),
                      kLeastShare * motion, kMostShare * motion);
  };
  CorrectionSize limit;
  limit.value = choose(predictor_errors.value);
  limit.rigid = choose(predictor_errors.rigid);
  limit.modal = choose(predictor_errors.modal);
  return limit;
}

bool has_converged(const CorrectionSize& correction,
                   const CorrectionSize& before, const CorrectionSize& limit,
                   const Roundoff& roundoff) {
  const auto is_done = [](double size, double last, double most, double noise) {
    return find_rest(size, last) <= most || size <= noise;
  };
  return is_done(correction.rigid, before.rigid, limit.rigid, roundoff.rigid) &&
         is_done(correction.modal, before.modal, limit.modal, roundoff.modal);
}

FaceCycle::FaceCycle(Eigen::Index corrections)
    : last_(VectorX::Zero(corrections)) {}

void FaceCycle::include(const VectorX& correction, bool is_first,
                        bool touches) {
  goes_back_ = touches && touched_ && !is_first &&
               (correction + last_).squaredNorm() <=
                   kReversed * kReversed * correction.squaredNorm();
  touched_ = touches;
  if (touches) last_ = correction;
}

bool FaceCycle::ends(double size, double motion) const {
  return goes_back_ && size <= kBetweenFaces * motion;
}

}  // namespace limber::dynamics
