// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/distribution.hpp"

#include <algorithm>
#include <cmath>

#include "limber/study/design.hpp"

namespace limber::study {
namespace {

constexpr double kMissed = 0.05;  // 1 - confidence

}  // namespace

bool is_sampled(const Study& study) {
  return study.design.kind != DesignKind::grid &&
         study.design.kind != DesignKind::list;
}

bool is_sample(const Study& study, std::size_t run) {
  return study.design.kind != DesignKind::sobol ||
         run % (study.factors.size() + 2) < 2;
}

double Distribution::quantile(double p) const {
  const double rank = std::ceil(p * static_cast<double>(values.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  return values[std::min(index, values.size() - 1)];
}

std::optional<Distribution> find_distribution(const Study& study,
                                              const std::vector<StudyRow>& rows,
                                              std::size_t response) {
  if (!is_sampled(study)) return std::nullopt;
  Distribution found;
  for (const StudyRow& row : rows) {
    const auto& value = row.responses[response];
    if (value && is_sample(study, row.run)) found.values.push_back(*value);
  }
  if (found.values.size() < 2) return std::nullopt;
  std::sort(found.values.begin(), found.values.end());
  const auto n = static_cast<double>(found.values.size());
  for (const double value : found.values) found.mean += value / n;
  double squares = 0.0;
  for (const double value : found.values) {
    squares += (value - found.mean) * (value - found.mean);
  }
  found.mean_error = find_student_quantile(found.values.size() - 1) *
                     std::sqrt(squares / (n - 1.0) / n);
  found.band = std::sqrt(std::log(2.0 / kMissed) / (2.0 * n));
  return found;
}

double find_student_quantile(std::size_t degrees) {
  const double p = 1.0 - 0.5 * kMissed;
  if (degrees == 1) return std::tan(M_PI * (p - 0.5));
  if (degrees == 2) {
    return (2.0 * p - 1.0) * std::sqrt(2.0 / (4.0 * p * (1.0 - p)));
  }
  const double z = find_normal_quantile(p);
  const double s = z * z;
  const auto n = static_cast<double>(degrees);
  const double g1 = (s + 1.0) / 4.0;
  const double g2 = ((5.0 * s + 16.0) * s + 3.0) / 96.0;
  const double g3 = (((3.0 * s + 19.0) * s + 17.0) * s - 15.0) / 384.0;
  const double g4 =
      ((((79.0 * s + 776.0) * s + 1482.0) * s - 1920.0) * s - 945.0) / 92160.0;
  return z * (1.0 + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n);
}

}  // namespace limber::study
