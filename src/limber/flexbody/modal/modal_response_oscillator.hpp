// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

namespace limber::flexbody {

/// Response of one mode at t >= 0 [s] to unit initial values and a unit load at
/// time 0.
///
/// Equation   eta(t)    = stay eta0 + impulse etadot0 + step f
///            etadot(t) = -lambda impulse eta0 + keep etadot0 + impulse f
struct FreeResponse {
  double t = 0.0;        ///< time since the start [s]
  double stay = 1.0;     ///< eta after a unit initial eta [-]
  double keep = 1.0;     ///< etadot after a unit initial etadot [-]
  double impulse = 0.0;  ///< eta after a unit initial etadot [s]
  double step = 0.0;     ///< eta under a unit constant load [s^2]
};

/// Response from rest to the load e^(i omega t): the real parts to cos(omega
/// t), the imaginary parts to sin(omega t).
struct HarmonicResponse {
  std::complex<double> eta;     ///< per unit load [s^2]
  std::complex<double> etadot;  ///< per unit load [s]
};

/// Closed-form solution of one mode.
///
/// Equation   eta'' + damping eta' + lambda eta = f(t); with s1, s2 the roots
///            of s^2 + damping s + lambda, and exp[...] a divided difference,
///            impulse = exp[s1, s2], step = exp[0, s1, s2],
///            HarmonicResponse::eta = exp[i omega, s1, s2], all of t.
/// Source     elementary; docs/theory/modal_response.md explains how each stays
///            accurate where roots or frequencies nearly coincide
/// Limits     errors are round-off times 1 + sqrt(lambda) t (+ omega t)
class ModalOscillator {
 public:
  /// @param lambda >= 0 [rad^2/s^2]; @param damping >= 0 [1/s]
  /// @throws ContractError if one is negative or not finite.
  ModalOscillator(double lambda, double damping);

  [[nodiscard]] double lambda() const { return lambda_; }
  [[nodiscard]] double damping() const { return damping_; }

  /// @param t >= 0 [s]
  [[nodiscard]] FreeResponse find_free_response(double t) const;

  /// @param omega >= 0 [rad/s]; @param phasor e^(i omega t)
  /// @param free find_free_response(t), shared by several frequencies
  [[nodiscard]] HarmonicResponse find_harmonic_response(
      double omega, std::complex<double> phasor,
      const FreeResponse& free) const;

 private:
  using Complex = std::complex<double>;
  struct Roots {  // [1/s]
    Complex s1, s2;
    Complex close, far;  // s1 - i omega, s2 - i omega
  };

  [[nodiscard]] FreeResponse find_early_response(double t) const;
  [[nodiscard]] FreeResponse find_oscillating_response(double t) const;
  [[nodiscard]] FreeResponse find_creeping_response(double t) const;
  [[nodiscard]] HarmonicResponse find_early_harmonic(
      double omega, const FreeResponse& free) const;
  [[nodiscard]] static HarmonicResponse find_close_harmonic(const Roots& roots,
                                                            Complex phasor,
                                                            double t);

  double lambda_;
  double damping_;
  bool oscillates_;  // s1, s2 = -damping/2 +- i rate, else -slow, -fast
  double rate_;      // half the distance of the roots [1/s]
  double slow_ = 0.0;
  double fast_ = 0.0;
};

}  // namespace limber::flexbody
