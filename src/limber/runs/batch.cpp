// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/control/external_law.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/simulation/settings_check.hpp"
#include "limber/dynamics/simulation/tolerance_loop.hpp"
#include "limber/runs/parallel_worlds.hpp"
#include "limber/runs/probe_columns.hpp"
#include "limber/scene/probes/followed_probes.hpp"

namespace limber::runs {
namespace {

using dynamics::ControllerModel;

constexpr double kMostPeriods = 1e7;  // as samples of a controller

/// Indices of the controllers whose outputs the caller sets, increasing.
std::vector<std::size_t> find_inputs(
    const std::vector<ControllerModel>& controllers,
    const std::optional<std::vector<std::string>>& names) {
  std::vector<std::string> known;
  for (const ControllerModel& one : controllers) known.push_back(one.name);
  if (names) {
    for (const std::string& name : *names) {
      if (std::count(names->begin(), names->end(), name) > 1) {
        throw InputError(fmt::format("input '{}' is named twice", name));
      }
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      throw InputError(
          known.empty()
              ? fmt::format(
                    "input '{}': no [[controller]] of the scenario writes it",
                    name)
              : describe_unknown("input (a [[controller]])", name, known));
    }
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    if (!names ||
        std::find(names->begin(), names->end(), known[i]) != names->end()) {
      found.push_back(i);
    }
  }
  return found;
}

double choose_period(const std::vector<ControllerModel>& controllers,
                     const std::vector<std::size_t>& inputs,
                     const std::optional<double>& given) {
  if (given) {
    if (*given > 0.0 && std::isfinite(*given)) return *given;
    throw InputError(fmt::format(
        "the control period is {:g} s; expected a number > 0", *given));
  }
  if (inputs.empty()) {
    throw InputError(
        "no controller gives the control period: the scenario has none whose "
        "output is an input; give 'period'");
  }
  const ControllerModel& first = controllers[inputs.front()];
  for (const std::size_t i : inputs) {
    if (controllers[i].period == first.period) continue;
    throw InputError(fmt::format(
        "controllers '{}' and '{}' have periods of {:g} s and {:g} s, but a "
        "batch has one for all its inputs; give 'period'",
        first.name, controllers[i].name, first.period, controllers[i].period));
  }
  return first.period;
}

/// Gives these controllers external laws.
void open_inputs(const std::vector<std::size_t>& inputs, double period,
                 scene::BuiltScene& built) {
  for (const std::size_t i : inputs) {
    ControllerModel& controller = built.model.controllers[i];
    if (controller.offset > built.initial.t) {
      throw InputError(fmt::format(
          "controller '{}' takes its first sample at {:g} s, and a batch has "
          "control inputs from the start on; remove its 'offset'",
          controller.name, controller.offset));
    }
    controller.law = std::make_shared<const dynamics::ExternalLaw>();
    controller.period = period;
    controller.offset = built.initial.t;
    controller.measures.clear();
    controller.memory.clear();
    for (const int input : controller.writes) {
      controller.memory.push_back(built.model.inputs[index(input)].initial);
    }
    built.initial.controllers[i].memory = controller.memory;
  }
}

void choose_one_pass(scene::BuiltScene& built) {
  dynamics::SimulationSettings& settings = built.settings;
  if (settings.tolerance == 0.0) return;
  if (settings.passes == dynamics::TolerancePasses::verified) {
    throw InputError(
        "a verified tolerance repeats whole runs, whose control inputs a batch "
        "does not know in advance; set time.tolerance_passes = \"one\", or a "
        "step");
  }
  if (dynamics::choose_passes(built.model, settings, built.initial.t) ==
      dynamics::TolerancePasses::verified) {
    built.warnings.emplace_back(
        "a load or command oscillates: a run would verify its tolerance by "
        "several passes; a batch takes one, whose error may be larger");
  }
  settings.passes = dynamics::TolerancePasses::one;
}

void check_size(const std::string& what, std::size_t size, std::size_t n,
                std::size_t of_each) {
  if (size == n * of_each) return;
  throw InputError(
      fmt::format("{}: {} numbers; expected {}, {} for each of {} "
                  "worlds",
                  what, size, n * of_each, of_each, n));
}

}  // namespace

struct Batch::Parts {
  struct World {
    std::unique_ptr<dynamics::Simulator> simulator;
    long periods = 0;     ///< taken since the start
    std::string failure;  ///< why it failed
  };

