// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "limber/study/distribution.hpp"

namespace limber::study {
namespace {

constexpr std::size_t kFewestPairs = 4;
constexpr double kNormalQuantile = 1.959963984540054;  // of 97.5 %

/// Pearson's coefficient; none if one of them does not vary.
std::optional<double> correlate(const std::vector<double>& x,
                                const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const double x_mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double y_mean = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
    yy += (y[i] - y_mean) * (y[i] - y_mean);
  }
  if (!(xx > 0.0) || !(yy > 0.0)) return std::nullopt;
  return std::clamp(xy / std::sqrt(xx) / std::sqrt(yy), -1.0, 1.0);
}

/// From 0; equal values have their mean.
std::vector<double> find_ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return values[a] < values[b];
  });
  std::vector<double> ranks(values.size());
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from + 1;
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    const double rank = 0.5 * static_cast<double>(from + to - 1);
    for (; from < to; ++from) ranks[order[from]] = rank;
  }
  return ranks;
}

Interval find_interval(double r, double deviation) {
  const double z = std::atanh(r);
  return {std::tanh(z - kNormalQuantile * deviation),
          std::tanh(z + kNormalQuantile * deviation)};
}

std::optional<Correlation> correlate(const Study& study,
                                     const std::vector<StudyRow>& rows,
                                     std::size_t factor, std::size_t response) {
  std::vector<double> x;
  std::vector<double> y;
  for (const StudyRow& row : rows) {
    if (!row.responses[response] || !is_sample(study, row.run)) continue;
    const auto value = find_number(row.factors[factor]);
    if (!value) return std::nullopt;
    x.push_back(*value);
    y.push_back(*row.responses[response]);
  }
  if (x.size() < kFewestPairs) return std::nullopt;
  const auto linear = correlate(x, y);
  const auto rank = correlate(find_ranks(x), find_ranks(y));
  if (!linear || !rank) return std::nullopt;
  const auto freedom = static_cast<double>(x.size() - 3);
  return Correlation{
      *linear, *rank, find_interval(*linear, std::sqrt(1.0 / freedom)),
      find_interval(*rank, std::sqrt((1.0 + *rank * *rank / 2.0) / freedom)),
      x.size()};
}

}  // namespace

Correlations find_correlations(const Study& study,
                               const std::vector<StudyRow>& rows) {
  if (!is_sampled(study)) return {};
  Correlations found(study.factors.size());
  for (std::size_t f = 0; f < found.size(); ++f) {
    for (std::size_t r = 0; r < study.responses.size(); ++r) {
      found[f].push_back(correlate(study, rows, f, r));
    }
  }
  return found;
}

}  // namespace limber::study
