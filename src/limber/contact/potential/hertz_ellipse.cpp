// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/hertz_ellipse.hpp"

#include <cmath>
#include <numbers>

#include "limber/contact/potential/elliptic_integral.hpp"

namespace limber::contact {
namespace {

/// An ellipse of contact of half axes a > b.
struct ContactEllipse {
  double x = 1.0;
  double factor = 1.0;
};

// @param log_ratio ln(a / b) > 0
ContactEllipse find_contact_ellipse(double log_ratio) {
  const double side = std::exp(-log_ratio);
  const double square = 1.0 - side * side;  // e^2
  const EllipticIntegral integral = find_elliptic_integral(side);
  const double K = 0.5 * std::numbers::pi / integral.mean;
  const double E = K * (1.0 - integral.defect);
  const double root =
      std::sqrt((E / (side * side) - K) / (K * integral.defect));
  return {0.5 * (root + 1.0 / root),
          0.5 * std::numbers::pi / K *
              std::sqrt(2.0 * root * integral.defect / square)};
}

}  // namespace

EllipseFactor find_ellipse_factor(double x) {
  constexpr double kRound = 0.05;  // ln(a / b), below it straight
  constexpr double kLongest = 25.0;
  constexpr double kStep = 1e-4;
  constexpr int kIterations = 60;
  const auto find_slope = [](double at) {
    const ContactEllipse above = find_contact_ellipse(at + kStep);
    const ContactEllipse below = find_contact_ellipse(at - kStep);
    return (above.factor - below.factor) / (above.x - below.x);
  };
  const ContactEllipse round = find_contact_ellipse(kRound);
  if (x <= round.x) {
    const double slope = find_slope(kRound);
    return {round.factor + slope * (x - round.x), slope};
  }
  // By the rule of Illinois, in ln x.
  double low = kRound;
  double high = kLongest;
  double of_low = std::log(round.x / x);
  double of_high = std::log(find_contact_ellipse(high).x / x);
  double at = low;
  int side = 0;
  for (int i = 0; i < kIterations && high - low > 1e-14 * high; ++i) {
    at = (of_high * low - of_low * high) / (of_high - of_low);
    const double value = std::log(find_contact_ellipse(at).x / x);
    if (value == 0.0) break;
    if (value < 0.0) {
      low = at;
      of_low = value;
      if (side == -1) of_high *= 0.5;
      side = -1;
    } else {
      high = at;
      of_high = value;
      if (side == 1) of_low *= 0.5;
      side = 1;
    }
  }
  return {find_contact_ellipse(at).factor, find_slope(at)};
}

}  // namespace limber::contact
