// SPDX-License-Identifier: BSD-3-Clause
// The parts of `limber study` that limber.Study puts together.
#include <atomic>
#include <memory>

#include "interruption.hpp"
#include "limber/app/study/study_runner.hpp"
#include "limber/app/study/study_table.hpp"
#include "limber/app/study/study_worker.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/library_lock.hpp"
#include "limber/study/study_file.hpp"
#include "limber/study/study_reader.hpp"
#include "recorded_run.hpp"

namespace limber::python {
namespace {

namespace fs = std::filesystem;

/// A study that was read and checked, with what makes its runs in this process.
class StudyPlan {
 public:
  StudyPlan(const std::string& text, const fs::path& file, fs::path cache)
      : study_(study::read_study(text, file)),
        design_(make_design(study_)),
        cache_(std::move(cache)) {}

  [[nodiscard]] const study::Study& study() const { return study_; }
  [[nodiscard]] const study::Design& design() const { return design_; }

  /// What the study and its scenario are; checks all against the first run.
  const std::string& manifest() {
    const py::gil_scoped_release release;
    prepare();
    return manifest_;
  }

  /// None if it was stopped.
  std::optional<study::StudyRow> make_row(std::size_t run) {
    clear_cause();
    const py::gil_scoped_release release;
    prepare();
    if (run >= design_.size()) {
      throw ContractError("a run that the study does not have");
    }
    std::optional<study::StudyRow> row = worker_->make_row(run, design_[run]);
    if (!row) return std::nullopt;
    if (row->error.empty()) {
      const std::lock_guard lock(formula_mutex_);
      evaluate_formulas(study_, row->factors, row->responses);
    }
    return row;
  }

  /// Ends all runs of this process between two steps, and begins none.
  void stop() { stops_ = true; }
  void go_on() { stops_ = false; }

 private:
  void prepare() {
    const std::lock_guard once(base_mutex_);
    if (worker_) return;
    const auto lock = runs::lock_libraries();
    const app::StudyBase base = app::make_base(study_, design_, cache_);
    manifest_ = base.manifest;
    worker_ = std::make_unique<app::StudyWorker>(
        study_, cache_, base.built.known,
        [this](std::string_view, double fraction) {
          thread_local SignalWatch signals;
          if (fraction < 1.0 && (stops_ || signals())) {
            throw dynamics::Interrupted("interrupted");
          }
        });
  }

  study::Study study_;
  study::Design design_;
  fs::path cache_;
  std::atomic<bool> stops_ = false;
  std::mutex base_mutex_;  // of the next two
  std::string manifest_;
  std::unique_ptr<app::StudyWorker> worker_;
  std::mutex formula_mutex_;
};

py::tuple pack(const study::StudyRow& row) {
  return py::make_tuple(row.run, row.factors, row.responses, row.error,
                        row.warnings, row.seconds, row.seconds_ready);
}

study::StudyRow unpack(const py::tuple& row) {
  study::StudyRow made;
  made.run = row[0].cast<std::size_t>();
  made.factors = row[1].cast<std::vector<std::string>>();
  made.responses = row[2].cast<study::ResponseValues>();
  made.error = row[3].cast<std::string>();
  made.warnings = row[4].cast<std::string>();
  made.seconds = row[5].cast<double>();
  made.seconds_ready = row[6].cast<double>();
  return made;
}

std::vector<std::string> list_factors(const study::Study& study) {
  std::vector<std::string> names;
  for (const study::Factor& factor : study.factors)
    names.push_back(factor.name);
  return names;
}

std::vector<std::string> list_responses(const study::Study& study) {
  std::vector<std::string> names;
  for (const study::Response& one : study.responses) names.push_back(one.name);
  return names;
}

/// A file of results, which is locked until it is closed.
struct OpenResults {
  std::unique_ptr<study::StudyFile> file;

  study::StudyFile& get() {
    if (!file) throw ContractError("this file of results is closed");
    return *file;
  }
};

py::list read_rows(const study::StudyFile& file) {
  py::list rows;
  for (const study::StudyRow& row : file.read_rows()) rows.append(pack(row));
  return rows;
}

/// {factor: {response: (main, total)}}
py::dict find_effects(const study::StudyFile& file) {
  const study::Study& study = file.record().study;
  const study::Effects effects =
      study::find_effects(study, file.record().runs, file.read_rows());
  py::dict dict;
  for (std::size_t f = 0; f < effects.size(); ++f) {
    py::dict of;
    for (std::size_t r = 0; r < effects[f].size(); ++r) {
      const auto& effect = effects[f][r];
      if (!effect) continue;
      of[py::str(study.responses[r].name)] =
          py::make_tuple(effect->main, effect->total);
    }
    dict[py::str(study.factors[f].name)] = of;
  }
  return dict;
}

OpenResults open_results(const fs::path& file, StudyPlan& plan) {
  return {std::make_unique<study::StudyFile>(
      file, study::StudyRecord{plan.study(), plan.manifest(),
                               plan.design().size(), 0, 1})};
}

OpenResults read_results(const fs::path& file) {
  return {std::make_unique<study::StudyFile>(file)};
}

}  // namespace

void bind_study(py::module_& m) {
  py::class_<StudyPlan, std::shared_ptr<StudyPlan>>(m, "StudyPlan")
      .def(py::init<const std::string&, const fs::path&, fs::path>(),
           py::arg("text"), py::arg("file"), py::arg("cache"))
      .def_property_readonly(
          "runs", [](const StudyPlan& plan) { return plan.design().size(); })
      .def_property_readonly("design", &StudyPlan::design)
      .def_property_readonly(
          "name", [](const StudyPlan& plan) { return plan.study().name; })
      .def_property_readonly(
          "factors",
          [](const StudyPlan& plan) { return list_factors(plan.study()); })
      .def_property_readonly(
          "responses",
          [](const StudyPlan& plan) { return list_responses(plan.study()); })
      .def_property_readonly("manifest", &StudyPlan::manifest)
      .def("make_row",
           [](StudyPlan& plan, std::size_t run) -> py::object {
             const auto row = plan.make_row(run);
             if (!row) return py::none();
             return pack(*row);
           })
      .def("stop", &StudyPlan::stop)
      .def("go_on", &StudyPlan::go_on);
  py::class_<OpenResults>(m, "StudyFile")
      .def_static("read", &read_results, py::arg("file"))
      .def_static("open", &open_results, py::arg("file"), py::arg("plan"))
      .def("close", [](OpenResults& open) { open.file.reset(); })
      .def_property_readonly(
          "rows", [](OpenResults& open) { return read_rows(open.get()); })
      .def_property_readonly(
          "runs", [](OpenResults& open) { return open.get().record().runs; })
      .def_property_readonly("factors",
                             [](OpenResults& open) {
                               return list_factors(open.get().record().study);
                             })
      .def_property_readonly("responses",
                             [](OpenResults& open) {
                               return list_responses(open.get().record().study);
                             })
      .def_property_readonly(
          "effects", [](OpenResults& open) { return find_effects(open.get()); })
      .def("add", [](OpenResults& open, const std::vector<py::tuple>& rows) {
        std::vector<study::StudyRow> made;
        for (const py::tuple& row : rows) made.push_back(unpack(row));
        open.get().add(made);
      });
}

}  // namespace limber::python
