// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>

namespace limber::study {
namespace {

constexpr std::size_t kResamples = 1000;
constexpr std::size_t kMostGroups = 1000;  // more are not more accurate

/// The response of every run; empty if one is missing.
std::vector<double> list_values(const std::vector<StudyRow>& rows,
                                std::size_t runs, std::size_t response) {
  if (rows.size() != runs) return {};
  std::vector<double> values;
  for (const StudyRow& row : rows) {
    if (!row.responses[response]) return {};
    values.push_back(*row.responses[response]);
  }
  return values;
}

double calc_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double calc_variance(const std::vector<double>& values) {
  const double mean = calc_mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size());
}

bool varies(const std::vector<double>& y) {
  return std::any_of(y.begin(), y.end(), [&](double v) { return v != y[0]; });
}

/// What both estimators need of some samples (A, B, C).
struct Sums {
  double count = 0.0;
  double y = 0.0;        ///< A + B
  double square = 0.0;   ///< A² + B²
  double product = 0.0;  ///< B (C - A)
  double change = 0.0;   ///< C - A
  double changes = 0.0;  ///< (C - A)²

  void add(double A, double B, double C) {
    *this += {1.0, A + B, A * A + B * B, B * (C - A), C - A, (C - A) * (C - A)};
  }
  Sums& operator+=(const Sums& other) {
    count += other.count;
    y += other.y;
    square += other.square;
    product += other.product;
    change += other.change;
    changes += other.changes;
    return *this;
  }
};

std::optional<Effect> estimate(const Sums& sums) {
  const double mean = 0.5 * sums.y / sums.count;
  const double variance = 0.5 * sums.square / sums.count - mean * mean;
  if (!(variance > 0.0)) return std::nullopt;
  return Effect{(sums.product - mean * sums.change) / (sums.count * variance),
                0.5 * sums.changes / (sums.count * variance)};
}

/// Sums of the samples in at most kMostGroups groups, of responses without
/// their mean. Rows of each sample: A, B, then A with the k-th value of B.
std::vector<Sums> sum_up(const std::vector<double>& y, std::size_t factors,
                         std::size_t k) {
  const std::size_t block = factors + 2;
  const std::size_t samples = y.size() / block;
  const double mean = calc_mean(y);
  std::vector<Sums> groups(std::min(samples, kMostGroups));
  for (std::size_t i = 0; i < samples; ++i) {
    const double* const sample = &y[i * block];
    groups[i % groups.size()].add(sample[0] - mean, sample[1] - mean,
                                  sample[2 + k] - mean);
  }
  return groups;
}

Interval find_middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = [&](double fraction) {
    return values[static_cast<std::size_t>(std::lround(fraction * last))];
  };
  return {at(0.025), at(0.975)};
}

/// The same for any standard library.
std::size_t draw_below(std::mt19937_64& random, std::size_t count) {
  const double u = static_cast<double>(random() >> 11U) * 0x1p-53;
  return static_cast<std::size_t>(u * static_cast<double>(count));
}

void add_intervals(const std::vector<Sums>& groups, Effect& effect) {
  std::mt19937_64 random(1);
  std::vector<double> mains;
  std::vector<double> totals;
  for (std::size_t i = 0; i < kResamples; ++i) {
    Sums sums;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      sums += groups[draw_below(random, groups.size())];
    }
    if (const auto one = estimate(sums)) {
      mains.push_back(one->main);
      totals.push_back(one->total);
    }
  }
  effect.main_interval = find_middle(std::move(mains));
  effect.total_interval = find_middle(std::move(totals));
}

std::optional<std::size_t> find_needed(std::size_t samples,
                                       const Effect& effect) {
  const double widest = std::max(effect.main_interval->half_width(),
                                 effect.total_interval->half_width());
  if (samples >= kFewestSamples && widest <= kWidestEffect) return std::nullopt;
  const double ratio = std::max(widest / kWidestEffect, 1.0);
  const double needed = std::max(static_cast<double>(samples) * ratio * ratio,
                                 static_cast<double>(kFewestSamples));
  return std::bit_ceil(static_cast<std::size_t>(std::ceil(needed)));
}

std::optional<Effect> find_sampled(const std::vector<double>& y,
                                   std::size_t factors, std::size_t k) {
  if (!varies(y)) return std::nullopt;
  const std::vector<Sums> groups = sum_up(y, factors, k);
  Sums all;
  for (const Sums& group : groups) all += group;
  std::optional<Effect> effect = estimate(all);
  if (!effect) return std::nullopt;
  add_intervals(groups, *effect);
  effect->samples_needed = find_needed(y.size() / (factors + 2), *effect);
  return effect;
}

/// Variance of the means of y over groups of equal keys.
double calc_between(const std::vector<double>& y,
                    const std::vector<std::string>& keys) {
  std::map<std::string, std::vector<double>> groups;
  for (std::size_t i = 0; i < y.size(); ++i) groups[keys[i]].push_back(y[i]);
  std::vector<double> means;
  for (const auto& [key, values] : groups) means.push_back(calc_mean(values));
  return calc_variance(means);
}

std::optional<Effect> find_gridded(const std::vector<double>& y,
                                   const std::vector<StudyRow>& rows,
                                   std::size_t k) {
  const double variance = calc_variance(y);
  if (!(variance > 0.0)) return std::nullopt;
  std::vector<std::string> own;
  std::vector<std::string> others;
  for (const StudyRow& row : rows) {
    own.push_back(row.factors[k]);
    others.emplace_back();
    for (std::size_t f = 0; f < row.factors.size(); ++f) {
      if (f != k) others.back() += row.factors[f] + "\n";
    }
  }
  return Effect{calc_between(y, own) / variance,
                1.0 - calc_between(y, others) / variance};
}

bool has_effects(const Study& study) {
  return study.design.kind == DesignKind::sobol ||
         study.design.kind == DesignKind::grid;
}

}  // namespace

Effects find_effects(const Study& study, std::size_t runs,
                     const std::vector<StudyRow>& rows) {
  if (!has_effects(study)) return {};
  const bool is_sobol = study.design.kind == DesignKind::sobol;
  Effects effects(study.factors.size());
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    const std::vector<double> y = list_values(rows, runs, r);
    for (std::size_t f = 0; f < effects.size(); ++f) {
      effects[f].push_back(y.empty()  ? std::nullopt
                           : is_sobol ? find_sampled(y, study.factors.size(), f)
                                      : find_gridded(y, rows, f));
    }
  }
  return effects;
}

std::string find_missing_effects(const Study& study, std::size_t runs,
                                 const std::vector<StudyRow>& rows,
                                 std::size_t response) {
  if (!has_effects(study)) return "";
  const auto count = static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(),
      [&](const StudyRow& row) { return row.responses[response]; }));
  if (count < runs) {
    return fmt::format("{} of {} runs have no value", runs - count, runs);
  }
  if (!varies(list_values(rows, runs, response))) return "it does not vary";
  return "";
}

std::string describe_doubt(const Study& study, const Effect& effect) {
  if (!effect.samples_needed) return "";
  return fmt::format("not significant with {} samples; about {} may suffice",
                     study.design.samples, *effect.samples_needed);
}

}  // namespace limber::study
