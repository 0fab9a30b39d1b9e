// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/steady_report.hpp"

#include <fmt/format.h>

namespace limber::app {

std::string describe_imbalance(const dynamics::Imbalance& imbalance,
                               bool is_moving, const LinearisedAt& at) {
  std::string text =
      fmt::format("{} is {}: ", at.where,
                  is_moving ? "no steady motion" : "not an equilibrium");
  if (imbalance.force > 0.0) {
    text += fmt::format("{:.4g} N are left on body '{}', ", imbalance.force,
                        imbalance.force_body);
  }
  if (imbalance.moment > 0.0) {
    text += fmt::format("{:.4g} N m on body '{}', ", imbalance.moment,
                        imbalance.moment_body);
  }
  text += fmt::format(
      "where {:.4g} N act in all; {} of the forces as they are "
      "there",
      imbalance.acting, at.result);
  if (!is_moving) {
    text += "; [initial] equilibrium = true starts from the equilibrium";
  }
  return text;
}

std::string describe_change(double change, const LinearisedAt& at) {
  return fmt::format(
      "the linearised system changes by a fraction of {:.2g} while it "
      "rotates by 1 rad, in fixed and in rotating axes: {} instantaneous, and "
      "exact only for an axisymmetric rotor, or for any rotor in isotropic "
      "bearings",
      change, at.result);
}

}  // namespace limber::app
