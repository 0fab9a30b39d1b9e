// SPDX-License-Identifier: BSD-3-Clause
#include "scene/time_function_reader.hpp"

#include <functional>

namespace limber::scene {
namespace {

using Reader = std::function<dynamics::TimeFunction(TomlTable&)>;

dynamics::TimeFunction read_constant(TomlTable& table) {
  dynamics::Constant function;
  function.from = table.number("from").value_or(function.from);
  function.until = table.number("until").value_or(function.until);
  return function;
}

std::vector<double> required_numbers(TomlTable& table, const std::string& key) {
  if (!table.has(key)) table.fail("needs '" + key + "', an array of numbers");
  return table.numbers(key).value_or(std::vector<double>{});
}

dynamics::TimeFunction read_steps(TomlTable& table) {
  return dynamics::StepSequence{required_numbers(table, "times"),
                                required_numbers(table, "values")};
}

dynamics::TimeFunction read_table(TomlTable& table) {
  return dynamics::Table{required_numbers(table, "times"),
                         required_numbers(table, "values")};
}

dynamics::TimeFunction read_pulse(TomlTable& table) {
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

dynamics::TimeFunction read_sinusoid(TomlTable& table) {
  dynamics::Sinusoid function;
  function.frequency = table.required_number("frequency", kPositive);
  function.phase = table.number("phase").value_or(0.0);
  function.from = table.number("from").value_or(function.from);
  function.until = table.number("until").value_or(function.until);
  return function;
}

}  // namespace

dynamics::TimeFunction read_time_function(TomlTable& table) {
  if (!table.has("kind")) table.fail("needs 'kind'");
  const Reader reader = read_choice<Reader>(table, "kind",
                                            {{"constant", read_constant},
                                             {"steps", read_steps},
                                             {"pulse", read_pulse},
                                             {"sinusoid", read_sinusoid},
                                             {"table", read_table}},
                                            nullptr);
  if (!reader) return dynamics::Constant{};
  dynamics::TimeFunction function = reader(table);
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
