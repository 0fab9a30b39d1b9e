// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "interruption.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/dynamics/simulation/simulator.hpp"
#include "recorded_run.hpp"

namespace limber::python {
namespace {

using namespace dynamics;
using ModelPointer = std::shared_ptr<SystemModel>;

SimulationSettings make_settings(double end_time, double step,
                                 const std::vector<double>& output_times,
                                 const std::string& integrator,
                                 double tolerance, double rho_inf,
                                 double newton_tolerance, int newton_iterations,
                                 bool exact_modes,
                                 std::optional<bool> verified) {
  SimulationSettings settings;
  settings.integrator = parse_integrator(integrator);
  settings.end_time = end_time;
  settings.step = step;
  settings.output_times = output_times;
  settings.tolerance = tolerance;
  settings.rho_inf = rho_inf;
  settings.newton_tolerance = newton_tolerance;
  settings.newton_iterations = newton_iterations;
  settings.exact_modes = exact_modes;
  if (verified) {
    settings.passes =
        *verified ? TolerancePasses::verified : TolerancePasses::one;
  }
  return settings;
}

std::shared_ptr<RecordedRun> simulate(const SystemModel& model,
                                      const SystemState& start,
                                      const SimulationSettings& settings,
                                      const std::vector<scene::Probe>& probes,
                                      const py::object& progress) {
  clear_cause();
  const Progress watch = make_watch(progress);
  auto recorded = std::make_shared<RecordedRun>();
  {
    const py::gil_scoped_release release;
    scene::BuiltScene built;
    built.model = model;
    built.initial = start;
    built.settings = settings;
    built.probes = probes;
    for (scene::Probe& probe : built.probes) set_start(probe, model, start);
    runs::RunOptions options;
    options.progress = watch;
    recorded->run = runs::simulate_built({}, std::move(built), options);
  }
  recorded->cause = take_cause();
  return recorded;
}

/// A Simulator with the model that it refers to.
class OwningSimulator {
 public:
  OwningSimulator(ModelPointer model, const SystemState& start,
                  const SimulationSettings& settings)
      : model_(std::move(model)), simulator_(*model_, start, settings) {}

  void advance_to(double t) {
    clear_cause();
    const py::gil_scoped_release release;
    SignalWatch signals;
    bool is_stopped = false;
    (void)simulator_.advance_to(t, [&] {
      is_stopped = is_stopped || signals();
      return is_stopped;
    });
    if (is_stopped) throw Interrupted("interrupted");
  }

  [[nodiscard]] SystemState state() const { return simulator_.state(); }
  [[nodiscard]] EnergyBalance energy() const {
    return simulator_.calc_energy();
  }
  [[nodiscard]] const SimulationStatistics& statistics() const {
    return simulator_.statistics();
  }
  [[nodiscard]] Checkpoint save() { return simulator_.save(); }
  void restore(const Checkpoint& checkpoint) { simulator_.restore(checkpoint); }

 private:
  ModelPointer model_;
  Simulator simulator_;
};

py::list list_events(const SimulationStatistics& statistics) {
  py::list events;
  for (const Event& event : statistics.events) {
    events.append(
        py::make_tuple(event.time, event.source, event.what, event.rate));
  }
  return events;
}

}  // namespace

void bind_simulator(py::module_& m) {
  py::class_<SimulationSettings>(
      m, "SimulationSettings",
      "How a system is simulated: until end_time [s], with steps of at most "
      "`step` [s] or to a tolerance of any point's position [m], outputs at "
      "increasing times [s]. verified: repeat the run with shorter steps until "
      "its error is known to be within the tolerance; None: where loads or "
      "commands oscillate.")
      .def(py::init(&make_settings), py::arg("end_time"), py::arg("step"),
           py::arg("output_times") = std::vector<double>(),
           py::arg("integrator") = "generalized-alpha",
           py::arg("tolerance") = 0.0, py::arg("rho_inf") = 0.9,
           py::arg("newton_tolerance") = 0.0, py::arg("newton_iterations") = 20,
           py::arg("exact_modes") = true, py::arg("verified") = std::nullopt);
  m.def("simulate", &simulate, py::arg("model"), py::arg("start"),
        py::arg("settings"), py::arg("probes"), py::arg("progress"));

  py::class_<Checkpoint>(
      m, "Checkpoint",
      "A simulation between two steps, from which it continues bit for bit.")
      .def_readonly("time", &Checkpoint::time, "[s]");
  py::class_<SimulationStatistics>(m, "SimulationStatistics",
                                   "Cost, events and warnings.")
      .def_readonly("steps", &SimulationStatistics::steps)
      .def_readonly("newton_iterations",
                    &SimulationStatistics::newton_iterations)
      .def_readonly("halved_steps", &SimulationStatistics::halved_steps)
      .def_readonly("seconds", &SimulationStatistics::seconds,
                    "Wall time of the stepping [s].")
      .def_property_readonly("events", &list_events,
                             "(time [s], source, what, rate) of each.")
      .def_readonly("warnings", &SimulationStatistics::warnings);
  py::class_<OwningSimulator>(
      m, "Simulator",
      "A simulation that the caller advances, to read its state in between.")
      .def(py::init<ModelPointer, const SystemState&,
                    const SimulationSettings&>(),
           py::arg("model"), py::arg("start"), py::arg("settings"))
      .def("advance_to", &OwningSimulator::advance_to, py::arg("t"),
           "Advances exactly to t [s], at most the settings' end. Ctrl-C ends "
           "it after a step with Interrupted; the state is then that of the "
           "last step.")
      .def_property_readonly("state", &OwningSimulator::state,
                             "A copy of the state.")
      .def("calc_energy", &OwningSimulator::energy,
           "Energies and momenta, work and dissipation since the start.")
      .def_property_readonly("statistics", &OwningSimulator::statistics,
                             py::return_value_policy::reference_internal)
      .def("save", &OwningSimulator::save)
      .def("restore", &OwningSimulator::restore, py::arg("checkpoint"));
}

}  // namespace limber::python
