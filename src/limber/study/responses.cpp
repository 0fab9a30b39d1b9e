// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/responses.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/runs/probe_columns.hpp"
#include "limber/runs/stress_peaks.hpp"
#include "limber/study/curve_measures.hpp"
#include "limber/study/design.hpp"

namespace limber::study {
namespace {

using Json = nlohmann::ordered_json;

using Parts = std::vector<std::string>;
using Value = std::optional<double>;

// Lists whose length is known only after a run.
bool is_open_list(const Json& node) { return node.is_array(); }

Parts split_response(const std::string& path) {
  return scene::split_path(path);
}

std::string join(const Parts& parts, std::size_t from, std::size_t count) {
  std::string text = parts[from];
  for (std::size_t i = 1; i < count; ++i) text += "." + parts[from + i];
  return text;
}

const Json* find_entry(const Json& list, const std::string& part) {
  const auto index = scene::to_index(part);
  if (index && *index < list.size()) return &list[*index];
  for (const Json& entry : list) {
    if (!entry.is_object()) continue;
    for (const char* key : {"name", "body"}) {
      const auto name = entry.find(key);
      if (name != entry.end() && *name == part) return &entry;
    }
  }
  return nullptr;
}

struct Found {
  const Json* node = nullptr;  ///< the last one that is there
  std::size_t depth = 0;       ///< parts that lead to it
};

/// Keys may have dots of their own ("tip.x"): the longest comes first.
Found find_path(const Json& root, const Parts& parts) {
  Found found{&root, 0};
  while (found.depth < parts.size()) {
    const Json* next = nullptr;
    std::size_t count =
        found.node->is_object() ? parts.size() - found.depth : 1;
    for (; count > 0; --count) {
      const std::string key = join(parts, found.depth, count);
      if (found.node->is_array()) {
        next = find_entry(*found.node, key);
      } else if (found.node->contains(key)) {
        next = &found.node->at(key);
      }
      if (next != nullptr) break;
    }
    if (next == nullptr) return found;
    found = {next, found.depth + count};
  }
  return found;
}

Value to_number(const Json& node) {
  if (node.is_boolean()) return node.get<bool>() ? 1.0 : 0.0;
  if (!node.is_number()) return std::nullopt;
  return node.get<double>();
}

/// "finger.2" is the second shape of the body "finger".
std::string strip_number(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || !scene::to_index(name.substr(dot + 1))) {
    return name;
  }
  return name.substr(0, dot);
}

bool is_of(const ContactResponse& contact, const std::string& pair) {
  for (std::size_t at = pair.find('/'); at != std::string::npos;
       at = pair.find('/', at + 1)) {
    const std::string left = pair.substr(0, at);
    const std::string right = pair.substr(at + 1);
    for (const auto& [a, b] :
         {std::pair(left, right),
          std::pair(strip_number(left), strip_number(right))}) {
      if (a == contact.first && b == contact.second) return true;
      if (b == contact.first && a == contact.second) return true;
    }
  }
  return false;
}

double calc_rms(const results::History& history, std::size_t column) {
  const auto& times = history.times;
  if (times.size() < 2) return std::abs(history.probe_rows.back()[column]);
  double sum = 0.0;
  double a = history.probe_rows.front()[column];
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double b = history.probe_rows[i][column];
    sum += 0.5 * (times[i] - times[i - 1]) * (a * a + b * b);
    a = b;
  }
  return std::sqrt(sum / (times.back() - times.front()));
}

std::vector<double> list_samples(const results::History& history,
                                 std::size_t column) {
  std::vector<double> values;
  for (const auto& row : history.probe_rows) values.push_back(row[column]);
  return values;
}

/// Derivatives of a column to an acceleration; 0: it has none.
int find_order(const results::ProbeColumn& column) {
  if (column.unit == "m" || column.unit == "rad") return 2;
  return column.unit == "m/s" || column.unit == "rad/s" ? 1 : 0;
}

/// Finds the responses of one run.
class Evaluation {
 public:
  /// @param own that of the responses without a level
  Evaluation(const runs::Run& run, const runs::Run& own,
             const Summarize& summarize)
      : run_(run), own_(own), summarize_(summarize) {}

