// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <vector>

#include "limber/flexbody/modal/modal_response.hpp"

namespace limber::flexbody::test {

inline constexpr double kEps = std::numeric_limits<double>::epsilon();

inline VectorX make_vector(std::initializer_list<double> values) {
  VectorX vector(std::ssize(values));
  std::copy(values.begin(), values.end(), vector.data());
  return vector;
}

inline std::vector<double> make_grid(double from, double until, int intervals) {
  std::vector<double> times;
  for (int i = 0; i <= intervals; ++i)
    times.push_back(from + (until - from) * i / intervals);
  return times;
}

/// One mode of each kind: free, damped free, undamped, under-, critically and
/// over-damped.
struct Modes {
  VectorX lambda = make_vector({0.0, 0.0, 9.0, 16.0, 25.0, 4.0});
  VectorX damping = make_vector({0.0, 0.5, 0.0, 0.3, 10.0, 7.0});
};

inline ModalState make_state() {
  return {0.25, make_vector({0.1, -0.2, 0.3, 0.5, -0.4, 0.6}),
          make_vector({1.0, 0.4, -0.7, 0.2, 0.9, -1.1})};
}

inline StepLoad make_steps(Eigen::Index modes) {
  StepLoad steps{{-1.0, 0.5, 0.53, 1.9, 4.0}, MatrixX(modes, 5)};
  for (Eigen::Index k = 0; k < modes; ++k)
    for (Eigen::Index j = 0; j < 5; ++j)
      steps.values(k, j) = std::sin(1.0 + 3.0 * static_cast<double>(k) +
                                    7.0 * static_cast<double>(j));
  return steps;
}

inline SinusoidalLoad make_sinusoid(double omega, double from, double until) {
  return {omega, make_vector({0.3, -0.5, 1.0, 0.2, 0.8, -0.9}),
          make_vector({1.0, 0.7, -0.1, 0.6, 0.3, 0.2}), from, until};
}

inline ModalLoads make_loads() {
  // 3 rad/s is the undamped mode's own frequency.
  return {make_steps(6),
          {make_sinusoid(3.0, 0.7, 3.1), make_sinusoid(11.0, -2.0, 1e300)}};
}

/// The load as a function, written independently of the response.
inline double find_load(const ModalLoads& loads, Eigen::Index k, double t) {
  double f = 0.0;
  for (std::size_t j = 0; j < loads.steps.times.size(); ++j)
    if (loads.steps.times[j] <= t)
      f = loads.steps.values(k, static_cast<Eigen::Index>(j));
  for (const SinusoidalLoad& s : loads.sinusoids)
    if (t >= s.from && t < s.until)
      f += s.cosine[k] * std::cos(s.omega * (t - s.from)) +
           s.sine[k] * std::sin(s.omega * (t - s.from));
  return f;
}

}  // namespace limber::flexbody::test
