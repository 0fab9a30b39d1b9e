// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <atomic>

#include "arrays.hpp"
#include "interruption.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/batch.hpp"
#include "limber/runs/library_lock.hpp"
#include "run_alone.hpp"

namespace limber::python {
namespace {

namespace fs = std::filesystem;

using Rows = py::array_t<double, py::array::c_style>;
using Mask = py::array_t<bool, py::array::c_style>;

/// A batch that one thread at a time changes.
class SharedBatch {
 public:
  SharedBatch(const scene::Scene& scene, std::size_t worlds,
              const runs::BatchOptions& options, const fs::path& cache)
      : batch_(scene, build(scene, cache), worlds, options) {}

  [[nodiscard]] const runs::Batch& get() const { return batch_; }

  /// Work on the batch without the GIL.
  template <typename Work>
  auto change(const Work& work) {
    const Turn turn(is_busy_);
    clear_cause();
    const py::gil_scoped_release release;
    return work(batch_);
  }

 private:
  /// The right to change it.
  class Turn {
   public:
    explicit Turn(std::atomic<bool>& is_busy) : is_busy_(is_busy) {
      if (!is_busy_.exchange(true)) return;
      throw InputError(
          "another thread is stepping or resetting this batch; use one thread "
          "per batch");
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() { is_busy_ = false; }

   private:
    std::atomic<bool>& is_busy_;
  };

  static scene::BuiltScene build(const scene::Scene& scene,
                                 const fs::path& cache) {
    return run_alone([&](const Progress& watch) {
      const runs::Reductions reductions = app::make_reductions(cache, watch);
      return scene::build_system(scene, reductions.reducer, reductions.cache,
                                 reductions.make_full);
    });
  }

  std::atomic<bool> is_busy_ = false;
  runs::Batch batch_;
};

std::unique_ptr<SharedBatch> make_batch(
    const scene::Scene& scene, std::size_t worlds,
    const std::optional<std::vector<std::string>>& inputs,
    const std::optional<double>& period, std::size_t threads,
    const fs::path& cache) {
  return std::make_unique<SharedBatch>(
      scene, worlds,
      runs::BatchOptions{
          .inputs = inputs, .period = period, .threads = threads},
      cache);
}

std::vector<unsigned char> read_mask(const Mask& mask) {
  return {mask.data(), mask.data() + mask.size()};
}

std::span<const double> read_row(const Rows& rows, std::size_t world) {
  const auto width = static_cast<std::size_t>(rows.shape(1));
  return {rows.data() + world * width, width};
}

/// Sets a member of each world's start from an array (n, c).
void add_start(const std::string& kind, const std::string& name,
               const std::string& key, const Rows& rows,
               std::vector<runs::WorldStart>& starts) {
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::span<const double> row = read_row(rows, i);
    if (kind == "joint") {
      scene::JointStart& joint = starts[i].joints[name];
      (key == "position" ? joint.position : joint.velocity)
          .assign(row.begin(), row.end());
      continue;
    }
    runs::FreeStart& body = starts[i].bodies[name];
    (key == "position"          ? body.position
     : key == "orientation_rpy" ? body.orientation_rpy
     : key == "velocity"        ? body.velocity
                                : body.angular_velocity) =
        Vector3(row[0], row[1], row[2]);
  }
}

/// @param changes (kind, name, key, (n, c)) of what starts otherwise
std::vector<std::string> reset(
    SharedBatch& batch, const Mask& mask,
    const std::vector<std::tuple<std::string, std::string, std::string, Rows>>&
        changes) {
  std::vector<runs::WorldStart> starts;
  if (!changes.empty()) starts.resize(batch.get().size());
  for (const auto& [kind, name, key, rows] : changes) {
    add_start(kind, name, key, rows, starts);
  }
  const std::vector<unsigned char> selected = read_mask(mask);
  return batch.change(
      [&](runs::Batch& own) { return own.reset(selected, starts); });
}

void step(SharedBatch& batch, const Rows& controls, long periods,
          const Mask& mask) {
  const std::vector<unsigned char> selected = read_mask(mask);
  const std::span<const double> values(
      controls.data(), static_cast<std::size_t>(controls.size()));
  const bool is_done = batch.change([&](runs::Batch& own) {
    SignalWatch signals;
    bool is_stopped = false;
    return own.step(values, periods, selected, [&] {
      is_stopped = is_stopped || signals();
      return is_stopped;
    });
  });
  if (!is_done) throw dynamics::Interrupted("interrupted");
}

const runs::Batch& batch_of(const py::object& self) {
  return self.cast<const SharedBatch&>().get();
}

py::array get_observations(const py::object& self) {
  const runs::Batch& batch = batch_of(self);
  const auto columns = std::ssize(batch.columns());
  return view_of(batch.observations().data(),
                 {static_cast<py::ssize_t>(batch.size()), columns},
                 {columns, 1}, self);
}

py::array get_times(const py::object& self) {
  const std::span<const double> times = batch_of(self).times();
  return view_of(times.data(), {std::ssize(times)}, {1}, self);
}

py::array view_flags(std::span<const unsigned char> flags,
                     const py::object& owner) {
  static_assert(sizeof(bool) == sizeof(unsigned char));
  py::array array(py::dtype::of<bool>(),
                  std::vector<py::ssize_t>{std::ssize(flags)},
                  std::vector<py::ssize_t>{1}, flags.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::list list_columns(const SharedBatch& batch) {
  py::list columns;
  for (const auto& column : batch.get().columns()) {
    columns.append(py::make_tuple(column.name, column.unit));
  }
  return columns;
}

}  // namespace

void bind_batch(py::module_& m) {
  py::class_<SharedBatch>(m, "Batch")
      .def(py::init(&make_batch), py::arg("scene"), py::arg("worlds"),
           py::arg("inputs"), py::arg("period"), py::arg("threads"),
           py::arg("cache"))
      .def("reset", &reset, py::arg("mask"), py::arg("changes"))
      .def("step", &step, py::arg("controls"), py::arg("periods"),
           py::arg("mask"))
      .def_property_readonly("observations", &get_observations)
      .def_property_readonly("time", &get_times)
      .def_property_readonly("failed",
                             [](const py::object& self) {
                               return view_flags(batch_of(self).failed(), self);
                             })
      .def_property_readonly("ended",
                             [](const py::object& self) {
                               return view_flags(batch_of(self).ended(), self);
                             })
      .def("failure",
           [](const SharedBatch& batch, std::size_t world) {
             return batch.get().failure(world);
           })
      .def("state",
           [](const SharedBatch& batch, std::size_t world) {
             return batch.get().world(world).state();
           })
      .def("statistics",
           [](const SharedBatch& batch, std::size_t world) {
             return batch.get().world(world).statistics();
           })
      .def_property_readonly(
          "inputs",
          [](const SharedBatch& batch) { return batch.get().inputs(); })
      .def_property_readonly("columns", &list_columns)
      .def_property_readonly(
          "period",
          [](const SharedBatch& batch) { return batch.get().period(); })
      .def_property_readonly(
          "threads",
          [](const SharedBatch& batch) { return batch.get().threads(); })
      .def_property_readonly("warnings", [](const SharedBatch& batch) {
        return batch.get().warnings();
      });
}

}  // namespace limber::python
