// SPDX-License-Identifier: BSD-3-Clause
// What the command linearize finds, of a loaded scene.
#include "arrays.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/results/linear_model_file.hpp"
#include "limber/runs/analyses/linear_run.hpp"
#include "run_alone.hpp"

namespace limber::python {
namespace {

namespace fs = std::filesystem;
using runs::LinearRun;
using Signals = std::vector<dynamics::LinearSignal>;
using Names = std::optional<std::vector<std::string>>;

/// None: all. An empty list would be taken for all, too.
std::vector<std::string> read_names(const char* what, const Names& names) {
  if (!names) return {};
  if (names->empty()) {
    throw InputError(std::string(what) +
                     " is an empty list; expected names, or None for all");
  }
  return *names;
}

std::variant<runs::Reference, double> read_time_or_reference(
    const py::object& at) {
  if (py::isinstance<py::str>(at)) {
    return runs::parse_reference(at.cast<std::string>());
  }
  try {
    return at.cast<double>();
  } catch (const py::cast_error&) {
    return runs::parse_reference(py::str(at));  // which refuses it
  }
}

int read_states(const std::optional<int>& states) {
  if (!states || *states > 0) return states.value_or(0);
  throw InputError("states is " + std::to_string(*states) +
                   "; expected a number > 0, or None for all");
}

std::shared_ptr<LinearRun> linearize(const scene::Scene& scene,
                                     const py::object& at, const Names& inputs,
                                     const Names& outputs,
                                     const std::optional<int>& states,
                                     bool closed_loop, const fs::path& cache) {
  const runs::LinearRequest request = {
      read_time_or_reference(at),
      {read_names("inputs", inputs), read_names("outputs", outputs)},
      read_states(states),
      closed_loop};
  return run_alone([&](const Progress& watch) {
    return std::make_shared<LinearRun>(runs::linearise_scene(
        scene, request, app::make_reductions(cache, watch), watch));
  });
}

const LinearRun& linear_run_of(const py::object& self) {
  return self.cast<const LinearRun&>();
}

const dynamics::LinearModel& model_of(const py::object& self) {
  return linear_run_of(self).record.model;
}

/// [(name, unit, value), ...]
py::list list_signals(const Signals& signals) {
  py::list list;
  for (const dynamics::LinearSignal& signal : signals) {
    list.append(py::make_tuple(signal.name, signal.unit, signal.value));
  }
  return list;
}

void save_linear_model(const LinearRun& run, const fs::path& file) {
  const py::gil_scoped_release release;
  const auto lock = runs::lock_libraries();
  results::check_linear_model_ending(file);
  results::write_linear_model(file, run.record);
}

}  // namespace

void bind_linear(py::module_& m) {
  py::class_<LinearRun, std::shared_ptr<LinearRun>>(m, "LinearRun")
      .def_property_readonly("A",
                             [](const py::object& self) {
                               return view_of_matrix(model_of(self).A, self);
                             })
      .def_property_readonly("B",
                             [](const py::object& self) {
                               return view_of_matrix(model_of(self).B, self);
                             })
      .def_property_readonly("C",
                             [](const py::object& self) {
                               return view_of_matrix(model_of(self).C, self);
                             })
      .def_property_readonly("D",
                             [](const py::object& self) {
                               return view_of_matrix(model_of(self).D, self);
                             })
      .def_property_readonly("inputs",
                             [](const LinearRun& run) {
                               return list_signals(run.record.model.inputs);
                             })
      .def_property_readonly("outputs",
                             [](const LinearRun& run) {
                               return list_signals(run.record.model.outputs);
                             })
      .def_property_readonly("states",
                             [](const LinearRun& run) {
                               return list_signals(run.record.model.states);
                             })
      .def_property_readonly(
          "all_states",
          [](const LinearRun& run) { return run.linear.model.states.size(); })
      .def_property_readonly(
          "kept",
          [](const LinearRun& run) {
            return run.truncated ? py::cast(run.truncated->kept) : py::none();
          })
      .def_property_readonly("hankel",
                             [](const py::object& self) -> py::object {
                               if (!linear_run_of(self).truncated)
                                 return py::none();
                               return view_of(linear_run_of(self).record.hankel,
                                              self);
                             })
      .def_property_readonly("bound",
                             [](const LinearRun& run) -> py::object {
                               if (!run.truncated) return py::none();
                               return py::float_(run.record.bound);
                             })
      .def_property_readonly(
          "axes_angular_velocity",
          [](const py::object& self) {
            return view_of(linear_run_of(self).record.axes_angular_velocity,
                           self);
          })
      .def_property_readonly(
          "time", [](const LinearRun& run) { return run.record.time; })
      .def_property_readonly("period",
                             [](const LinearRun& run) -> py::object {
                               if (run.record.period == 0.0) return py::none();
                               return py::float_(run.record.period);
                             })
      .def_property_readonly(
          "about", [](const LinearRun& run) { return run.record.about; })
      .def_property_readonly(
          "scenario", [](const LinearRun& run) { return run.record.scenario; })
      .def_property_readonly(
          "open_loops",
          [](const LinearRun& run) { return run.linear.open_loops; })
      .def_property_readonly(
          "warnings", [](const LinearRun& run) { return run.record.warnings; })
      .def("save", &save_linear_model, py::arg("file"));
  m.def("linearize", &linearize, py::arg("scene"), py::arg("at"),
        py::arg("inputs"), py::arg("outputs"), py::arg("states"),
        py::arg("closed_loop"), py::arg("cache"));
}

}  // namespace limber::python
