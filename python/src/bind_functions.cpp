// SPDX-License-Identifier: BSD-3-Clause
// Functions of time: factors of loads, and what drives follow.
#include "bindings.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/system/time_function.hpp"
#include "limber/joints/scalar/signal.hpp"

namespace limber::python {
namespace {

/// The entry of a list of (name, value).
template <typename Value>
Value choose(const char* kind, const std::string& name,
             const std::vector<std::pair<std::string, Value>>& values) {
  std::vector<std::string> known;
  for (const auto& [key, value] : values) {
    if (key == name) return value;
    known.push_back(key);
  }
  throw InputError(describe_unknown(kind, name, known));
}

dynamics::PulseShape parse_pulse(const std::string& name) {
  using dynamics::PulseShape;
  return choose<PulseShape>("shape of a pulse", name,
                            {{"rectangular", PulseShape::rectangular},
                             {"half-sine", PulseShape::half_sine},
                             {"triangular", PulseShape::triangular}});
}

joints::RampShape parse_ramp(const std::string& name) {
  using joints::RampShape;
  return choose<RampShape>("shape of a ramp", name,
                           {{"linear", RampShape::linear},
                            {"trapezoid", RampShape::trapezoid},
                            {"smooth", RampShape::smooth}});
}

/// [(fraction, delay [s]), ...]
using Shaper = std::vector<std::pair<double, double>>;

Shaper make_shaper(const std::string& kind, double frequency, double ratio) {
  using joints::ShaperKind;
  Shaper made;
  for (const joints::Impulse& one : joints::make_shaper(
           choose<ShaperKind>(
               "shaper", kind,
               {{"zv", ShaperKind::zv}, {"zvd", ShaperKind::zvd}}),
           frequency, ratio)) {
    made.emplace_back(one.fraction, one.delay);
  }
  return made;
}

void bind_factors(py::module_& m) {
  using namespace dynamics;
  py::class_<Constant>(m, "Constant",
                       "1 between two times [s], zero outside them.")
      .def(py::init([](double from, double until) {
             return Constant{from, until};
           }),
           py::arg("start") = 0.0, py::arg("until") = kNever);
  py::class_<StepSequence>(
      m, "StepSequence",
      "values[i] from times[i] [s] on; zero before the first, the last one "
      "without end.")
      .def(py::init([](std::vector<double> times, std::vector<double> values) {
             return StepSequence{std::move(times), std::move(values)};
           }),
           py::arg("times"), py::arg("values"));
  py::class_<Pulse>(m, "Pulse",
                    "A pulse of height 1: rectangular, half-sine or "
                    "triangular; start and duration in s.")
      .def(
          py::init([](double duration, double start, const std::string& shape) {
            return Pulse{parse_pulse(shape), start, duration};
          }),
          py::arg("duration"), py::arg("start") = 0.0,
          py::arg("shape") = "rectangular");
  py::class_<Sinusoid>(m, "Sinusoid",
                       "sin(2 pi frequency (t - start) + phase) between two "
                       "times [s]; frequency [Hz], phase [rad].")
      .def(py::init(
               [](double frequency, double phase, double from, double until) {
                 return Sinusoid{frequency, phase, from, until};
               }),
           py::arg("frequency"), py::arg("phase") = 0.0, py::arg("start") = 0.0,
           py::arg("until") = kNever);
  py::class_<Table>(m, "Table",
                    "Linear between points (times [s], values); zero outside "
                    "them.")
      .def(py::init([](std::vector<double> times, std::vector<double> values) {
             return Table{std::move(times), std::move(values)};
           }),
           py::arg("times"), py::arg("values"));
  py::class_<InputFunction>(
      m, "InputFunction",
      "factor times an input, which a controller writes (add_input).")
      .def(py::init([](const py::object& input, double factor) {
             return InputFunction{py::int_(input).cast<int>(), factor};
           }),
           py::arg("input"), py::arg("factor") = 1.0);
}

void bind_signals(py::module_& m) {
  using namespace joints;
  py::class_<ConstantSignal>(m, "ConstantSignal",
                             "The same value at all times.")
      .def(py::init([](double value) { return ConstantSignal{value}; }),
           py::arg("value"));
  py::class_<RampSignal>(
      m, "RampSignal",
      "From one value to another in `duration` [s]: linear, trapezoid (of the "
      "rate, which rises and falls for the fraction `rise` of the time) or "
      "smooth (10 s^3 - 15 s^4 + 6 s^5).")
      .def(py::init([](double from, double to, double duration, double start,
                       const std::string& shape, double rise) {
             return RampSignal{from, to, start, duration, parse_ramp(shape),
                               rise};
           }),
           py::arg("begin"), py::arg("end"), py::arg("duration"),
           py::arg("start") = 0.0, py::arg("shape") = "linear",
           py::arg("rise") = 0.25);
  py::class_<TableSignal>(m, "TableSignal",
                          "Linear between points (times [s], values), constant "
                          "outside them.")
      .def(py::init([](std::vector<double> times, std::vector<double> values) {
             return TableSignal{std::move(times), std::move(values)};
           }),
           py::arg("times"), py::arg("values"));
  py::class_<SineSignal>(m, "SineSignal",
                         "mean + amplitude sin(2 pi frequency (t - start) + "
                         "phase); frequency [Hz], phase [rad].")
      .def(py::init([](double amplitude, double frequency, double mean,
                       double phase, double start) {
             return SineSignal{mean, amplitude, frequency, phase, start};
           }),
           py::arg("amplitude"), py::arg("frequency"), py::arg("mean") = 0.0,
           py::arg("phase") = 0.0, py::arg("start") = 0.0);
  py::class_<InputSignal>(
      m, "InputSignal",
      "factor times an input, which a controller writes (add_input).")
      .def(py::init([](const py::object& input, double factor) {
             return InputSignal{py::int_(input).cast<int>(), factor};
           }),
           py::arg("input"), py::arg("factor") = 1.0);
  using Base = std::variant<ConstantSignal, RampSignal, TableSignal, SineSignal,
                            InputSignal>;
  py::class_<Signal>(
      m, "Signal",
      "A signal shaped by impulses [(fraction, delay [s]), ...]: "
      "the sum of fraction * base(t - delay).")
      .def(py::init([](const Base& base, const Shaper& shaper) {
             Signal signal{base, {}};
             for (const auto& [fraction, delay] : shaper) {
               signal.shaper.push_back({fraction, delay});
             }
             check(signal);
             return signal;
           }),
           py::arg("base"), py::arg("shaper") = Shaper{{1.0, 0.0}});
  m.def(
      "make_shaper", &make_shaper, py::arg("kind"), py::arg("frequency"),
      py::arg("ratio") = 0.0,
      "Impulses [(fraction, delay [s]), ...] that leave no residual vibration "
      "of a mode of that natural frequency [Hz] and damping ratio: 'zv' or "
      "'zvd'.");
}

}  // namespace

void bind_functions(py::module_& m) {
  bind_factors(m);
  bind_signals(m);
}

}  // namespace limber::python
