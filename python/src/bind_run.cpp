// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <exception>

#include "arrays.hpp"
#include "json.hpp"
#include "limber/app/run/view_page.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/library_lock.hpp"
#include "limber/view/page.hpp"
#include "recorded_run.hpp"

namespace limber::python {
namespace {

namespace fs = std::filesystem;

RecordedRun& run_of(const py::object& self) {
  return self.cast<RecordedRun&>();
}

py::array get_time(const py::object& self) {
  return view_of(run_of(self).run.history.times, self);
}

py::array get_probes(const py::object& self) {
  const RecordedRun::Block& block = run_of(self).probes();
  return view_of(block.data(), {block.rows(), block.cols()}, {block.cols(), 1},
                 self);
}

/// (value, time) a column; empty for an equilibrium.
py::list list_peaks(const RecordedRun& run) {
  py::list peaks;
  for (const dynamics::Extreme& peak : run.run.record.peaks) {
    peaks.append(py::make_tuple(peak.value, peak.time));
  }
  return peaks;
}

/// Edges (n + 1), and least and most of a column (n).
py::tuple get_envelope(const py::object& self, py::ssize_t column) {
  const Envelopes& envelopes = run_of(self).run.record.envelopes;
  const Eigen::Index rows = envelopes.least.rows();
  const auto side = [&](const MatrixX& values) {
    return view_of(values.data() + column * rows, {rows}, {1}, self);
  };
  return py::make_tuple(view_of(envelopes.edges, self), side(envelopes.least),
                        side(envelopes.most));
}

/// A member of every energy balance.
py::array get_energies(const py::object& self, const double* first,
                       py::ssize_t size) {
  const auto& energies = run_of(self).energies();
  constexpr py::ssize_t kStride =
      sizeof(dynamics::EnergyBalance) / sizeof(double);
  if (size == 1) return view_of(first, {std::ssize(energies)}, {kStride}, self);
  return view_of(first, {std::ssize(energies), size}, {kStride, 1}, self);
}

py::dict get_energies(const py::object& self) {
  static_assert(sizeof(dynamics::EnergyBalance) % sizeof(double) == 0);
  const auto& energies = run_of(self).energies();
  static const dynamics::EnergyBalance none;
  const dynamics::EnergyBalance& e = energies.empty() ? none : energies.front();
  py::dict dict;
  dict["kinetic_rigid"] = get_energies(self, &e.kinetic_rigid, 1);
  dict["kinetic_modal"] = get_energies(self, &e.kinetic_modal, 1);
  dict["elastic"] = get_energies(self, &e.elastic, 1);
  dict["coupler"] = get_energies(self, &e.coupler, 1);
  dict["dissipated"] = get_energies(self, &e.dissipated, 1);
  dict["work"] = get_energies(self, &e.work, 1);
  dict["linear_momentum"] = get_energies(self, e.linear_momentum.data(), 3);
  dict["angular_momentum"] = get_energies(self, e.angular_momentum.data(), 3);
  return dict;
}

/// Columns of a block, without a copy.
py::array get_part(const py::object& self, const RecordedRun::Block& block,
                   Eigen::Index from, Eigen::Index count) {
  return view_of(block.data() + from, {block.rows(), count}, {block.cols(), 1},
                 self);
}

py::dict get_body(const py::object& self, int index) {
  RecordedRun& run = run_of(self);
  const auto& body =
      run.run.built.model.bodies.at(static_cast<std::size_t>(index));
  const Eigen::Index at = kBodyValues * index;
  py::dict dict;
  dict["position"] = get_part(self, run.motion(), at, 3);
  dict["orientation"] = get_part(self, run.motion(), at + 3, 4);
  dict["velocity"] = get_part(self, run.motion(), at + 7, 3);
  dict["angular_velocity"] = get_part(self, run.motion(), at + 10, 3);
  dict["eta"] = get_part(self, run.eta(), body.offset, body.modes);
  dict["etadot"] = get_part(self, run.etadot(), body.offset, body.modes);
  dict["level"] = std::string(to_string(body.fidelity));
  return dict;
}

py::list list_columns(const RecordedRun& run) {
  py::list columns;
  for (const auto& column : run.run.history.columns) {
    columns.append(py::make_tuple(column.name, column.unit));
  }
  return columns;
}

py::list list_events(const RecordedRun& run) {
  py::list events;
  for (const dynamics::Event& event : run.run.history.events) {
    events.append(
        py::make_tuple(event.time, event.source, event.what, event.rate));
  }
  return events;
}

std::vector<std::string> list_bodies(const RecordedRun& run) {
  std::vector<std::string> names;
  for (const auto& body : run.run.built.model.bodies) {
    names.push_back(body.name);
  }
  return names;
}

std::vector<std::string> list_warnings(const RecordedRun& recorded) {
  const runs::Run& run = recorded.run;
  std::vector<std::string> texts = run.built.warnings;
  const auto levels = runs::find_level_warnings(run.levels);
  for (const auto& more :
       {run.statistics.warnings, run.given_warnings, levels}) {
    texts.insert(texts.end(), more.begin(), more.end());
  }
  return texts;
}

/// (class of limber.errors, text) of what ended it early, or None.
py::object describe_failure(const RecordedRun& recorded) {
  if (!recorded.run.failure) return py::none();
  try {
    std::rethrow_exception(recorded.run.failure);
  } catch (const dynamics::Interrupted& error) {
    return py::make_tuple("Interrupted", error.what());
  } catch (const NumericalError& error) {
    return py::make_tuple("NumericalError", error.what());
  }
}

void save_run(const RecordedRun& run, const fs::path& folder, bool pictures,
              bool xdmf) {
  const py::gil_scoped_release release;
  const auto lock = runs::lock_libraries();
  const app::OutputFolder out(folder);
  out.write([&](const fs::path& place) {
    if (run.write) return run.write(place, xdmf);
    app::write_run(run.run, place, xdmf);
  });
  if (pictures && !run.run.history.states.empty()) {
    out.add([&](const fs::path& place) { app::draw_run(run.run, place); });
  }
}

void write_page(const fs::path& page, const std::vector<fs::path>& results) {
  const py::gil_scoped_release release;
  const auto lock = runs::lock_libraries();
  view::write_page(page, app::read_recordings(results));
}

}  // namespace

void bind_run(py::module_& m) {
  py::class_<RecordedRun, std::shared_ptr<RecordedRun>>(m, "RecordedRun")
      .def_property_readonly("time", &get_time)
      .def_property_readonly("probes", &get_probes)
      .def_property_readonly("columns", &list_columns)
      .def_property_readonly("peaks", &list_peaks)
      .def_property_readonly("enveloped",
                             [](const RecordedRun& run) {
                               return run.run.record.envelopes.least.cols();
                             })
      .def("envelope", &get_envelope)
      .def_property_readonly(
          "energies", [](const py::object& self) { return get_energies(self); })
      .def_property_readonly("bodies", &list_bodies)
      .def("body", &get_body)
      .def_property_readonly("events", &list_events)
      .def_property_readonly("warnings", &list_warnings)
      .def_property_readonly("summary",
                             [](const RecordedRun& run) {
                               return to_python(app::summarize(run.run));
                             })
      .def_property_readonly("failure", &describe_failure)
      .def_property_readonly("cause",
                             [](const RecordedRun& run) { return run.cause; })
      .def_property_readonly(
          "name",
          [](const RecordedRun& run) { return run.run.scene.scenario.name; })
      .def_property_readonly(
          "seconds",
          [](const RecordedRun& run) { return run.run.statistics.seconds; })
      .def("save", &save_run, py::arg("folder"), py::arg("pictures"),
           py::arg("xdmf"));
  m.def("write_page", &write_page, py::arg("page"), py::arg("results"));
}

}  // namespace limber::python