  /// What evaluates probes, which are not thread-safe.
  struct Reader {
    explicit Reader(const scene::BuiltScene& built)
        : probes(built.probes), followed(scene::follow(probes, built.model)) {}
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    std::vector<scene::Probe> probes;
    dynamics::Followed followed;
    std::vector<double> values;
  };

  Parts(const scene::Scene& its_scene, scene::BuiltScene its_built,
        std::size_t n, const BatchOptions& options)
      : scene(its_scene), built(std::move(its_built)), worlds(n) {
    if (n == 0) throw InputError("a batch of 0 worlds; expected at least 1");
    const auto indices = find_inputs(built.model.controllers, options.inputs);
    period = choose_period(built.model.controllers, indices, options.period);
    open_inputs(indices, period, built);
    for (const std::size_t i : indices) {
      inputs.push_back(built.model.controllers[i].name);
    }
    if (const ControllerModel* hidden =
            dynamics::find_hidden_memory(built.model)) {
      throw InputError(fmt::format(
          "controller '{}' keeps data between samples outside of the state, "
          "which worlds of a batch would share; make it one of the inputs",
          hidden->name));
    }
    choose_one_pass(built);
    columns = list_columns(built.probes);
    threads = options.threads > 0
                  ? options.threads
                  : std::max(1U, std::thread::hardware_concurrency());
    threads = std::min(threads, n);
    for (std::size_t i = 0; i < threads; ++i) {
      readers.push_back(std::make_unique<Reader>(built));
    }
    last = count_periods();
    observations.resize(n * columns.size());
    times.resize(n);
    failed.resize(n);
    ended.resize(n);
  }

  // The last may be shorter.
  [[nodiscard]] long count_periods() const {
    const double end = built.settings.end_time;
    const double same = dynamics::find_same_time(end, built.initial.t);
    if (end - built.initial.t > kMostPeriods * period) {
      throw InputError(fmt::format(
          "a control period of {:g} s until {:g} s; at most {:g} are possible",
          period, end, kMostPeriods));
    }
    auto count = static_cast<long>((end - built.initial.t) / period);
    while (count > 1 && find_time(count - 1) >= end - same) --count;
    while (find_time(count) < end - same) ++count;
    return count;
  }

  [[nodiscard]] double find_time(long count) const {
    return built.initial.t + static_cast<double>(count) * period;
  }

  void show(std::size_t i, Reader& reader) {
    const World& world = worlds[i];
    times[i] = world.simulator->state().t;
    failed[i] = world.failure.empty() ? 0 : 1;
    ended[i] = failed[i] == 0 && world.periods == last ? 1 : 0;
    const auto row =
        observations.begin() + static_cast<std::ptrdiff_t>(i * columns.size());
    if (failed[i] != 0) {
      std::fill_n(row, columns.size(),
                  std::numeric_limits<double>::quiet_NaN());
      return;
    }
    reader.followed.evaluate(world.simulator->state(), reader.values);
    std::copy(reader.values.begin(), reader.values.end(), row);
  }

  void advance(World& world, std::span<const double> controls, long count,
               const std::function<bool()>& stops) const {
    try {
      for (long p = 0; p < count && world.periods < last; ++p) {
        world.simulator->set_external_outputs(controls);
        const long next = world.periods + 1;
        const double t =
            next == last ? built.settings.end_time : find_time(next);
        if (!world.simulator->advance_to(t, stops)) {
          world.failure = fmt::format("interrupted at t = {:.9g} s",
                                      world.simulator->state().t);
          return;
        }
        world.periods = next;
      }
    } catch (const NumericalError& error) {
      world.failure = error.what();
    }
  }

