// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/analyses/linearised_at.hpp"

#include <fmt/format.h>

namespace limber::runs {

std::string describe_imbalance(const dynamics::Imbalance& imbalance,
                               bool is_moving, const LinearisedAt& at) {
  std::string text =
      fmt::format("{} is {}: ", at.where,
                  is_moving ? "not a steady motion" : "not an equilibrium");
  // Of modes a weighted acceleration, and no force of the scene.
  if (imbalance.force > 0.0) {
    text += fmt::format(
        "forces accelerate body '{}' (mass times root mean square "
        "acceleration: {:.4g} N), ",
        imbalance.force_body, imbalance.force);
  }
  if (imbalance.moment > 0.0) {
    text += fmt::format("a moment of {:.4g} N m on body '{}' is unbalanced, ",
                        imbalance.moment, imbalance.moment_body);
  }
  text +=
      fmt::format("and {} only valid for the forces at that state", at.result);
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

}  // namespace limber::runs
