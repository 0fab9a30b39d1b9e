// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "limber/common/records/fields.hpp"
#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Maxwell elements, springs in series with dampers, in parallel with the
/// stiffness of each mode of a body: a material with internal damping. All
/// modes have the same elements, so that all strain energy of the body has the
/// same loss factor, whatever holds the body.
///
/// Equation   f = lambda (q + sum_j g_j d_j),  d_j' = q' - d_j / tau_j;
///            energy lambda (q^2 + sum_j g_j d_j^2) / 2,
///            dissipated power lambda sum_j g_j d_j^2 / tau_j.
///            d_j is the extension of an element's spring, q - d_j that of its
///            damper; at rest d_j = 0, so that lambda is the static stiffness:
///            `scale` times that of the given material
/// Source     Christensen, "Theory of Viscoelasticity", 1982, section 1.6
///            [@christensen1982]
struct MaxwellElements {
  VectorX strengths;   ///< J, g_j >= 0 [-]
  VectorX times;       ///< J, tau_j > 0 [s]
  double scale = 1.0;  ///< static stiffness / that of the material [-]

  [[nodiscard]] Eigen::Index size() const { return times.size(); }
};

/// A range of angular frequencies [rad/s].
struct FrequencyBand {
  double low = 0.0;   ///< > 0
  double high = 0.0;  ///< > low
};

/// Dynamic stiffness at exp(s t) relative to the static one [-].
/// Equation   1 + sum_j g_j s tau_j / (1 + s tau_j)
/// @param s [1/s]
[[nodiscard]] std::complex<double> find_dynamic_stiffness(
    const MaxwellElements& elements, std::complex<double> s);

/// As few elements as keep the loss factor, Im / Re of the dynamic stiffness,
/// within 3 % over the band, with `scale` such that its real part at band.low
/// is that of the material. At the other frequencies it is larger, by about
/// 2/pi loss_factor ln(omega / band.low): no passive material has a constant
/// loss factor and a constant stiffness (Kramers and Kronig).
///
/// Equation   sum_j g_j (x / (1 + x^2) - eta x^2 / (1 + x^2)) = eta,
///            x = omega tau_j, by non-negative least squares; 1 / tau_j spaced
///            logarithmically, from band.low / 1.5 to 1.5 band.high
/// @param loss_factor > 0 [-]
/// @throws InputError for a loss factor or a band without such elements, or
/// out of range.
[[nodiscard]] MaxwellElements find_maxwell_elements(double loss_factor,
                                                    const FrequencyBand& band);

/// Extensions of the elements at the end of a step of h, in which q is linear
/// (or over which the rate of each damper is that of the middle).
///
/// Equation   d_1 = keep_j d_0 + gain_j (q_1 - q_0)
struct MaxwellStep {
  explicit MaxwellStep(Eigen::Index size = 0)
      : keep(VectorX::Zero(size)), gain(VectorX::Zero(size)) {}

  VectorX keep;            ///< J [-]
  VectorX gain;            ///< J [-]
  double stiffness = 0.0;  ///< change of sum_j g_j d_j by q_1 [-]
};

/// Equation   keep = exp(-h / tau), gain = (1 - keep) tau / h
void set_linear_step(const MaxwellElements& elements, double h,
                     MaxwellStep& step);

/// With mean forces that balance energies exactly.
/// Equation   k = h / (2 tau): keep = (1 - k) / (1 + k), gain = 1 / (1 + k)
void set_middle_step(const MaxwellElements& elements, double h,
                     MaxwellStep& step);

constexpr auto fields_of(const MaxwellElements*) {
  return list_fields("Maxwell elements", "strengths", "times [s]", "scale");
}

}  // namespace limber::flexbody
