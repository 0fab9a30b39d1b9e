// SPDX-License-Identifier: BSD-3-Clause
// What the commands static, frequencies, advise, check and compare find, of a
// loaded scene.
#include "arrays.hpp"
#include "json.hpp"
#include "limber/app/compare/comparison_report.hpp"
#include "limber/app/compare/comparison_run.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/reports/explanation.hpp"
#include "limber/app/reports/frequency_report.hpp"
#include "limber/app/reports/level_report.hpp"
#include "limber/app/run/scene_check.hpp"
#include "limber/app/run/static_files.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "recorded_run.hpp"
#include "run_alone.hpp"

namespace limber::python {
namespace {

namespace fs = std::filesystem;

/// The equilibrium as a run with one output, and what is told of it.
py::tuple find_static(const scene::Scene& scene,
                      const std::optional<std::string>& method,
                      const fs::path& cache) {
  using dynamics::EquilibriumMethod;
  const EquilibriumMethod chosen =
      method ? dynamics::parse_equilibrium_method(*method)
             : scene.scenario.equilibrium.value_or(EquilibriumMethod::newton);
  const auto found = run_alone([&](const Progress& watch) {
    return std::make_shared<const runs::StaticRun>(runs::find_static(
        scene, chosen, app::make_reductions(cache, watch), watch));
  });
  auto recorded = std::make_shared<RecordedRun>();
  recorded->run.scene = found->scene;
  recorded->run.built = found->built;
  recorded->run.history = found->history;
  recorded->write = [found](const fs::path& folder, bool xdmf) {
    app::write_static(*found, folder, xdmf);
  };
  return py::make_tuple(recorded, to_python(app::summarize(*found)),
                        found->warnings);
}

py::object find_frequencies(const scene::Scene& scene, int count,
                            const fs::path& cache) {
  const app::FrequencyReport report = run_alone([&](const Progress& watch) {
    return app::find_frequencies(scene, cache, watch);
  });
  return to_python(to_json(report, count));
}

py::object advise(const scene::Scene& scene, const fs::path& cache) {
  const runs::SceneAdvice advice = run_alone(
      [&](const Progress& watch) { return app::advise(scene, cache, watch); });
  return to_python(app::to_json(advice));
}

py::object check(const scene::Scene& scene, const fs::path& cache) {
  const app::SceneCheck found = run_alone([&](const Progress& watch) {
    return app::check_scene(scene, cache, watch);
  });
  return to_python(to_json(found));
}

py::object explain(const fs::path& folder) {
  return to_python(app::explain(app::read_run_summary(folder)));
}

runs::Axes read_axes(const py::dict& wish) {
  runs::Axes axes;
  for (const auto& name : wish["levels"].cast<std::vector<std::string>>()) {
    axes.levels.push_back(dynamics::parse_fidelity(name));
  }
  axes.eigenmodes = wish["modes"].cast<std::vector<int>>();
  axes.sources = wish["sources"].cast<std::vector<std::string>>();
  axes.steps = wish["steps"].cast<std::vector<double>>();
  return axes;
}

runs::ReferenceWish read_reference(const py::dict& wish) {
  runs::ReferenceWish reference;
  const auto level = wish["reference"].cast<std::optional<std::string>>();
  if (level) reference.level = dynamics::parse_fidelity(*level);
  const auto scheme =
      wish["reference_integrator"].cast<std::optional<std::string>>();
  if (scheme) reference.integrator = dynamics::parse_integrator(*scheme);
  reference.eigenmodes = wish["reference_modes"].cast<std::optional<int>>();
  reference.step = wish["reference_step"].cast<std::optional<double>>();
  return reference;
}

/// @param wish of the arguments of Scenario.compare
py::object compare(const scene::Scene& scene, const py::dict& wish,
                   const fs::path& cache) {
  app::ComparisonRequest settings;
  settings.scenario = scene.scenario.file;
  settings.settings = scene.overrides.settings;
  settings.cache = cache;
  settings.repeats = wish["repeats"].cast<int>();
  const runs::Axes axes = read_axes(wish);
  const runs::ReferenceWish reference = read_reference(wish);
  const auto result = run_alone([&](const Progress& watch) {
    bool is_interrupted = false;
    settings.watch = [&](std::string_view what, double fraction) {
      if (is_interrupted) throw dynamics::Interrupted("interrupted");
      try {
        watch(what, fraction);
      } catch (const dynamics::Interrupted&) {
        is_interrupted = true;  // all that follows ends at once, too
        throw;
      }
    };
    const runs::ComparisonPlan plan = make_plan(axes, reference, scene);
    const runs::Comparison found = run_comparison(plan, settings);
    if (is_interrupted) throw dynamics::Interrupted("interrupted");
    return app::to_json(found);
  });
  return to_python(result);
}

}  // namespace

void bind_analysis(py::module_& m) {
  m.def("find_static", &find_static, py::arg("scene"), py::arg("method"),
        py::arg("cache"));
  m.def("find_frequencies", &find_frequencies, py::arg("scene"),
        py::arg("count"), py::arg("cache"));
  m.def("advise", &advise, py::arg("scene"), py::arg("cache"));
  m.def("check", &check, py::arg("scene"), py::arg("cache"));
  m.def("explain", &explain, py::arg("folder"),
        "What limited a run in this folder, as ``limber explain --json``.");
  m.def("compare", &compare, py::arg("scene"), py::arg("wish"),
        py::arg("cache"));
}

}  // namespace limber::python
