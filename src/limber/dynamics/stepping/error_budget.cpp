// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/error_budget.hpp"

#include <algorithm>

namespace limber::dynamics {

double ErrorBudget::allowed() const {
  if (span_ == 0.0) return error_;
  const auto n = static_cast<double>(steps_);
  const double even = steps_ > 0 ? done_ / (span_ * n) : 0.0;
  return error_ * std::max(even, 0.03 / (n + 1.0));
}

void ErrorBudget::count(double h) {
  done_ += h;
  ++steps_;
}

}  // namespace limber::dynamics
