// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/modal_response_oscillator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "limber/common/errors.hpp"

namespace limber::flexbody::test::modal_response_oscillator_test {
namespace {

using Real = long double;
using Matrix = std::array<std::array<Real, 4>, 4>;
using Complex = std::complex<double>;

constexpr double kEps = std::numeric_limits<double>::epsilon();
// Round-off in units of eps (1 + angles): a few operations.
constexpr double kRoundoff = 8.0;

Matrix multiply(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t j = 0; j < 4; ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

double find_balance(double lambda, double t) {
  return std::max(1.0, std::sqrt(lambda) * t);
}

// The exponential that takes (eta / t^2, etadot / (t w), cos, sin) over t, by
// scaling, Taylor and squaring. It has no regimes, roots or resonance. The
// scaling w keeps the number of squarings, and so its round-off, small.
Matrix calc_exponential(double lambda, double damping, double omega, double t) {
  const Real h = t;
  Matrix A{};
  const Real w = find_balance(lambda, t);
  A[0][1] = w;
  A[1] = {-lambda * h * h / w, -damping * h, 1.0L / w, 0.0L};
  A[2][3] = -omega * h;
  A[3][2] = omega * h;
  Real largest = 0.0L;
  for (const auto& row : A)
    for (const Real x : row) largest = std::max(largest, std::abs(x));
  const int squarings = std::max(0, std::ilogb(largest) + 3);
  for (auto& row : A)
    for (Real& x : row) x = std::ldexp(x, -squarings);
  Matrix sum{};
  Matrix term{};
  for (std::size_t i = 0; i < 4; ++i) sum[i][i] = term[i][i] = 1.0L;
  for (int n = 1; n < 25; ++n) {
    term = multiply(term, A);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        sum[i][j] += term[i][j] /= static_cast<Real>(n);
  }
  for (int i = 0; i < squarings; ++i) sum = multiply(sum, sum);
  return sum;
}

// Results of the oscillator, without units: 4 free responses, then the harmonic
// ones.
struct Answers {
  std::array<double, 4> free;
  std::array<Complex, 2> harmonic;
};

Answers find_answers(double lambda, double damping, double omega, double t) {
  const ModalOscillator mode(lambda, damping);
  const FreeResponse free = mode.find_free_response(t);
  const Complex phasor(std::cos(omega * t), std::sin(omega * t));
  const HarmonicResponse harmonic =
      mode.find_harmonic_response(omega, phasor, free);
  return {{free.stay, free.keep, free.impulse, free.step},
          {harmonic.eta, harmonic.etadot}};
}

Answers find_reference(double lambda, double damping, double omega, double t) {
  const Matrix S = calc_exponential(lambda, damping, 0.0, t);
  const Matrix R = calc_exponential(lambda, damping, omega, t);
  const auto round = [](Real x) { return static_cast<double>(x); };
  const Real w = find_balance(lambda, t);
  const Real v = w * t;
  const Real x = static_cast<Real>(t) * t;
  // Column 3 starts at sin = 1, so that cos goes as -sin(omega t).
  return {{round(S[0][0]), round(S[1][1]), round(S[0][1] * t / w),
           round(S[0][2] * x)},
          {Complex(round(R[0][2] * x), -round(R[0][3] * x)),
           Complex(round(R[1][2] * v), -round(R[1][3] * v))}};
}

struct Case {
  double lambda;
  double damping;
  double omega;
  double t;
};

// Largest error relative to the largest value in the last period, in units of
// eps (1 + angles).
double find_error(const Case& c) {
  const double angles = 1.0 + (std::sqrt(c.lambda) + c.omega + c.damping) * c.t;
  const Answers truth = find_reference(c.lambda, c.damping, c.omega, c.t);
  const Answers ours = find_answers(c.lambda, c.damping, c.omega, c.t);
  std::array<double, 4> free_scale{};
  std::array<double, 2> harmonic_scale{};
  const double quickest = std::max({std::sqrt(c.lambda), c.omega, 1.0 / c.t});
  for (const double back : {0.0, 1.0, 2.0, 3.0, 4.5, 6.0}) {
    const double free_t =
        c.t - back * std::min(1.0 / std::max(std::sqrt(c.lambda), 1.0 / c.t),
                              0.1 * c.t);
    const double t = c.t - back * std::min(1.0 / quickest, 0.1 * c.t);
    const Answers f = find_reference(c.lambda, c.damping, c.omega, free_t);
    const Answers h = find_reference(c.lambda, c.damping, c.omega, t);
    for (std::size_t i = 0; i < 4; ++i)
      free_scale[i] = std::max(free_scale[i], std::abs(f.free[i]));
    for (std::size_t i = 0; i < 2; ++i)
      harmonic_scale[i] = std::max(harmonic_scale[i], std::abs(h.harmonic[i]));
  }
  // The reference has round-off of the whole state in each of its parts.
  harmonic_scale[1] = std::max(harmonic_scale[1],
                               1e-5 * std::sqrt(c.lambda) * harmonic_scale[0]);
  // Decayed motion: below this the reference itself is round-off.
  const std::array<double, 4> floor{1e-10, 1e-10, 1e-10 * c.t,
                                    1e-10 * c.t * c.t};
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    worst = std::max(worst, std::abs(ours.free[i] - truth.free[i]) /
                                std::max(free_scale[i], floor[i]));
  for (std::size_t i = 0; i < 2; ++i)
    worst = std::max(worst, std::abs(ours.harmonic[i] - truth.harmonic[i]) /
                                std::max(harmonic_scale[i], floor[3 - i]));
  return worst / (kEps * angles);
}

class ModalOscillatorAgainstExponential : public ::testing::Test {
 protected:
  double draw(double from, double until) {
    return std::pow(
        10.0, std::uniform_real_distribution<double>(from, until)(random));
  }
  double sign() { return random() % 2 == 0 ? 1.0 : -1.0; }
  static constexpr int kCases = 400;
  std::mt19937_64 random{20};
};

TEST_F(ModalOscillatorAgainstExponential, AnyRatesAgree) {
  for (int i = 0; i < kCases; ++i) {
    const double t = draw(-3, 3);
    const Case c{std::pow(draw(-5, 2.5) / t, 2), draw(-5, 2.5) / t,
                 draw(-5, 2.5) / t, t};
    EXPECT_LT(find_error(c), kRoundoff)
        << c.lambda << ' ' << c.damping << ' ' << c.omega << ' ' << c.t;
  }
}

TEST_F(ModalOscillatorAgainstExponential, NearCriticalDampingNothingIsLost) {
  for (int i = 0; i < kCases; ++i) {
    const double t = draw(-3, 3);
    const double omega0 = draw(-2, 1.5) / t;
    const double offset = i % 5 == 0 ? 0.0 : sign() * draw(-16, -1);
    const Case c{omega0 * omega0, 2.0 * omega0 * (1.0 + offset),
                 draw(-3, 2) / t, t};
    EXPECT_LT(find_error(c), kRoundoff)
        << c.lambda << ' ' << c.damping << ' ' << c.omega << ' ' << c.t;
  }
}

TEST_F(ModalOscillatorAgainstExponential, NearResonanceNothingIsLost) {
  for (int i = 0; i < kCases; ++i) {
    const double t = draw(-3, 3);
    const double omega0 = draw(-1, 2.5) / t;
    const double offset = i % 5 == 0 ? 0.0 : sign() * draw(-16, -1);
    const double damping = i % 3 == 0 ? 0.0 : omega0 * draw(-12, -1);
    const Case c{omega0 * omega0, damping, omega0 * (1.0 + offset), t};
    EXPECT_LT(find_error(c), kRoundoff)
        << c.lambda << ' ' << c.damping << ' ' << c.omega << ' ' << c.t;
  }
}

TEST_F(ModalOscillatorAgainstExponential, NearZeroFrequencyNothingIsLost) {
  for (int i = 0; i < kCases; ++i) {
    const double t = draw(-3, 3);
    const double lambda = i % 2 == 0 ? 0.0 : std::pow(draw(-12, -4) / t, 2);
    const double damping = i % 3 == 0 ? 0.0 : draw(-12, 2.5) / t;
    const double omega = i % 5 == 0 ? 0.0 : draw(-12, 2.5) / t;
    const Case c{lambda, damping, omega, t};
    EXPECT_LT(find_error(c), kRoundoff)
        << c.lambda << ' ' << c.damping << ' ' << c.omega << ' ' << c.t;
  }
}

TEST(ModalOscillator, WithoutStiffnessOrDampingIsAFreeMass) {
  const FreeResponse free = ModalOscillator(0.0, 0.0).find_free_response(3.0);
  EXPECT_EQ(free.stay, 1.0);
  EXPECT_EQ(free.keep, 1.0);
  EXPECT_EQ(free.impulse, 3.0);
  EXPECT_EQ(free.step, 4.5);
}

TEST(ModalOscillator, WithoutStiffnessADamperStopsTheMass) {
  const double c = 0.7;
  const double t = 40.0;
  const FreeResponse free = ModalOscillator(0.0, c).find_free_response(t);
  const double spent = -std::expm1(-c * t);
  EXPECT_EQ(free.stay, 1.0);
  EXPECT_DOUBLE_EQ(free.keep, std::exp(-c * t));
  EXPECT_DOUBLE_EQ(free.impulse, spent / c);
  EXPECT_DOUBLE_EQ(free.step, (t - spent / c) / c);
}

TEST(ModalOscillator, UndampedIsCosineAndSine) {
  const double omega = 1096.0;
  for (const double t : {1e-6, 1e-3, 0.1, 2.0}) {
    const double tolerance = kRoundoff * kEps * (1.0 + omega * t);
    const FreeResponse free =
        ModalOscillator(omega * omega, 0.0).find_free_response(t);
    EXPECT_NEAR(free.stay, std::cos(omega * t), tolerance);
    EXPECT_NEAR(free.keep, std::cos(omega * t), tolerance);
    EXPECT_NEAR(free.impulse * omega, std::sin(omega * t), tolerance);
    EXPECT_NEAR(free.step * omega * omega,
                2.0 * std::pow(std::sin(0.5 * omega * t), 2), tolerance);
  }
}

TEST(ModalOscillator, CriticallyDampedIsALineTimesADecay) {
  const double s = 3.0;
  for (const double t : {1e-5, 0.1, 1.0, 8.0}) {
    const FreeResponse free =
        ModalOscillator(s * s, 2.0 * s).find_free_response(t);
    const double decay = std::exp(-s * t);
    EXPECT_NEAR(free.stay, (1.0 + s * t) * decay, kRoundoff * kEps);
    EXPECT_NEAR(free.keep, (1.0 - s * t) * decay, kRoundoff * kEps);
    EXPECT_NEAR(free.impulse / (t * decay), 1.0, 32.0 * kEps);
  }
}

TEST(ModalOscillator, TheWronskianDecaysWithTheDamping) {
  for (const double damping : {0.0, 0.3, 4.0, 30.0}) {
    const double lambda = 4.0;
    const double t = 1.3;
    const FreeResponse free =
        ModalOscillator(lambda, damping).find_free_response(t);
    EXPECT_NEAR(free.stay * free.keep + lambda * free.impulse * free.impulse,
                std::exp(-damping * t), kRoundoff * kEps);
  }
}

// An independent route to late times: reduce the angle with more digits.
TEST(ModalOscillator, AfterAMillionPeriodsThePhaseErrorIsRoundOffOfTheAngle) {
  const double omega = 1096.0;
  const double period = 2.0 * 3.14159265358979323846 / omega;
  for (const double fraction : {0.0, 0.1, 0.37, 0.8}) {
    const double t = (1e6 + fraction) * period;
    const Real angle = static_cast<Real>(omega) * t;
    const FreeResponse free =
        ModalOscillator(omega * omega, 0.0).find_free_response(t);
    const double tolerance = kEps * omega * t;
    EXPECT_NEAR(free.stay, static_cast<double>(std::cos(angle)), tolerance);
    EXPECT_NEAR(free.impulse * omega, static_cast<double>(std::sin(angle)),
                tolerance);
  }
}

TEST(ModalOscillator, ExactResonanceGrowsForAMillionPeriods) {
  const double omega = 1096.0;
  const double t = 6000.0;
  const Real angle = static_cast<Real>(omega) * t;
  const ModalOscillator mode(omega * omega, 0.0);
  const HarmonicResponse response = mode.find_harmonic_response(
      omega, {std::cos(omega * t), std::sin(omega * t)},
      mode.find_free_response(t));
  const double envelope = t / (2.0 * omega);
  EXPECT_NEAR(response.eta.real() / envelope,
              static_cast<double>(std::sin(angle)), kEps * omega * t);
}

TEST(ModalOscillator, RefusesWhatIsNegativeOrNotFinite) {
  const double nan = std::nan("");
  EXPECT_THROW(ModalOscillator(-1.0, 0.0), ContractError);
  EXPECT_THROW(ModalOscillator(1.0, -1.0), ContractError);
  EXPECT_THROW(ModalOscillator(nan, 0.0), ContractError);
  EXPECT_THROW(ModalOscillator(1.0, nan), ContractError);
}

}  // namespace
}  // namespace limber::flexbody::test::modal_response_oscillator_test
