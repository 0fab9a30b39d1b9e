// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/study/study_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/study/distribution.hpp"

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

using Words = std::string study::StudyRow::*;

/// Rows with an error, or with warnings.
std::vector<const study::StudyRow*> list_rows(
    const std::vector<study::StudyRow>& rows, Words words) {
  std::vector<const study::StudyRow*> found;
  for (const study::StudyRow& row : rows) {
    if (!(row.*words).empty()) found.push_back(&row);
  }
  return found;
}

std::string describe_rows(const std::vector<study::StudyRow>& rows, Words words,
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

std::string describe(const std::optional<study::Interval>& interval) {
  if (!interval) return "";
  return fmt::format(" ({:.2f} to {:.2f})", interval->low, interval->high);
}

std::string describe_effects(const study::Study& study, std::size_t runs,
                             const std::vector<study::StudyRow>& rows,
                             const study::Effects& effects) {
  std::string text;
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    const std::string& response = study.responses[r].name;
    const std::string why = find_missing_effects(study, runs, rows, r);
    if (!why.empty()) {
      text += fmt::format("{:<24} has no effects: {}\n", response, why);
    }
    for (std::size_t f = 0; f < effects.size(); ++f) {
      const auto& effect = effects[f][r];
      if (!effect) continue;
      const std::string doubt = describe_doubt(study, *effect);
      text += fmt::format(
          "{:<24} on {:<24} main {:6.3f}{}  total {:6.3f}{}{}\n",
          study.factors[f].name, response, effect->main,
          describe(effect->main_interval), effect->total,
          describe(effect->total_interval), doubt.empty() ? "" : ": " + doubt);
    }
  }
  return text;
}

std::string describe_correlations(const study::Study& study,
                                  const study::Correlations& correlations) {
  std::string text;
  for (std::size_t r = 0; r < study.responses.size(); ++r) {
    for (std::size_t f = 0; f < correlations.size(); ++f) {
      const auto& found = correlations[f][r];
      if (!found) continue;
      text += fmt::format(
          "{:<24} with {:<22} correlation {:6.3f}{}  of ranks {:6.3f}{}{}\n",
          study.factors[f].name, study.responses[r].name, found->linear,
          describe(found->linear_interval), found->rank,
          describe(found->rank_interval),
          found->is_significant()
              ? ""
              : fmt::format(": not distinguishable from 0 with {} samples",
                            found->samples));
    }
  }
  return text;
}

Json to_list(const study::Interval& interval) {
  return Json::array({interval.low, interval.high});
}

/// An effect that the samples do not carry is null.
Json to_json(const study::Study& study, const study::Effect& effect) {
  const std::string doubt = describe_doubt(study, effect);
  Json json{{"main", doubt.empty() ? Json(effect.main) : Json(nullptr)},
            {"total", doubt.empty() ? Json(effect.total) : Json(nullptr)}};
  if (effect.main_interval) {
    json["main_interval"] = to_list(*effect.main_interval);
    json["total_interval"] = to_list(*effect.total_interval);
  }
  if (!doubt.empty()) json["doubt"] = doubt;
  return json;
}

Json to_json(const study::Correlation& correlation) {
  return Json{{"linear", correlation.linear},
              {"linear_interval", to_list(correlation.linear_interval)},
              {"rank", correlation.rank},
              {"rank_interval", to_list(correlation.rank_interval)},
              {"differs_from_zero", correlation.is_significant()},
              {"samples", correlation.samples}};
}

}  // namespace

std::string to_csv(const study::Study& study,
                   const std::vector<study::StudyRow>& rows) {
  std::string text = "run";
  for (const study::Factor& factor : study.factors) text += "," + factor.name;
  for (const study::Response& one : study.responses) text += "," + one.name;
  text += ",error,warnings";
  for (const study::StudyRow& row : rows) {
    text += fmt::format("\n{}", row.run);
    for (const std::string& value : row.factors)
      text += "," + quote_cell(value);
    for (const auto& value : row.responses) text += "," + to_number(value);
    text += "," + quote_cell(row.error) + "," + quote_cell(row.warnings);
  }
  return text;
}

ResponseRange find_range(const std::vector<study::StudyRow>& rows,
                         std::size_t response) {
  ResponseRange range;
  double sum = 0.0;
  for (const study::StudyRow& row : rows) {
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

StudyFindings find_findings(const study::Study& study, std::size_t runs,
                            const std::vector<study::StudyRow>& rows) {
  return {find_effects(study, runs, rows), find_correlations(study, rows)};
}

std::string to_text(const study::Study& study, std::size_t runs,
                    const std::vector<study::StudyRow>& rows,
                    const StudyFindings& findings) {
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
  text += describe_effects(study, runs, rows, findings.effects);
  text += describe_correlations(study, findings.correlations);
  text += describe_rows(rows, &study::StudyRow::error, "failed");
  text += describe_rows(rows, &study::StudyRow::warnings, "have warnings");
  return text;
}

Json to_json(const study::Study& study, std::size_t runs,
             const std::vector<study::StudyRow>& rows,
             const StudyFindings& findings) {
  Json json{{"study", study.file.string()},
            {"design", to_string(study.design.kind)},
            {"runs", runs},
            {"done", rows.size()},
            {"failed", list_rows(rows, &study::StudyRow::error).size()},
            {"warned", list_rows(rows, &study::StudyRow::warnings).size()},
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
    for (std::size_t f = 0; f < study.factors.size(); ++f) {
      const std::string& factor = study.factors[f].name;
      if (f < findings.effects.size() && findings.effects[f][r]) {
        one["effects"][factor] = to_json(study, *findings.effects[f][r]);
      }
      if (f < findings.correlations.size() && findings.correlations[f][r]) {
        one["correlations"][factor] = to_json(*findings.correlations[f][r]);
      }
    }
    json["responses"][study.responses[r].name] = one;
  }
  return json;
}

}  // namespace limber::app
