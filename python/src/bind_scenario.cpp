// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "interruption.hpp"
#include "json.hpp"
#include "limber/app/errors/error_runs.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/run/unstable_loop.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/library_lock.hpp"
#include "limber/runs/pictured_scene.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/control/measured_probe.hpp"
#include "python_controller.hpp"
#include "recorded_run.hpp"

namespace limber::python {
namespace {

namespace fs = std::filesystem;

using Settings =
    std::vector<std::pair<std::string, std::optional<std::string>>>;

scene::Scene load(const fs::path& file, const Settings& settings,
                  const std::optional<std::string>& fidelity) {
  scene::Overrides overrides;
  for (const auto& [path, value] : settings) {
    overrides.settings.push_back({path, value});
  }
  if (fidelity) overrides.fidelity = dynamics::parse_fidelity(*fidelity);
  const py::gil_scoped_release release;
  const auto lock = runs::lock_libraries();
  return scene::load_scene(file, overrides);
}

/// A Python function in place of a controller's law.
struct GivenLaw {
  std::string name;
  py::function law;
  std::optional<std::vector<double>> memory;
  std::optional<std::vector<std::string>> measures;  ///< columns of probes
  std::optional<double> period;                      ///< [s]
  std::string identity;
};

std::vector<GivenLaw> read_laws(const py::list& laws) {
  std::vector<GivenLaw> given;
  for (const py::handle& one : laws) {
    given.push_back(
        {one.attr("name").cast<std::string>(),
         one.attr("law").cast<py::function>(),
         one.attr("memory").cast<std::optional<std::vector<double>>>(),
         one.attr("measures").cast<std::optional<std::vector<std::string>>>(),
         one.attr("period").cast<std::optional<double>>(),
         one.attr("identity").cast<std::string>()});
  }
  return given;
}

dynamics::Measurement measure(const GivenLaw& law,
                              const std::vector<scene::Probe>& probes,
                              const std::string& column) {
  const std::string name = column.substr(0, column.rfind('.'));
  std::vector<std::string> known;
  for (const scene::Probe& probe : probes) {
    if (probe.name == name) return scene::measure_probe(probe, column);
    known.push_back(probe.name);
  }
  throw InputError(fmt::format("controller '{}' measures '{}': {}", law.name,
                               column, describe_unknown("probe", name, known)));
}

void replace_law(const GivenLaw& given, scene::BuiltScene& built) {
  auto& controllers = built.model.controllers;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    dynamics::ControllerModel& controller = controllers[i];
    known.push_back(controller.name);
    if (controller.name != given.name) continue;
    controller.law = make_python_law(given.law, given.memory, given.identity);
    controller.memory = given.memory.value_or(std::vector<double>());
    built.initial.controllers[i].memory = controller.memory;
    if (given.period) controller.period = *given.period;
    if (given.measures) {
      controller.measures.clear();
      for (const std::string& column : *given.measures) {
        controller.measures.push_back(measure(given, built.probes, column));
      }
    }
    return;
  }
  throw InputError(
      known.empty()
          ? fmt::format("controller '{}': the scenario has no [[controller]] "
                        "whose law it could be",
                        given.name)
          : describe_unknown("controller", given.name, known));
}

void check_period(const GivenLaw& given) {
  if (!given.period || *given.period > 0.0) return;
  throw InputError(
      fmt::format("controller '{}': its period is {:g} s; "
                  "expected > 0",
                  given.name, *given.period));
}

std::shared_ptr<RecordedRun> run(const scene::Scene& scene,
                                 const fs::path& cache, bool judges,
                                 bool errors, const py::list& laws,
                                 const py::object& progress) {
  clear_cause();
  const Progress watch = make_watch(progress);
  const std::vector<GivenLaw> given = read_laws(laws);
  auto recorded = std::make_shared<RecordedRun>();
  {
    const py::gil_scoped_release release;
    runs::RunOptions options;
    options.reductions = app::make_reductions(cache, watch);
    options.progress = watch;
    options.judges_levels = judges;
    runs::PicturedScene made;
    {
      const auto lock = runs::lock_libraries();
      made = runs::build_pictured(scene, options.reductions);
    }
    for (const GivenLaw& law : given) {
      check_period(law);
      replace_law(law, made.built);
    }
    if (auto unstable = app::find_unstable_loop(scene, made.built)) {
      made.built.warnings.push_back(std::move(*unstable));
    }
    recorded->run = runs::simulate_pictured(scene, std::move(made), options);
    const bool is_requested =
        errors || (scene.scenario.output.errors && given.empty());
    if (is_requested && !recorded->run.failure) {
      try {
        app::add_errors(recorded->run,
                        app::estimate_errors(recorded->run, cache, watch));
      } catch (const dynamics::Interrupted&) {
        recorded->run.failure = std::current_exception();
      }
    }
  }
  recorded->cause = take_cause();
  return recorded;
}

py::dict describe(const scene::Scene& scene) {
  py::dict dict;
  dict["name"] = scene.scenario.name;
  dict["file"] = scene.scenario.file.string();
  dict["fidelity"] = std::string(to_string(scene.scenario.fidelity));
  dict["end_time"] = scene.scenario.settings.end_time;
  py::list links;
  for (const auto& link : scene.robot.links) links.append(link.name);
  dict["links"] = links;
  py::list controllers;
  for (const auto& one : scene.scenario.controllers) {
    controllers.append(one.name);
  }
  dict["controllers"] = controllers;
  return dict;
}

}  // namespace

void bind_scenario(py::module_& m) {
  py::class_<scene::Scene, std::shared_ptr<scene::Scene>>(m, "Scene")
      .def("describe", &describe);
  m.def("load", &load, py::arg("file"), py::arg("settings"),
        py::arg("fidelity"));
  m.def("run", &run, py::arg("scene"), py::arg("cache"), py::arg("judges"),
        py::arg("errors"), py::arg("laws"), py::arg("progress"));
}

}  // namespace limber::python
