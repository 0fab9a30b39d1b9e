// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/study/study_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "limber/app/console/terminal.hpp"
#include "limber/results/charts/study_picture.hpp"
#include "limber/results/draw_all.hpp"
#include "limber/study/distribution.hpp"

namespace limber::app {
namespace {

using results::StudyColumn;

/// A factor with a text among its values is drawn by the numbers of its texts.
StudyColumn make_factor(const study::Study& study,
                        const std::vector<study::StudyRow>& rows,
                        std::size_t f) {
  StudyColumn column;
  column.name = study.factors[f].name;
  const auto* spread = std::get_if<study::Spread>(&study.factors[f].values);
  column.is_logarithmic = spread != nullptr && spread->is_logarithmic;
  const bool is_text =
      std::any_of(rows.begin(), rows.end(), [&](const study::StudyRow& row) {
        return !study::find_number(row.factors[f]).has_value();
      });
  for (const study::StudyRow& row : rows) {
    if (!is_text) {
      column.values.push_back(*study::find_number(row.factors[f]));
      continue;
    }
    auto at =
        std::find(column.texts.begin(), column.texts.end(), row.factors[f]);
    if (at == column.texts.end()) {
      at = column.texts.insert(at, row.factors[f]);
    }
    column.values.push_back(static_cast<double>(at - column.texts.begin()));
  }
  return column;
}

StudyColumn make_response(const study::Study& study,
                          const std::vector<study::StudyRow>& rows,
                          std::size_t r) {
  StudyColumn column{study.responses[r].name, {}};
  for (const study::StudyRow& row : rows) {
    column.values.push_back(
        row.responses[r].value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return column;
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

results::Bar make_bar(double value,
                      const std::optional<study::Interval>& interval,
                      bool is_significant) {
  const study::Interval range =
      interval.value_or(study::Interval{value, value});
  return {is_significant ? value : kNone, range.low, range.high};
}

using TwoBars = std::optional<std::pair<results::Bar, results::Bar>>;

/// Bars of all factors for each response, of which `bars_of(factor, response)`
/// gives the two, or none.
template <typename BarsOf>
std::vector<results::FactorBars> make_bars(const study::Study& study,
                                           BarsOf bars_of) {
  std::vector<results::FactorBars> all;
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    results::FactorBars bars;
    bars.response = study.responses[r].name;
    for (std::size_t f = 0; f < study.factors.size(); ++f) {
      const TwoBars two = bars_of(f, r);
      if (!two) continue;
      bars.factors.push_back(study.factors[f].name);
      bars.first.push_back(two->first);
      bars.second.push_back(two->second);
    }
    if (!bars.factors.empty()) all.push_back(bars);
  }
  return all;
}

TwoBars make_effect_bars(const study::Effects& effects, std::size_t f,
                         std::size_t r) {
  if (f >= effects.size() || !effects[f][r]) return std::nullopt;
  const study::Effect& effect = *effects[f][r];
  const bool is_significant = !effect.samples_needed;
  return std::pair(
      make_bar(effect.main, effect.main_interval, is_significant),
      make_bar(effect.total, effect.total_interval, is_significant));
}

TwoBars make_correlation_bars(const study::Correlations& found, std::size_t f,
                              std::size_t r) {
  if (f >= found.size() || !found[f][r]) return std::nullopt;
  const study::Correlation& one = *found[f][r];
  return std::pair(make_bar(one.linear, one.linear_interval, true),
                   make_bar(one.rank, one.rank_interval, true));
}

std::vector<results::DistributionCurve> make_curves(
    const study::Study& study, const std::vector<study::StudyRow>& rows) {
  std::vector<results::DistributionCurve> curves;
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    const std::optional<study::Distribution> found =
        find_distribution(study, rows, r);
    if (!found) continue;
    curves.push_back({study.responses[r].name, found->values, found->mean,
                      found->mean_error, found->band});
  }
  return curves;
}

}  // namespace

void draw_study(const study::Study& study,
                const std::vector<study::StudyRow>& rows,
                const StudyFindings& findings,
                const std::filesystem::path& folder) {
  if (rows.empty()) return;
  std::vector<StudyColumn> factors;
  std::vector<StudyColumn> responses;
  for (std::size_t f = 0; f < study.factors.size(); ++f) {
    factors.push_back(make_factor(study, rows, f));
  }
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    responses.push_back(make_response(study, rows, r));
  }
  std::vector<results::Picture> pictures;
  std::vector<StudyColumn> all = factors;
  all.insert(all.end(), responses.begin(), responses.end());
  // The slowest one first.
  pictures.emplace_back(
      [&] { return draw_matrix(folder / "matrix.png", study.name, all); });
  for (const StudyColumn& response : responses) {
    const std::string title = fmt::format("{}: {} in {} runs", study.name,
                                          response.name, rows.size());
    pictures.emplace_back([=, &factors] {
      return draw_response(folder / ("response_" + response.name + ".png"),
                           title, response, factors);
    });
    pictures.emplace_back([=, &factors] {
      return draw_maps(folder / ("map_" + response.name + ".png"),
                       title + ", as colour", response, factors);
    });
  }
  pictures.emplace_back([&] {
    return draw_bars(
        folder / "effects.png",
        study.name + ": effects of factors, with intervals of 95 %",
        {"main", "total", "fraction of the variance [-]", "[*<0:1.05<*]"},
        make_bars(study, [&](std::size_t f, std::size_t r) {
          return make_effect_bars(findings.effects, f, r);
        }));
  });
  pictures.emplace_back([&] {
    return draw_bars(
        folder / "correlation.png",
        study.name + ": correlation with factors, with intervals of 95 %",
        {"of values", "of ranks", "correlation [-]", "[-1.05:1.05]"},
        make_bars(study, [&](std::size_t f, std::size_t r) {
          return make_correlation_bars(findings.correlations, f, r);
        }));
  });
  pictures.emplace_back([&] {
    return draw_distributions(
        folder / "distribution.png",
        study.name + ": distributions, 95 % confidence shaded",
        make_curves(study, rows));
  });
  print_warnings(results::draw_all(pictures));
}

}  // namespace limber::app
