// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/modal_response_oscillator.hpp"

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

using Complex = std::complex<double>;

// Up to here power series in t converge in some 25 terms without cancellation;
// beyond, the closed forms have none.
constexpr double kEarly = 2.0;
constexpr int kMostTerms = 60;

bool is_early(double lambda, double damping, double t) {
  return damping * t <= kEarly && lambda * t * t <= kEarly;
}

// (1 - e^-x) / x
double find_mean_decay(double x) { return x > 0.0 ? -std::expm1(-x) / x : 1.0; }

double find_sinc(double x) { return x > 0.0 ? std::sin(x) / x : 1.0; }

// (e^w - 1) / w for Re w <= 0
Complex find_mean_growth(Complex w) {
  if (w == 0.0) return 1.0;
  const double half = std::sin(0.5 * w.imag());
  const Complex growth(
      std::expm1(w.real()) * std::cos(w.imag()) - 2.0 * half * half,
      std::exp(w.real()) * std::sin(w.imag()));
  return growth / w;
}

}  // namespace

ModalOscillator::ModalOscillator(double lambda, double damping)
    : lambda_(lambda), damping_(damping) {
  LIMBER_EXPECT(std::isfinite(lambda) && lambda >= 0.0);
  LIMBER_EXPECT(std::isfinite(damping) && damping >= 0.0);
  const double sigma = 0.5 * damping;
  // Fused, to avoid cancellation close to critical damping.
  const double discriminant = std::fma(-sigma, sigma, lambda);
  oscillates_ = discriminant > 0.0;
  rate_ = std::sqrt(std::abs(discriminant));
  if (!oscillates_) {
    fast_ = sigma + rate_;
    // sigma - rate would cancel.
    slow_ = fast_ > 0.0 ? lambda / fast_ : 0.0;
  }
}

FreeResponse ModalOscillator::find_free_response(double t) const {
  if (is_early(lambda_, damping_, t)) return find_early_response(t);
  return oscillates_ ? find_oscillating_response(t) : find_creeping_response(t);
}

// Divided differences of exp are power series in the complete homogeneous
// polynomials of the roots, which are real for any roots: h_n = -damping t
// h_(n-1) - lambda t^2 h_(n-2).
FreeResponse ModalOscillator::find_early_response(double t) const {
  double before = 0.0;
  double h = 1.0;
  double weight = 1.0;  // 1 / (n + 1)!
  double impulse = 1.0;
  double step = 0.5;
  for (int n = 1; n < kMostTerms; ++n) {
    const double next = -t * (damping_ * h + lambda_ * t * before);
    before = h;
    h = next;
    weight /= n + 1;
    impulse += weight * h;
    step += weight / (n + 2) * h;
    if (weight * (std::abs(h) + std::abs(before)) <
        0.01 * std::numeric_limits<double>::epsilon()) {
      break;
    }
  }
  FreeResponse response{.t = t, .impulse = impulse * t, .step = step * t * t};
  response.stay = 1.0 - lambda_ * response.step;
  response.keep = response.stay - damping_ * response.impulse;
  return response;
}

FreeResponse ModalOscillator::find_oscillating_response(double t) const {
  const double sigma = 0.5 * damping_;
  const double decay = std::exp(-sigma * t);
  const double cosine = decay * std::cos(rate_ * t);
  const double impulse = decay * t * find_sinc(rate_ * t);
  const double stay = cosine + sigma * impulse;
  return {.t = t,
          .stay = stay,
          .keep = cosine - sigma * impulse,
          .impulse = impulse,
          .step = (1.0 - stay) / lambda_};
}

FreeResponse ModalOscillator::find_creeping_response(double t) const {
  const double slow_decay = std::exp(-slow_ * t);
  const double impulse = slow_decay * t * find_mean_decay(2.0 * rate_ * t);
  return {.t = t,
          .stay = slow_decay + slow_ * impulse,
          .keep = std::exp(-fast_ * t) - slow_ * impulse,
          .impulse = impulse,
          .step = (t * find_mean_decay(slow_ * t) - impulse) / fast_};
}

HarmonicResponse ModalOscillator::find_harmonic_response(
    double omega, Complex phasor, const FreeResponse& free) const {
  if (omega * free.t <= kEarly && is_early(lambda_, damping_, free.t)) {
    return find_early_harmonic(omega, free);
  }
  const double sigma = 0.5 * damping_;
  const Complex s1 = oscillates_ ? Complex(-sigma, rate_) : Complex(-slow_);
  const Complex s2 = oscillates_ ? Complex(-sigma, -rate_) : Complex(-fast_);
  // (s1 - i omega) (s2 - i omega). Fused, to avoid cancellation close to
  // resonance.
  const Complex impedance(std::fma(-omega, omega, lambda_), damping_ * omega);
  const Complex far = s2 - Complex(0.0, omega);
  const Complex close = impedance / far;
  if (std::abs(close) * free.t < kEarly && 2.0 * rate_ * free.t >= 1.0) {
    return find_close_harmonic({s1, s2, close, far}, phasor, free.t);
  }
  // Particular solution minus the homogeneous one with its initial values.
  const Complex eta = phasor - Complex(free.stay, omega * free.impulse);
  const Complex etadot = Complex(lambda_ * free.impulse, -omega * free.keep) +
                         Complex(0.0, omega) * phasor;
  return {eta / impedance, etadot / impedance};
}

HarmonicResponse ModalOscillator::find_early_harmonic(
    double omega, const FreeResponse& free) const {
  const double t = free.t;
  const Complex z(0.0, omega * t);
  double before = 0.0;
  double pair = 1.0;     // h_n of the roots
  Complex triple = 1.0;  // h_n of the roots and i omega
  double weight = 0.5;   // 1 / (n + 2)!
  Complex sum = 0.5;
  for (int n = 1; n < kMostTerms; ++n) {
    const double next = -t * (damping_ * pair + lambda_ * t * before);
    before = pair;
    pair = next;
    triple = z * triple + pair;
    weight /= n + 2;
    sum += weight * triple;
    if (weight * (std::abs(triple) + std::abs(pair) + std::abs(before)) <
        0.01 * std::numeric_limits<double>::epsilon()) {
      break;
    }
  }
  const Complex eta = sum * (t * t);
  return {eta, free.impulse + Complex(0.0, omega) * eta};
}

// Divided difference of the responses of the two roots; each is smooth through
// its resonance.
HarmonicResponse ModalOscillator::find_close_harmonic(const Roots& roots,
                                                      Complex phasor,
                                                      double t) {
  const Complex answer1 = phasor * t * find_mean_growth(roots.close * t);
  const Complex answer2 = phasor * t * find_mean_growth(roots.far * t);
  const Complex distance = roots.s1 - roots.s2;
  return {(answer1 - answer2) / distance,
          (roots.s1 * answer1 - roots.s2 * answer2) / distance};
}

}  // namespace limber::flexbody