  Value operator()(const ProbeResponse& probe) const {
    const auto& columns = run_.history.columns;
    const auto found =
        std::find_if(columns.begin(), columns.end(),
                     [&](const auto& c) { return c.name == probe.column; });
    if (found == columns.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(found - columns.begin());
    switch (probe.measure) {
      case Measure::peak:
        return run_.record.peaks.at(i).value;
      case Measure::time:
        return run_.record.peaks.at(i).time;
      case Measure::final:
        return run_.history.probe_rows.back()[i];
      case Measure::rms:
        return calc_rms(run_.history, i);
      case Measure::difference:
        return find_difference(i);
      default:
        return measure_curve(i, probe.measure);
    }
  }

  Value operator()(const ContactResponse& contact) const {
    double sum = 0.0;
    double most = 0.0;
    for (const dynamics::ContactRecord& record : run_.record.contacts) {
      if (!is_of(contact, record.pair)) continue;
      sum += record.impulse;
      most = std::max(most, record.peak_force);
    }
    return contact.is_impulse ? sum : most;
  }

  Value operator()(const SummaryResponse& summary) {
    if (!json_) json_ = summarize_(run_);
    const Parts parts = split_response(summary.path);
    const Found found = find_path(*json_, parts);
    if (found.depth == parts.size()) {
      if (!found.node->is_primitive() || found.node->is_string()) {
        throw InputError(
            fmt::format("'{}' of the summary is not a number", summary.path));
      }
      return to_number(*found.node);
    }
    // Such as the second of one impact, or the row of a pair without any.
    if (found.node->is_array()) return std::nullopt;
    throw InputError(fmt::format("'{}': the summary has no '{}' there",
                                 summary.path, parts[found.depth]));
  }

  Value operator()(const ExpressionResponse&) const { return std::nullopt; }

 private:
  [[nodiscard]] Value find_difference(std::size_t column) const {
    const auto& rows = run_.history.probe_rows;
    const auto& own = own_.history.probe_rows;
    if (rows.size() != own.size()) return std::nullopt;
    double most = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      most = std::max(most, std::abs(rows[i][column] - own[i][column]));
    }
    return most;
  }

  [[nodiscard]] Value measure_curve(std::size_t column, Measure measure) const {
    const std::vector<double>& times = run_.history.times;
    const std::vector<double> values = list_samples(run_.history, column);
    switch (measure) {
      case Measure::overshoot:
        return find_overshoot(times, values);
      case Measure::settling_time:
        return find_settling_time(times, values);
      case Measure::frequency:
        return find_dominant_frequency(times, values);
      default:
        return find_largest_derivative(
            times, values, find_order(run_.history.columns[column]));
    }
  }

  const runs::Run& run_;
  const runs::Run& own_;
  const Summarize& summarize_;
  std::optional<Json> json_;
};

/// A formula's value with these variables; none if it uses one without value.
Value evaluate(const std::string& formula, std::map<std::string, Value> known) {
  std::map<std::string, double> values;
  for (const auto& [name, value] : known) values[name] = value.value_or(NAN);
  mu::Parser parser;
  for (auto& [name, value] : values) parser.DefineVar(name, &value);
  parser.SetExpr(formula);
  for (const auto& [name, address] : parser.GetUsedVar()) {
    const auto found = known.find(name);
    if (found != known.end() && !found->second) return std::nullopt;
  }
  const double value = parser.Eval();
  return std::isfinite(value) ? Value(value) : std::nullopt;
}

Parts list_variables(const Study& study, std::size_t response) {
  Parts names;
  for (const Factor& factor : study.factors) names.push_back(factor.name);
  for (std::size_t i = 0; i < response; ++i) {
    names.push_back(study.responses[i].name);
  }
  return names;
}

/// Describes the error of one response; empty if it is valid.
class Check {
 public:
  Check(const Study& study, const scene::Scene& scene, const runs::Run& start,
        const Summarize& summarize)
      : study_(study), scene_(scene), start_(start), summarize_(summarize) {}

  void set_index(std::size_t index) { index_ = index; }

  std::string operator()(const ProbeResponse& probe) const {
    Parts known;
    for (const auto& column : start_.history.columns) {
      known.push_back(column.name);
      const bool has_none = probe.measure == Measure::acceleration &&
                            column.name == probe.column &&
                            find_order(column) == 0;
      if (has_none) {
        return fmt::format(
            "'{}' has the unit '{}': an acceleration needs a position, an "
            "angle or a velocity",
            column.name, column.unit);
      }
    }
    return find_unknown("column of a probe", probe.column, known);
  }

  std::string operator()(const ContactResponse& contact) const {
    Parts known;
    for (const scene::TouchingPair& pair : scene_.touching) {
      const auto a = name_of(pair.A);
      const auto b = name_of(pair.B);
      if (is_of(contact, a + "/" + b)) return "";
      known.push_back(a + "/" + b);
    }
    return describe_unknown("contact", contact.first + "/" + contact.second,
                            known);
  }

  std::string operator()(const SummaryResponse& summary) const {
    const Json json = summarize_(start_);
    const Parts parts = split_response(summary.path);
    const Found found = find_path(json, parts);
    if (found.depth == parts.size()) {
      return found.node->is_number() || found.node->is_boolean() ||
                     found.node->is_null()
                 ? ""
                 : fmt::format("'{}' of the summary is not a number",
                               summary.path);
    }
    if (is_open_list(*found.node)) return "";
    Parts known;
    if (found.node->is_object()) {
      for (const auto& [key, node] : found.node->items()) known.push_back(key);
    }
    return describe_unknown(
        "figure of the summary",
        join(parts, found.depth, parts.size() - found.depth), known);
  }

