// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/compare/comparison_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/common/percent.hpp"

namespace limber::runs {
namespace {

const std::vector<std::string>& measure_names() {
  static const std::vector<std::string> names = {"displacement", "deformation",
                                                 "both"};
  return names;
}

std::optional<double> finite_error_of(const ComparedRun& run,
                                      ErrorMeasure measure) {
  if (!run.error) return std::nullopt;
  const auto error = find_error(run.error->error, measure);
  return error && std::isfinite(*error) ? error : std::nullopt;
}

}  // namespace

ErrorMeasure parse_error_measure(const std::string& name) {
  const auto& names = measure_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError("--measure: " + describe_unknown("measure", name, names));
  }
  return static_cast<ErrorMeasure>(found - names.begin());
}

std::string to_string(ErrorMeasure measure) {
  return measure_names()[static_cast<std::size_t>(measure)];
}

double parse_tolerance(const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(
        fmt::format("--tolerance: '{}' {}; expected a fraction between 0 and "
                    "1, for example 1% or 0.01",
                    echo(text), why));
  };
  std::string_view number = text;
  const bool is_percent = number.ends_with('%');
  if (is_percent) number.remove_suffix(1);
  while (number.ends_with(' ')) number.remove_suffix(1);
  const std::optional<double> given = parse_number(number);
  if (!given) refuse("is not a finite number");
  const double value = is_percent ? *given / 100.0 : *given;
  if (!(value > 0.0) || !(value < 1.0)) {
    refuse(fmt::format("is {:g} %", 100.0 * value));
  }
  return value;
}

std::optional<double> find_error(const results::MotionError& error,
                                 ErrorMeasure measure) {
  const auto displacement = error.displacement.relative();
  const auto deformation = error.deformation.relative();
  if (measure == ErrorMeasure::displacement && displacement) {
    return displacement;
  }
  if (measure == ErrorMeasure::deformation && deformation) return deformation;
  // None is less than any number.
  const auto worse = std::max(displacement, deformation);
  return worse ? worse : error.rigid.relative();
}

const ComparedRun* find_cheapest(const Comparison& comparison,
                                 const Demand& demand) {
  const ComparedRun* cheapest = nullptr;
  for (const ComparedRun& run : comparison.runs) {
    const auto error = finite_error_of(run, demand.measure);
    if (!error || *error > demand.tolerance) continue;
    if (cheapest == nullptr || run.cost.online < cheapest->cost.online) {
      cheapest = &run;
    }
  }
  return cheapest;
}

void refuse(const Comparison& comparison, const Demand& demand) {
  const ComparedRun* closest = nullptr;
  double least = 0.0;
  for (const ComparedRun& run : comparison.runs) {
    const auto error = finite_error_of(run, demand.measure);
    if (!error || (closest != nullptr && *error >= least)) continue;
    closest = &run;
    least = *error;
  }
  const std::string what = demand.measure == ErrorMeasure::both
                               ? "an error"
                               : "a " + to_string(demand.measure) + " error";
  if (closest == nullptr) {
    throw NumericalError(
        fmt::format("no run has an error to compare with the tolerance of {}",
                    to_percent(demand.tolerance)));
  }
  throw NumericalError(fmt::format(
      "no run meets the tolerance of {}; '{}' comes closest with {} of {}. "
      "More modes, other sources or a shorter step may help",
      to_percent(demand.tolerance), describe(closest->choice), what,
      to_percent(least)));
}

}  // namespace limber::runs
