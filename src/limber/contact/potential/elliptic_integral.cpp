// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/elliptic_integral.hpp"

#include <cmath>

namespace limber::contact {

EllipticIntegral find_elliptic_integral(double side) {
  double a = 1.0;
  double b = side;
  double power = 0.5;
  double sum = power * (1.0 - side * side);
  while (a - b > 1e-15 * a) {
    const double c = 0.5 * (a - b);
    const double next = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = next;
    power *= 2.0;
    sum += power * c * c;
  }
  return {a, sum};
}

}  // namespace limber::contact