  const scene::Scene scene;
  scene::BuiltScene built;
  std::vector<std::string> inputs;
  std::vector<results::ProbeColumn> columns;
  double period = 0.0;  // [s]
  long last = 1;        // number of periods until the end
  std::size_t threads = 1;
  std::vector<std::unique_ptr<Reader>> readers;  // one a thread
  std::vector<World> worlds;
  std::vector<double> observations;
  std::vector<double> times;
  std::vector<unsigned char> failed;
  std::vector<unsigned char> ended;
};

Batch::Batch(const scene::Scene& scene, scene::BuiltScene built,
             std::size_t worlds, const BatchOptions& options)
    : parts_(
          std::make_unique<Parts>(scene, std::move(built), worlds, options)) {
  reset(std::vector<unsigned char>(worlds, 1));
}

Batch::~Batch() = default;

std::vector<std::string> Batch::reset(std::span<const unsigned char> selected,
                                      std::span<const WorldStart> starts) {
  Parts& p = *parts_;
  const std::size_t n = size();
  check_size("mask of worlds to reset", selected.size(), n, 1);
  if (!starts.empty()) check_size("starts of worlds", starts.size(), n, 1);
  std::vector<Parts::World> made(n);
  std::vector<std::vector<std::string>> notices(n);
  for_each_world(n, p.threads, [&](std::size_t i, std::size_t /*thread*/) {
    if (selected[i] == 0) return;
    const dynamics::SystemState start =
        starts.empty() ? p.built.initial
                       : find_start(p.scene, p.built, starts[i], notices[i]);
    made[i].simulator = std::make_unique<dynamics::Simulator>(
        p.built.model, start, p.built.settings);
  });
  for_each_world(n, p.threads, [&](std::size_t i, std::size_t thread) {
    if (selected[i] == 0) return;
    p.worlds[i] = std::move(made[i]);
    p.show(i, *p.readers[thread]);
  });
  std::vector<std::string> all;
  for (const auto& of_world : notices) {
    all.insert(all.end(), of_world.begin(), of_world.end());
  }
  return all;
}

bool Batch::step(std::span<const double> controls, long periods,
                 std::span<const unsigned char> selected,
                 const std::function<bool()>& stops) {
  Parts& p = *parts_;
  const std::size_t n = size();
  const std::size_t m = p.inputs.size();
  check_size("controls", controls.size(), n, m);
  check_size("mask of worlds to step", selected.size(), n, 1);
  if (periods < 1) {
    throw InputError(
        fmt::format("{} control periods; expected 1 or more", periods));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (selected[i] == 0 || p.ended[i] == 0) continue;
    throw InputError(fmt::format(
        "world {} is at the end of its scenario, {:g} s; reset it, leave it "
        "out, or set a longer time.duration",
        i, p.built.settings.end_time));
  }
  std::atomic<bool> is_stopped = false;
  const auto poll = [&] {
    if (stops && stops()) is_stopped = true;
  };
  const auto stops_here = [&] {
    poll();
    return is_stopped.load();
  };
  const auto stops_there = [&] { return is_stopped.load(); };
  const auto work = [&](std::size_t i, std::size_t thread) {
    if (selected[i] == 0 || p.failed[i] != 0) return;
    const auto row = controls.subspan(i * m, m);
    thread == 0 ? p.advance(p.worlds[i], row, periods, stops_here)
                : p.advance(p.worlds[i], row, periods, stops_there);
    p.show(i, *p.readers[thread]);
  };
  for_each_world(n, p.threads, work, poll);
  return !is_stopped;
}

std::size_t Batch::size() const { return parts_->worlds.size(); }
const std::vector<std::string>& Batch::inputs() const { return parts_->inputs; }
const std::vector<results::ProbeColumn>& Batch::columns() const {
  return parts_->columns;
}
double Batch::period() const { return parts_->period; }
std::size_t Batch::threads() const { return parts_->threads; }
std::span<const double> Batch::observations() const {
  return parts_->observations;
}
std::span<const double> Batch::times() const { return parts_->times; }
std::span<const unsigned char> Batch::failed() const { return parts_->failed; }
std::span<const unsigned char> Batch::ended() const { return parts_->ended; }
const std::string& Batch::failure(std::size_t world) const {
  return parts_->worlds.at(world).failure;
}
const dynamics::Simulator& Batch::world(std::size_t world) const {
  return *parts_->worlds.at(world).simulator;
}

std::vector<std::string> Batch::warnings() const {
  std::vector<std::string> texts = parts_->built.warnings;
  const auto& own = world(0).statistics().warnings;
  texts.insert(texts.end(), own.begin(), own.end());
  return texts;
}

}  // namespace limber::runs
