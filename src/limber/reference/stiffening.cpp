// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/stiffening.hpp"

#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::reference {
namespace {

/// Scales the damping of directions with stiffness; that of free directions is
/// unchanged.
Matrix3 stiffen_damping(const Matrix3& stiffness, const Matrix3& damping,
                        double factor) {
  const double largest = dense::find_eigenvalues(stiffness).maxCoeff();
  if (!(largest > 0.0)) return damping;
  const Matrix3 held = stiffness / largest;
  return damping + (std::sqrt(factor) - 1.0) * held * damping * held;
}

joints::Bushing stiffen(const joints::Bushing& bushing, double factor) {
  joints::Bushing::Parameters p = bushing.parameters();
  p.translational_damping = stiffen_damping(p.translational_stiffness,
                                            p.translational_damping, factor);
  p.rotational_damping =
      stiffen_damping(p.rotational_stiffness, p.rotational_damping, factor);
  p.translational_stiffness *= factor;
  p.rotational_stiffness *= factor;
  return joints::Bushing(p);
}

joints::UniversalConstraint stiffen(
    const joints::UniversalConstraint& constraint, double factor) {
  joints::UniversalConstraint::Parameters p = constraint.parameters();
  p.translational_stiffness *= factor;
  p.rotational_stiffness *= factor;
  p.translational_damping *= std::sqrt(factor);
  p.rotational_damping *= std::sqrt(factor);
  return joints::UniversalConstraint(p);
}

}  // namespace

dynamics::SystemModel stiffen_joints(dynamics::SystemModel model,
                                     double factor) {
  LIMBER_EXPECT(factor > 0.0 && std::isfinite(factor));
  for (dynamics::Coupler& coupler : model.couplers) {
    const auto* joint = std::get_if<joints::Joint>(&coupler.law);
    if (joint == nullptr) continue;
    coupler.law = std::visit(
        [&](const auto& constraint) {
          return joints::Joint(stiffen(constraint, factor),
                               joint->coordinates(), joint->elements());
        },
        joint->constraint());
  }
  return model;
}

StiffnessTrend find_trend(const std::vector<double>& factors,
                          const std::vector<double>& differences) {
  LIMBER_EXPECT(factors.size() == differences.size());
  StiffnessTrend trend;
  std::size_t first = 0;  // of the run that the order belongs to
  for (std::size_t i = 1; i < factors.size(); ++i) {
    const double order = std::log(differences[i - 1] / differences[i]) /
                         std::log(factors[i] / factors[i - 1]);
    trend.orders.push_back(order);
    if (!(std::abs(order - 1.0) <= kOrderBand)) {
      first = i;
      continue;
    }
    const auto& row = trend.first_order;
    if (!row || i - first > row->last - row->first) {
      trend.first_order = {first, i};
    }
  }
  for (std::size_t i = trend.first_order ? trend.first_order->last : 0;
       i < trend.orders.size(); ++i) {
    if (trend.orders[i] >= 0.5) continue;
    trend.floor = i;
    break;
  }
  return trend;
}

}  // namespace limber::reference
