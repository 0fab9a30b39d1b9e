// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/controller_reader.hpp"

#include <fmt/format.h>

#include <cmath>

namespace limber::scene {
namespace {

using dynamics::InputHold;
using dynamics::PidParameters;

/// A number, or a table as drives have.
joints::Signal read_reference(TomlTable& table, const SignalContext& context) {
  if (!table.is_table("reference")) {
    const double value = table.number("reference").value_or(0.0);
    return {.base = joints::ConstantSignal{value}};
  }
  TomlTable given(*table.table("reference"), table.path() + " reference",
                  table.problems());
  return read_base_signal(given, context);
}

void read_limits(TomlTable& table, PidParameters& pid) {
  const auto limits = table.numbers("limits");
  if (!limits) return;
  if (limits->size() != 2) {
    table.fail("limits", fmt::format("has {} numbers; expected the lower and "
                                     "the upper one",
                                     limits->size()));
    return;
  }
  pid.lower = (*limits)[0];
  pid.upper = (*limits)[1];
}

std::size_t read_delay(TomlTable& table, double period) {
  constexpr double kMostSamples = 1e5;  // of memory
  constexpr double kSame = 1e-6;        // of a period
  const double delay = table.number("delay", kNonNegative).value_or(0.0);
  const double samples = std::round(delay / period);
  if (!table.problems().empty() || delay == 0.0) return 0;
  if (std::abs(delay / period - samples) > kSame || samples > kMostSamples) {
    table.fail("delay",
               fmt::format("is {:g} periods; expected a whole number, at most "
                           "{:g}",
                           delay / period, kMostSamples));
    return 0;
  }
  return static_cast<std::size_t>(samples);
}

PidParameters read_pid(TomlTable& table, const SignalContext& context) {
  PidParameters pid;
  pid.period = table.required_number("period", kPositive);
  pid.reference = read_reference(table, context);
  pid.proportional = table.number("proportional").value_or(0.0);
  pid.integral = table.number("integral").value_or(0.0);
  pid.derivative = table.number("derivative").value_or(0.0);
  pid.filter_time = table.number("filter", kNonNegative).value_or(0.0);
  pid.delay = read_delay(table, pid.period);
  read_limits(table, pid);
  pid.initial = table.number("initial").value_or(0.0);
  return pid;
}

}  // namespace

std::vector<std::string> list_controllers(TomlTable& root) {
  std::vector<std::string> names;
  if (!root.is_array("controller")) return names;  // told where they are read
  for (const toml::table* table : root.tables("controller")) {
    names.push_back((*table)["name"].value_or(std::string()));
  }
  return names;
}

ControllerSpec read_controller(TomlTable& table, const SignalContext& context) {
  ControllerSpec spec;
  spec.name = table.required_text("name");
  spec.measures = table.required_text("measures");
  spec.rate = table.text("rate").value_or("");
  spec.pid = read_pid(table, context);
  spec.pid.has_rate = !spec.rate.empty();
  spec.offset = table.number("offset").value_or(0.0);
  spec.hold = read_choice<InputHold>(
      table, "hold", {{"held", InputHold::held}, {"linear", InputHold::linear}},
      spec.hold);
  if (!table.problems().empty()) return spec;
  try {
    (void)dynamics::PidController(spec.pid);
  } catch (const InputError& error) {
    for (const std::string& problem : error.problems()) table.fail(problem);
  }
  return spec;
}

}  // namespace limber::scene
