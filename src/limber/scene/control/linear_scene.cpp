// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/control/linear_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/scene/control/linear_outputs.hpp"

namespace limber::scene {
namespace {

using Index = Eigen::Index;

/// Drives of a transmission that are not the scenario's: its constant tension.
int count_own_drives(const Scenario& scenario,
                     const dynamics::Transmission& transmission) {
  const auto all = std::count_if(
      transmission.laws.begin(), transmission.laws.end(), [](const auto& law) {
        return std::holds_alternative<joints::Drive>(law);
      });
  const auto given =
      std::count_if(scenario.drives.begin(), scenario.drives.end(),
                    [&](const DriveSpec& drive) {
                      return drive.tendon == transmission.name;
                    });
  return static_cast<int>(all - given);
}

/// The scenario's drives there, in its order, after a tendon's own.
dynamics::DriveNames name_drives(const Scenario& scenario,
                                 const dynamics::SystemModel& model) {
  return [&](const dynamics::DriveSource& source) {
    const bool is_joint = source.coupler >= 0;
    const std::string& of =
        is_joint ? model.couplers[index(source.coupler)].name
                 : model.transmissions[index(source.transmission)].name;
    int left = source.number;
    if (!is_joint) {
      const int own = count_own_drives(
          scenario, model.transmissions[index(source.transmission)]);
      if (left < own) return of + ".tension";
      left -= own;
    }
    for (const DriveSpec& drive : scenario.drives) {
      if ((is_joint ? drive.joint : drive.tendon) != of) continue;
      if (left-- == 0) return drive.name;
    }
    throw ContractError("a drive that its scenario does not have");
  };
}

bool switches(const joints::ScalarLaw& law) {
  return joints::switch_count(law) > 0 ||
         std::holds_alternative<joints::Friction>(law);
}

bool switches(const joints::CouplerLaw& law) {
  const auto& elements = joints::elements_of(law);
  return joints::switch_count(law) > 0 ||
         std::any_of(elements.begin(), elements.end(),
                     [](const auto& e) { return switches(e.law); });
}

void warn_of_switches(const dynamics::SystemModel& model,
                      std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (const dynamics::Coupler& c : model.couplers) {
    if (switches(c.law)) names.push_back("'" + c.name + "'");
  }
  for (const dynamics::Transmission& t : model.transmissions) {
    if (std::any_of(t.laws.begin(), t.laws.end(),
                    [](const auto& law) { return switches(law); })) {
      names.push_back("'" + t.name + "'");
    }
  }
  if (names.empty()) return;
  warnings.push_back(
      fmt::format("{} can switch or rub (end stops, slack, latches, friction): "
                  "the model has them as they are at the reference, friction "
                  "as a damper, and is valid only as long",
                  fmt::join(names, ", ")));
}

void warn_of_inputs(const dynamics::SystemModel& model,
                    const dynamics::LinearSystem& system,
                    std::vector<std::string>& warnings) {
  for (const dynamics::LinearInput& input : system.inputs) {
    if (!input.force.isZero(0.0)) continue;
    warnings.push_back(fmt::format(
        "input '{}' has no effect: nothing follows it, or its followers are at "
        "their limits or exert nothing on a movable body",
        input.name));
  }
  for (const dynamics::BodyLoad& load : model.body_loads) {
    warnings.push_back(fmt::format(
        "the nodal forces '{}' act as at the reference and are not inputs",
        load.name));
  }
}

/// Indices of the named ones in their own order, of all if none is named.
std::vector<std::size_t> select(const std::string& kind,
                                const std::vector<std::string>& wanted,
                                const std::vector<std::string>& known,
                                const std::vector<std::string>& groups) {
  std::vector<std::size_t> chosen;
  if (wanted.empty()) {
    for (std::size_t i = 0; i < known.size(); ++i) chosen.push_back(i);
    return chosen;
  }
  for (const std::string& name : wanted) {
    const auto before = chosen.size();
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i] == name || groups[i] == name) chosen.push_back(i);
    }
    if (chosen.size() == before) {
      throw InputError(describe_unknown(kind, name, known));
    }
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::vector<std::size_t> select_inputs(const dynamics::LinearSystem& system,
                                       const LinearSelection& selection) {
  std::vector<std::string> names;
  for (const auto& input : system.inputs) names.push_back(input.name);
  return select("input", selection.inputs, names, names);
}

std::string probe_of(const std::string& column) {
  return column.substr(0, column.rfind('.'));
}

std::vector<std::size_t> select_outputs(
    const std::vector<LinearOutput>& outputs, const LinearSelection& selection,
    std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  std::vector<std::string> probes;
  for (const LinearOutput& output : outputs) {
    names.push_back(output.signal.name);
    probes.push_back(probe_of(output.signal.name));
  }
  std::vector<std::size_t> chosen =
      select("output", selection.outputs, names, probes);
  const auto lacks = [&](std::size_t i) {
    return !outputs[i].why_none.empty();
  };
  for (const std::size_t i : chosen) {
    if (!lacks(i)) continue;
    const std::string text = fmt::format("output '{}' can not be linear: {}",
                                         names[i], outputs[i].why_none);
    if (!selection.outputs.empty()) throw InputError(text);
    warnings.push_back(text + "; it is left out");
  }
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(), lacks),
               chosen.end());
  return chosen;
}

}  // namespace

LinearScene linearise(const Scenario& scenario,
                      const dynamics::SystemModel& model,
                      const dynamics::SystemState& state,
                      const std::vector<Probe>& probes,
                      const LinearSelection& selection) {
  const ObservedModel observed = observe(model, probes);
  LinearScene out;
  out.system = dynamics::linearise(observed.model, state, observed.frames,
                                   name_drives(scenario, model));
  const std::vector<LinearOutput> outputs =
      find_linear_outputs(probes, observed, state, out.system);
  const auto u = select_inputs(out.system, selection);
  const auto y = select_outputs(outputs, selection, out.warnings);
  const Index n = out.system.A.rows();
  out.model = {out.system.A,
               MatrixX(n, std::ssize(u)),
               MatrixX(std::ssize(y), n),
               MatrixX(std::ssize(y), std::ssize(u)),
               out.system.states,
               {},
               {}};
  for (std::size_t j = 0; j < u.size(); ++j) {
    const dynamics::LinearInput& input = out.system.inputs[u[j]];
    out.model.inputs.push_back({input.name, input.unit, input.value});
    out.model.B.col(static_cast<Index>(j)) =
        out.system.B.col(static_cast<Index>(u[j]));
  }
  for (std::size_t i = 0; i < y.size(); ++i) {
    const LinearOutput& output = outputs[y[i]];
    const auto row = static_cast<Index>(i);
    out.model.outputs.push_back(output.signal);
    out.model.C.row(row) = output.by_state;
    for (std::size_t j = 0; j < u.size(); ++j) {
      out.model.D(row, static_cast<Index>(j)) =
          output.by_input[static_cast<Index>(u[j])];
    }
  }
  for (const dynamics::ControllerModel& c : model.controllers) {
    out.open_loops.push_back(c.name);
  }
  warn_of_switches(model, out.warnings);
  warn_of_inputs(model, out.system, out.warnings);
  return out;
}

}  // namespace limber::scene
