// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/factor_plan.hpp"

#include <algorithm>
#include <limits>

namespace limber::dynamics {
namespace {

// Contraction up to which factors of an earlier step are kept [-].
constexpr double kGoodContraction = 0.01;
// If factors fail within this number of steps, the following steps factor
// again, and more of them each time.
constexpr int kYoung = 2;
constexpr int kFewestFreshSteps = 8;
constexpr int kMostFreshSteps = 512;
// Largest number of successive steps without a measurement for which factors
// are kept.
constexpr int kMostUnmeasured = 32;
// Measurements are valid for this number of steps, with this margin, and for
// corrections that are longer by at most this factor.
constexpr int kTrustedSteps = 8;
constexpr double kMargin = 20.0;
constexpr double kMostGrowth = 4.0;

}  // namespace

FactorPlan::Rest FactorPlan::expect_rest(
    std::size_t i, std::size_t group, const CorrectionSize& correction) const {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const Rest unknown{kUnknown, kUnknown};
  if (trusted_steps_ == 0 || i + 1 >= measured_.count) return unknown;
  const double ratio = correction.value / measured_.corrections[i][group].value;
  if (!(ratio <= kMostGrowth)) return unknown;
  const CorrectionSize& next = measured_.corrections[i + 1][group];
  return {kMargin * ratio * next.rigid, kMargin * ratio * next.modal};
}

void FactorPlan::finish_step(bool kept, const Course& course) {
  if (!kept) {
    fresh_steps_ = std::max(0, fresh_steps_ - 1);
    age_ = unmeasured_ = trusted_steps_ = 0;
    return;
  }
  ++age_;
  unmeasured_ = course.is_measured ? 0 : unmeasured_ + 1;
  trusted_steps_ = std::max(0, trusted_steps_ - 1);
  if (unmeasured_ > kMostUnmeasured) {
    fresh_steps_ = 1;
  } else if (course.slowest > kGoodContraction) {
    const int more =
        std::clamp(2 * next_fresh_steps_, kFewestFreshSteps, kMostFreshSteps);
    next_fresh_steps_ = age_ <= kYoung ? more : 0;
    fresh_steps_ = std::max(next_fresh_steps_, 1);
    trusted_steps_ = 0;
  } else if (course.is_measured) {
    measured_ = course;
    trusted_steps_ = kTrustedSteps;
    if (age_ > kYoung) next_fresh_steps_ = 0;
  }
}

void FactorPlan::refresh() { age_ = unmeasured_ = trusted_steps_ = 0; }

void FactorPlan::exchange_memory(Archive& archive) {
  archive(fresh_steps_, next_fresh_steps_);
}

}  // namespace limber::dynamics
