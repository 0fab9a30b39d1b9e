// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/simbody_reference.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/reference/simbody_model.hpp"

namespace limber::reference {
namespace {

using SimTK::Integrator;

bool at_time(const Integrator& integrator, double t) {
  return integrator.getState().getTime() >= t;
}

/// From one jump to the next, through the marks in between.
class Passage {
 public:
  Passage(SimbodyModel& model, const SimbodyOptions& options)
      : model_(model), integrator_(model.system()) {
    integrator_.setAccuracy(options.accuracy);
    integrator_.setAllowInterpolation(false);
    integrator_.setInternalStepLimit(0);
  }

  void begin(SimTK::State state, double begin, double end) {
    model_.interval() = {begin, end};
    // Loads may have changed since the state's cache was computed.
    state.invalidateAllCacheAtOrAbove(SimTK::Stage::Time);
    integrator_.initialize(state);
  }
  void advance(double t) {
    while (!at_time(integrator_, t)) integrator_.stepTo(t, t);
  }
  [[nodiscard]] const SimTK::State& state() const {
    return integrator_.getState();
  }
  [[nodiscard]] long steps() const { return integrator_.getNumStepsTaken(); }

 private:
  SimbodyModel& model_;
  SimTK::RungeKuttaMersonIntegrator integrator_;
};

double find_next_jump(const std::vector<dynamics::Breakpoint>& marks,
                      std::size_t from) {
  for (std::size_t i = from; i < marks.size(); ++i) {
    if (marks[i].is_jump) return marks[i].time;
  }
  return marks.back().time;
}

SimbodyRun run(const Mechanism& mechanism, const SimbodyOptions& options,
               const std::vector<dynamics::Breakpoint>& marks,
               const Progress& progress) {
  SimbodyModel model(mechanism, options.joints);
  Passage passage(model, options);
  SimbodyRun result;
  result.snapshots.push_back(model.observe(model.make_start()));
  passage.begin(model.make_start(), 0.0, find_next_jump(marks, 0));
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const dynamics::Breakpoint& mark = marks[i];
    passage.advance(mark.time);
    if (mark.is_output) {
      result.snapshots.push_back(model.observe(passage.state()));
    }
    report(progress, "Simbody", mark.time / marks.back().time);
    if (!mark.is_jump || i + 1 == marks.size()) continue;
    result.steps += passage.steps();
    passage.begin(passage.state(), mark.time, find_next_jump(marks, i + 1));
  }
  result.steps += passage.steps();
  return result;
}

}  // namespace

std::string simbody_name() {
  int major = 0;
  int minor = 0;
  int build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return fmt::format("Simbody {}.{}.{}", major, minor, build);
}

SimbodyRun simulate(const Mechanism& mechanism, const SimbodyOptions& options,
                    const std::vector<dynamics::Breakpoint>& marks,
                    const Progress& progress) {
  LIMBER_EXPECT(!marks.empty() && marks.front().time > 0.0);
  if (!(options.accuracy > 0.0) || !(options.accuracy < 1.0)) {
    throw InputError(
        fmt::format("accuracy is {:g}; expected 0 to 1", options.accuracy));
  }
  try {
    return run(mechanism, options, marks, progress);
  } catch (const SimTK::Exception::Base& error) {
    throw NumericalError(simbody_name() + ": " + error.what());
  }
}

}  // namespace limber::reference