  std::string operator()(const ExpressionResponse& expression) const {
    const Parts known = list_variables(study_, index_);
    try {
      std::map<std::string, double> values;
      for (const std::string& name : known) values[name] = 1.0;
      mu::Parser parser;
      parser.SetExpr(expression.formula);
      for (const auto& [name, address] : parser.GetUsedVar()) {
        if (!values.contains(name)) {
          return describe_unknown("variable of a formula", name, known);
        }
      }
      for (auto& [name, value] : values) parser.DefineVar(name, &value);
      parser.Eval();
      return parser.GetNumResults() == 1 ? "" : "a formula has one value";
    } catch (const mu::ParserError& error) {
      return fmt::format("'{}': {}", expression.formula, error.GetMsg());
    }
  }

 private:
  static std::string find_unknown(const char* kind, const std::string& name,
                                  const Parts& known) {
    const bool is_known =
        std::find(known.begin(), known.end(), name) != known.end();
    return is_known ? "" : describe_unknown(kind, name, known);
  }

  [[nodiscard]] std::string name_of(const scene::Toucher& side) const {
    return side.is_obstacle ? scene_.scenario.obstacles[side.index].name
                            : scene_.robot.links[side.index].name;
  }

  const Study& study_;
  const scene::Scene& scene_;
  const runs::Run& start_;
  const Summarize& summarize_;
  std::size_t index_ = 0;
};

/// A run with its start only, for the names in its summary.
runs::Run make_start(const scene::Scene& scene,
                     const scene::BuiltScene& built) {
  runs::Run run;
  run.scene = scene;
  run.built = built;
  run.history.columns = runs::list_columns(built.probes);
  run.history.times = {0.0};
  run.history.probe_rows = {
      scene::evaluate_all(built.probes, built.model, built.initial)};
  run.history.states = {built.initial};
  run.history.energies = {calc_energy(built.model, built.initial)};
  run.record = runs::record_state(built, built.initial);
  return run;
}

}  // namespace

void check_responses(const Study& study, const scene::Scene& scene,
                     const scene::BuiltScene& built,
                     const Summarize& summarize) {
  const runs::Run start = make_start(scene, built);
  Check check(study, scene, start, summarize);
  Parts problems;
  for (std::size_t i = 0; i < study.responses.size(); ++i) {
    check.set_index(i);
    const std::string problem = std::visit(check, study.responses[i].source);
    if (problem.empty()) continue;
    problems.push_back(fmt::format("{}: response '{}': {}", study.file.string(),
                                   study.responses[i].name, problem));
  }
  if (!problems.empty()) throw InputError(problems);
}

bool needs_levels(const Study& study) {
  return std::any_of(
      study.responses.begin(), study.responses.end(),
      [](const Response& response) {
        const auto* summary = std::get_if<SummaryResponse>(&response.source);
        return summary != nullptr && summary->path.starts_with("levels");
      });
}

std::vector<dynamics::Fidelity> list_levels(const Study& study) {
  std::vector<dynamics::Fidelity> levels;
  for (const Response& response : study.responses) {
    if (!response.level) continue;
    if (std::find(levels.begin(), levels.end(), *response.level) ==
        levels.end()) {
      levels.push_back(*response.level);
    }
  }
  return levels;
}

ResponseValues evaluate_run(const Study& study, const runs::Run& run,
                            const std::vector<runs::Run>& at_levels,
                            const Summarize& summarize) {
  const std::vector<dynamics::Fidelity> levels = list_levels(study);
  Evaluation own(run, run, summarize);
  std::vector<Evaluation> others;
  for (const runs::Run& other : at_levels) {
    others.emplace_back(other, run, summarize);
  }
  ResponseValues values;
  for (const Response& response : study.responses) {
    const auto level = std::find(levels.begin(), levels.end(), response.level);
    Evaluation& evaluation =
        response.level
            ? others.at(static_cast<std::size_t>(level - levels.begin()))
            : own;
    Value value = std::visit(evaluation, response.source);
    if (value && !std::isfinite(*value)) value.reset();
    values.push_back(value);
  }
  return values;
}

void evaluate_formulas(const Study& study,
                       const std::vector<std::string>& factors,
                       ResponseValues& values) {
  std::map<std::string, Value> known;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    known[study.factors[f].name] = find_number(factors[f]);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Response& response = study.responses[i];
    if (const auto* formula =
            std::get_if<ExpressionResponse>(&response.source)) {
      values[i] = evaluate(formula->formula, known);
    }
    known[response.name] = values[i];
  }
}

}  // namespace limber::study
