// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber::results {
namespace {

constexpr double kSeen = 0.01;  // of the height [-]
constexpr double kInfinite = std::numeric_limits<double>::infinity();

double find_height(const Band& band) {
  double least = kInfinite;
  double most = -kInfinite;
  for (const double value : band.least) {
    if (std::isfinite(value)) least = std::min(least, value);
  }
  for (const double value : band.most) {
    if (std::isfinite(value)) most = std::max(most, value);
  }
  return most > least ? most - least : 0.0;
}

}  // namespace

bool exceeds(const Band& band, const std::vector<double>& times,
             const std::vector<double>& values) {
  const double seen = kSeen * find_height(band);
  if (!(seen > 0.0)) return false;
  for (std::size_t k = 0; k < band.least.size(); ++k) {
    double least = kInfinite;
    double most = -kInfinite;
    const auto first =
        std::lower_bound(times.begin(), times.end(), band.edges[k]);
    for (auto i = static_cast<std::size_t>(first - times.begin());
         i < times.size() && times[i] <= band.edges[k + 1]; ++i) {
      least = std::fmin(least, values[i]);
      most = std::fmax(most, values[i]);
    }
    // Comparisons with NaN are false.
    if (band.least[k] < least - seen || band.most[k] > most + seen) return true;
  }
  return false;
}

}  // namespace limber::results
