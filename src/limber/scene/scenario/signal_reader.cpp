// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/signal_reader.hpp"

#include <algorithm>

#include "limber/scene/text/points_reader.hpp"

namespace limber::scene {
namespace {

using Base = decltype(joints::Signal::base);
using BaseReader = Base (*)(TomlTable&, const SignalContext&);

Base read_constant_base(TomlTable& table, const SignalContext& /*context*/) {
  return joints::ConstantSignal{table.required_number("value")};
}

Base read_ramp(TomlTable& table, const SignalContext& /*context*/) {
  using joints::RampShape;
  joints::RampSignal ramp;
  ramp.from = table.number("from").value_or(ramp.from);
  ramp.to = table.required_number("to");
  ramp.start = table.number("start").value_or(ramp.start);
  ramp.duration = table.required_number("duration", kPositive);
  ramp.shape = read_choice<RampShape>(table, "shape",
                                      {{"linear", RampShape::linear},
                                       {"trapezoid", RampShape::trapezoid},
                                       {"smooth", RampShape::smooth}},
                                      ramp.shape);
  const Range fraction{0.0, 0.5, true, false};
  ramp.rise = table.number("rise", fraction).value_or(ramp.rise);
  if (table.has("rise") && ramp.shape != RampShape::trapezoid) {
    table.fail("rise", "applies only to shape 'trapezoid'");
  }
  return ramp;
}

Base read_table_base(TomlTable& table, const SignalContext& context) {
  Series points = read_points(table, context.folder);
  return joints::TableSignal{std::move(points.times), std::move(points.values)};
}

Base read_sine(TomlTable& table, const SignalContext& /*context*/) {
  joints::SineSignal sine;
  sine.mean = table.number("mean").value_or(sine.mean);
  sine.amplitude = table.required_number("amplitude");
  sine.frequency = table.required_number("frequency", kPositive);
  sine.phase = table.number("phase").value_or(sine.phase);
  sine.start = table.number("start").value_or(sine.start);
  return sine;
}

Base read_input_base(TomlTable& table, const SignalContext& context) {
  return read_input_signal(table, context.controllers);
}

Base read_signal_base(TomlTable& table, const SignalContext& context) {
  if (!table.has("kind")) table.fail("needs 'kind'");
  const BaseReader reader =
      read_choice<BaseReader>(table, "kind",
                              {{"constant", read_constant_base},
                               {"ramp", read_ramp},
                               {"table", read_table_base},
                               {"sine", read_sine},
                               {"input", read_input_base}},
                              nullptr);
  if (reader == nullptr) return {};
  Base base = reader(table, context);
  table.finish();
  return base;
}

std::vector<joints::Impulse> read_shaper(TomlTable& table) {
  using joints::ShaperKind;
  if (!table.has("kind")) table.fail("needs 'kind', 'zv' or 'zvd'");
  const ShaperKind kind = read_choice<ShaperKind>(
      table, "kind", {{"zv", ShaperKind::zv}, {"zvd", ShaperKind::zvd}},
      ShaperKind::zv);
  const double frequency = table.required_number("frequency", kPositive);
  const Range below_one{0.0, 1.0, false, true};
  const auto ratio = table.number("damping_ratio", below_one);
  table.finish();
  return joints::make_shaper(kind, frequency, ratio.value_or(0.0));
}

}  // namespace

joints::InputSignal read_input_signal(
    TomlTable& table, const std::vector<std::string>& controllers) {
  joints::InputSignal signal;
  signal.factor = table.number("factor").value_or(signal.factor);
  const std::string name = table.required_text("controller");
  const auto found = std::find(controllers.begin(), controllers.end(), name);
  signal.input = static_cast<int>(found - controllers.begin());
  if (found == controllers.end() && !name.empty()) {
    table.fail("controller",
               describe_unknown("[[controller]]", name, controllers));
  }
  return signal;
}

joints::Signal read_base_signal(TomlTable& table,
                                const SignalContext& context) {
  return {.base = read_signal_base(table, context)};
}

joints::Signal read_signal(TomlTable& drive, const SignalContext& context) {
  joints::Signal signal;
  const toml::table* base = drive.table("signal");
  const toml::table* shaper = drive.table("shaper");
  if (base == nullptr) {
    if (!drive.has("signal")) drive.fail("needs 'signal'");
  } else {
    TomlTable table(*base, drive.path() + " signal", drive.problems());
    signal.base = read_signal_base(table, context);
  }
  if (shaper != nullptr) {
    TomlTable table(*shaper, drive.path() + " shaper", drive.problems());
    signal.shaper = read_shaper(table);
  }
  return signal;
}

}  // namespace limber::scene
