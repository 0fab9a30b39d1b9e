// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/time_function_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/flexbody/modal/fourier.hpp"
#include "limber/scene/text/points_reader.hpp"

namespace limber::scene {
namespace {

// Input common to all kinds.
struct Source {
  TomlTable& table;
  const SignalContext& context;
  std::vector<std::string>& warnings;
};
using Reader = std::function<dynamics::TimeFunction(Source&)>;

dynamics::TimeFunction read_constant(Source& source) {
  TomlTable& table = source.table;
  dynamics::Constant function;
  function.from = table.number("from").value_or(function.from);
  function.until = table.number("until").value_or(function.until);
  return function;
}

std::vector<double> required_numbers(TomlTable& table, const std::string& key) {
  if (!table.has(key)) table.fail("needs '" + key + "', an array of numbers");
  return table.numbers(key).value_or(std::vector<double>{});
}

dynamics::TimeFunction read_steps(Source& source) {
  const Series points = read_points(source.table, source.context.folder);
  return dynamics::StepSequence{points.times, points.values};
}

dynamics::TimeFunction read_table(Source& source) {
  const Series points = read_points(source.table, source.context.folder);
  return dynamics::Table{points.times, points.values};
}

dynamics::TimeFunction read_pulse(Source& source) {
  TomlTable& table = source.table;
  using dynamics::PulseShape;
  dynamics::Pulse pulse;
  pulse.shape =
      read_choice<PulseShape>(table, "shape",
                              {{"rectangular", PulseShape::rectangular},
                               {"half-sine", PulseShape::half_sine},
                               {"triangular", PulseShape::triangular}},
                              PulseShape::rectangular);
  pulse.start = table.number("start").value_or(0.0);
  pulse.duration = table.required_number("duration", kPositive);
  return pulse;
}

dynamics::TimeFunction read_sinusoid(Source& source) {
  TomlTable& table = source.table;
  dynamics::Sinusoid function;
  function.frequency = table.required_number("frequency", kPositive);
  function.phase = table.number("phase").value_or(0.0);
  function.from = table.number("from").value_or(function.from);
  function.until = table.number("until").value_or(function.until);
  return function;
}

dynamics::TimeFunction read_sinusoids(Source& source) {
  TomlTable& table = source.table;
  dynamics::HarmonicSum sum;
  sum.mean = table.number("mean").value_or(0.0);
  sum.from = table.number("from").value_or(sum.from);
  sum.until = table.number("until").value_or(sum.until);
  const std::vector<double> frequencies =
      required_numbers(table, "frequencies");
  const std::vector<double> amplitudes = required_numbers(table, "amplitudes");
  const std::vector<double> phases =
      table.numbers("phases").value_or(std::vector(frequencies.size(), 0.0));
  if (amplitudes.size() != frequencies.size() ||
      phases.size() != frequencies.size()) {
    table.fail(fmt::format(
        "{} frequencies, {} amplitudes, {} phases; expected as many of each",
        frequencies.size(), amplitudes.size(), phases.size()));
    return sum;
  }
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    sum.terms.push_back({.omega = 2.0 * std::numbers::pi * frequencies[i],
                         .cosine = amplitudes[i] * std::sin(phases[i]),
                         .sine = amplitudes[i] * std::cos(phases[i])});
  }
  return sum;
}

// Misfit that gives a warning, relative to the table's largest value.
constexpr double kReportedMisfit = 0.01;

dynamics::HarmonicSum to_sum(const flexbody::FourierSeries& series) {
  dynamics::HarmonicSum sum;
  sum.mean = series.cosine(0, 0);
  sum.from = series.start;
  const double omega = 2.0 * std::numbers::pi / series.period;
  for (Eigen::Index k = 1; k < series.cosine.cols(); ++k) {
    sum.terms.push_back({.omega = static_cast<double>(k) * omega,
                         .cosine = series.cosine(0, k),
                         .sine = series.sine(0, k)});
  }
  return sum;
}

// A measured load is zero outside its table, unless `until` extends it.
dynamics::TimeFunction read_fourier(Source& source) {
  TomlTable& table = source.table;
  const Series points = read_points(source.table, source.context.folder);
  const auto harmonics = table.integer("harmonics", 0, 100000);
  const auto until = table.number("until");
  if (!harmonics) {
    if (!table.has("harmonics")) table.fail("needs 'harmonics'");
    return dynamics::Constant{};
  }
  if (points.times.size() != points.values.size()) {
    table.fail(fmt::format("{} times but {} values", points.times.size(),
                           points.values.size()));
    return dynamics::Constant{};
  }
  try {
    const Eigen::Map<const Eigen::RowVectorXd> values(
        points.values.data(), std::ssize(points.values));
    const flexbody::FourierSeries series =
        flexbody::fit_fourier_series({points.times, values}, *harmonics);
    const double largest = values.cwiseAbs().maxCoeff();
    if (series.residual[0] > kReportedMisfit * largest) {
      source.warnings.push_back(fmt::format(
          "{}: {} harmonics miss {:.3g} (root mean square) of the table, "
          "whose largest value is {:.3g}",
          table.path(), *harmonics, series.residual[0], largest));
    }
    dynamics::HarmonicSum sum = to_sum(series);
    sum.until = until.value_or(series.start + series.period);
    return sum;
  } catch (const InputError& error) {
    for (const std::string& problem : error.problems()) table.fail(problem);
  }
  return dynamics::Constant{};
}

dynamics::TimeFunction read_input(Source& source) {
  const joints::InputSignal signal =
      read_input_signal(source.table, source.context.controllers);
  return dynamics::InputFunction{signal.input, signal.factor};
}

}  // namespace

dynamics::TimeFunction read_time_function(TomlTable& table,
                                          const SignalContext& context,
                                          std::vector<std::string>& warnings) {
  if (!table.has("kind")) table.fail("needs 'kind'");
  const Reader reader = read_choice<Reader>(table, "kind",
                                            {{"constant", read_constant},
                                             {"steps", read_steps},
                                             {"pulse", read_pulse},
                                             {"sinusoid", read_sinusoid},
                                             {"sinusoids", read_sinusoids},
                                             {"fourier", read_fourier},
                                             {"table", read_table},
                                             {"input", read_input}},
                                            nullptr);
  if (!reader) return dynamics::Constant{};
  Source source{table, context, warnings};
  dynamics::TimeFunction function = reader(source);
  table.finish();
  if (!table.problems().empty()) return function;
  try {
    dynamics::check(function);
  } catch (const InputError& error) {
    table.fail(error.problems().front());
  }
  return function;
}

}  // namespace limber::scene
