// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/study/study_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "limber/app/study/distribution.hpp"

namespace limber::app {
namespace {

std::string quote_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    if (c == '"') quoted += c;
  }
  return quoted + "\"";
}

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

/// Rows of each sample: A, B, then A with the k-th coordinate of B.
std::optional<Effect> find_sampled(const std::vector<double>& y,
                                   std::size_t factors, std::size_t k) {
  const std::size_t block = factors + 2;
  std::vector<double> free;  // of A and B
  double main = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < y.size(); i += block) {
    free.push_back(y[i]);
    free.push_back(y[i + 1]);
    const double changed = y[i + 2 + k];
    main += y[i + 1] * (changed - y[i]);
    total += 0.5 * (y[i] - changed) * (y[i] - changed);
  }
  const double variance = calc_variance(free);
  if (!(variance > 0.0)) return std::nullopt;
  const std::size_t count = y.size() / block;
  const auto samples = static_cast<double>(count);
  return Effect{main / samples / variance, total / samples / variance};
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

using Words = std::string StudyRow::*;

/// Rows with an error, or with warnings.
std::vector<const StudyRow*> list_rows(const std::vector<StudyRow>& rows,
                                       Words words) {
  std::vector<const StudyRow*> found;
  for (const StudyRow& row : rows) {
    if (!(row.*words).empty()) found.push_back(&row);
  }
  return found;
}

std::string describe_rows(const std::vector<StudyRow>& rows, Words words,
                          const char* what) {
  const auto found = list_rows(rows, words);
  if (found.empty()) return "";
  return fmt::format("{} of {} runs {}; run {}: {}\n", found.size(),
                     rows.size(), what, found.front()->run,
                     found.front()->*words);
}

std::string to_number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

}  // namespace

std::string to_csv(const Study& study, const std::vector<StudyRow>& rows) {
  std::string text = "run";
  for (const Factor& factor : study.factors) text += "," + factor.name;
  for (const Response& one : study.responses) text += "," + one.name;
  text += ",error,warnings";
  for (const StudyRow& row : rows) {
    text += fmt::format("\n{}", row.run);
    for (const std::string& value : row.factors)
      text += "," + quote_cell(value);
    for (const auto& value : row.responses) text += "," + to_number(value);
    text += "," + quote_cell(row.error) + "," + quote_cell(row.warnings);
  }
  return text;
}

ResponseRange find_range(const std::vector<StudyRow>& rows,
                         std::size_t response) {
  ResponseRange range;
  double sum = 0.0;
  for (const StudyRow& row : rows) {
    const auto& value = row.responses[response];
    if (!value) continue;
    range.least = range.count == 0 ? *value : std::min(range.least, *value);
    range.largest = range.count == 0 ? *value : std::max(range.largest, *value);
    sum += *value;
    ++range.count;
  }
  if (range.count > 0) range.mean = sum / static_cast<double>(range.count);
  return range;
}

Effects find_effects(const Study& study, std::size_t runs,
                     const std::vector<StudyRow>& rows) {
  const bool is_sobol = study.design.kind == DesignKind::sobol;
  if (!is_sobol && study.design.kind != DesignKind::grid) return {};
  Effects effects(study.factors.size());
  for (std::size_t f = 0; f < effects.size(); ++f) {
    for (std::size_t r = 0; r < study.responses.size(); ++r) {
      const std::vector<double> y = list_values(rows, runs, r);
      effects[f].push_back(y.empty()  ? std::nullopt
                           : is_sobol ? find_sampled(y, study.factors.size(), f)
                                      : find_gridded(y, rows, f));
    }
  }
  return effects;
}

std::string to_text(const Study& study, const std::vector<StudyRow>& rows,
                    const Effects& effects) {
  std::string text =
      fmt::format("{:<24} {:>6} {:>13} {:>13} {:>13}\n", "response", "runs",
                  "least", "mean", "largest");
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    const ResponseRange range = find_range(rows, r);
    text += fmt::format("{:<24} {:>6}", study.responses[r].name, range.count);
    text += range.count == 0
                ? "             -             -             -\n"
                : fmt::format(" {:>13.6g} {:>13.6g} {:>13.6g}\n", range.least,
                              range.mean, range.largest);
  }
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    const auto found = find_distribution(study, rows, r);
    if (!found) continue;
    text += fmt::format(
        "{:<24} mean {:.4g} +- {:.2g} (95 %), 90 % of the samples in {:.4g} to "
        "{:.4g}\n",
        study.responses[r].name, found->mean, found->mean_error,
        found->quantile(0.05), found->quantile(0.95));
  }
  for (std::size_t f = 0; f < effects.size(); ++f) {
    for (std::size_t r = 0; r < study.responses.size(); ++r) {
      const auto& effect = effects[f][r];
      if (!effect) continue;
      text += fmt::format("{:<24} on {:<24} main {:6.3f}  total {:6.3f}\n",
                          study.factors[f].name, study.responses[r].name,
                          effect->main, effect->total);
    }
  }
  text += describe_rows(rows, &StudyRow::error, "failed");
  text += describe_rows(rows, &StudyRow::warnings, "have warnings");
  return text;
}

Json to_json(const Study& study, std::size_t runs,
             const std::vector<StudyRow>& rows, const Effects& effects) {
  Json json{{"study", study.file.string()},
            {"design", to_string(study.design.kind)},
            {"runs", runs},
            {"done", rows.size()},
            {"failed", list_rows(rows, &StudyRow::error).size()},
            {"warned", list_rows(rows, &StudyRow::warnings).size()},
            {"responses", Json::object()}};
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    const ResponseRange range = find_range(rows, r);
    Json one{{"count", range.count}};
    if (range.count > 0) {
      one["least"] = range.least;
      one["mean"] = range.mean;
      one["largest"] = range.largest;
    }
    if (const auto found = find_distribution(study, rows, r)) {
      one["mean_error"] = found->mean_error;
      one["distribution_error"] = found->band;
      for (const double p : {0.05, 0.5, 0.95}) {
        one["quantiles"][fmt::format("{:g}", p)] = found->quantile(p);
      }
    }
    for (std::size_t f = 0; f < effects.size(); ++f) {
      if (!effects[f][r]) continue;
      one["effects"][study.factors[f].name] = {{"main", effects[f][r]->main},
                                               {"total", effects[f][r]->total}};
    }
    json["responses"][study.responses[r].name] = one;
  }
  return json;
}

}  // namespace limber::app
