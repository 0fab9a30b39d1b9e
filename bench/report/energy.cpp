// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/flexbody/modal/modal_response.hpp"
#include "sections.hpp"

/// Figures 10 and 11.
namespace limber::bench {
namespace {

using dynamics::Fidelity;
using dynamics::IntegratorKind;

/// Four steps that begin and end with no load; the report's values are in a
/// picture, so these are ours [s], [kg^1/2 m/s^2].
const std::vector<double> kStepTimes = {0.02, 0.05, 0.08, 0.11};
const std::vector<double> kStepValues = {150.0, -100.0, 200.0, 0.0};

/// Load that acts at `t`.
double find_load(double t) {
  const auto later = std::upper_bound(kStepTimes.begin(), kStepTimes.end(), t);
  if (later == kStepTimes.begin()) return 0.0;
  return kStepValues[static_cast<std::size_t>(later - kStepTimes.begin() - 1)];
}

/// Largest variation of the corrected energy within one interval of constant
/// load, relative to the largest energy.
double find_variation(const VectorX& corrected, double scale,
                      const std::vector<double>& times) {
  double worst = 0.0;
  double first = corrected[0];
  for (Eigen::Index i = 1; i < corrected.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (find_load(times[at]) != find_load(times[at - 1])) first = corrected[i];
    worst = std::max(worst, std::abs(corrected[i] - first));
  }
  return worst / scale;
}

/// One mode through the four steps.
struct SingleMode {
  std::vector<double> times;            // [s]
  VectorX kinetic, elastic, corrected;  // [J]

  [[nodiscard]] VectorX total() const { return kinetic + elastic; }
};

SingleMode simulate_single_mode() {
  constexpr double kOmega = 198.0;  // [rad/s]
  flexbody::ModalLoads loads;
  loads.steps.times = kStepTimes;
  loads.steps.values =
      Eigen::Map<const MatrixX>(kStepValues.data(), 1, std::ssize(kStepValues));
  const flexbody::ModalState initial{0.0, VectorX::Zero(1), VectorX::Ones(1)};
  const flexbody::ModalResponse response(VectorX::Constant(1, kOmega * kOmega),
                                         VectorX::Zero(1), loads, initial);
  SingleMode mode{spread_times(0.14, 1400), {}, {}, {}};
  const flexbody::ModalEnergies energies =
      response.evaluate_energies(mode.times);
  mode.kinetic = energies.kinetic.row(0).transpose();
  mode.elastic = energies.elastic.row(0).transpose();
  mode.corrected = energies.corrected().row(0).transpose();
  return mode;
}

Plot draw_single_mode(const SingleMode& mode) {
  const std::vector<double>& t = mode.times;
  std::vector<double> load;
  for (const double time : t) load.push_back(find_load(time));
  Plot plot;
  plot.columns = 3;
  plot.panel_width = 420;
  plot.panels = {
      {.title = "energies",
       .x_label = "time [s]",
       .y_label = "energy [J]",
       .curves = {{"kinetic", t, to_list(mode.kinetic)},
                  {"elastic", t, to_list(mode.elastic)},
                  {"total", t, to_list(mode.total())}},
       .commands = {}},
      {.title = "modal load",
       .x_label = "time [s]",
       .y_label = "load [kg^{1/2} m/s^2]",
       .curves = {{"", t, load}},
       .commands = {}},
      {.title = "energy - load x displacement",
       .x_label = "time [s]",
       .y_label = "energy [J]",
       .curves = {{"corrected", t, to_list(mode.corrected)},
                  {"total", t, to_list(mode.total()), Mark::thin_line}},
       .commands = {}}};
  return plot;
}

void write_single_mode(Page& page) {
  const SingleMode mode = simulate_single_mode();
  const double variation =
      find_variation(mode.corrected, mode.total().maxCoeff(), mode.times);
  page.heading("Figure 10: energy of one mode under steps");
  page.text(fmt::format(
      "omega = 198 rad/s, initial modal velocity 1, steps to 150, -100, 200 "
      "and 0 at 0.02, 0.05, 0.08 and 0.11 s (chosen here; the report's are "
      "only in a picture). Within an interval of constant load the energy "
      "corrected for the load varies by at most {:.1e} of the largest energy.",
      variation));
  page.figure(draw_single_mode(mode), "figure10",
              "Figure 10: energies, load, corrected energy");
  page.check(variation < 1e-13,
             "the corrected energy is constant to 1e-13, also before and after "
             "the load, where it is the energy itself.");
}

/// The free beam turning at 1 rad/s about x.
struct Rotation {
  std::string level;
  Fidelity fidelity;
  IntegratorKind integrator;
  std::vector<double> times = {};      // [s]
  std::vector<double> elastic = {};    // [J]
  std::vector<double> kinetic = {};    // less the energy at the start [J]
  std::vector<double> variation = {};  // of the total, relative [-]
  double start = 0.0;                  // total [J]

  [[nodiscard]] std::string scheme() const {
    return dynamics::to_string(integrator);
  }
  [[nodiscard]] double worst() const {
    return *std::max_element(variation.begin(), variation.end());
  }
};

void simulate_rotation(const Body& body, Rotation& rotation) {
  const auto model = make_free_beam(body, rotation.fidelity, {});
  dynamics::SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Vector3::UnitX();
  const Run result = run(model, state,
                         {.integrator = rotation.integrator,
                          .end_time = 0.02,
                          .step = 1e-5,
                          .output_times = spread_times(0.02, 1000)});
  rotation.times = result.times;
  rotation.start = result.energies[0].total();
  for (const dynamics::EnergyBalance& e : result.energies) {
    rotation.elastic.push_back(e.elastic);
    rotation.kinetic.push_back(e.kinetic_rigid + e.kinetic_modal -
                               rotation.start);
    rotation.variation.push_back(std::abs(e.total() - rotation.start) /
                                 rotation.start);
  }
}

Plot draw_rotations(const std::vector<Rotation>& rotations) {
  Panel elastic{.title = "elastic energy",
                .x_label = "time [s]",
                .y_label = "energy [J]",
                .curves = {},
                .commands = {"set format y '%.1e'"}};
  Panel kinetic = elastic;
  kinetic.title = "kinetic energy less its start";
  Panel total{.title = "coupled: total energy, relative variation",
              .x_label = "time [s]",
              .y_label = "|E - E_0| / E_0",
              .is_log_y = true,
              .curves = {},
              .commands = {"set yrange [1e-17:*]"}};
  for (const Rotation& r : rotations) {
    if (r.integrator == IntegratorKind::generalized_alpha) {
      elastic.curves.push_back({r.level, r.times, r.elastic});
      kinetic.curves.push_back({r.level, r.times, r.kinetic});
    }
    if (r.fidelity == Fidelity::coupled) {
      total.curves.push_back({r.scheme(), r.times, r.variation});
      // Zero has no logarithm; there is nothing to see below half an ulp.
      for (double& v : total.curves.back().y) v = std::max(v, 1e-17);
    }
  }
  return {{elastic, kinetic, total}, 3, 420, 330};
}

void explain_rotations(Page& page, const std::vector<Rotation>& rotations) {
  double ours = 0.0;
  double euler = 0.0;
  for (const Rotation& r : rotations) {
    if (r.fidelity != Fidelity::coupled) continue;
    double& worst =
        r.integrator == IntegratorKind::explicit_euler ? euler : ours;
    worst = std::max(worst, r.worst());
  }
  page.text(
      "`uncoupled` has kinetic energy alone. `one-way` stretches the beam by "
      "the centrifugal force without a loss of kinetic energy: its total is "
      "wrong by the elastic energy. `coupled` exchanges the two; the remaining "
      "variation is the scheme's error.");
  page.check(ours < 1e-12,
             fmt::format("`coupled` varies by less than 1e-12 of the total "
                         "({:.1e}).",
                         ours));
  page.check(ours < euler,
             fmt::format("that is less than with the report's scheme at the "
                         "same step ({:.1e}).",
                         euler));
}

void write_free_rotation(Page& page, const Body& body) {
  std::vector<Rotation> rotations = {
      {"uncoupled", Fidelity::uncoupled, IntegratorKind::generalized_alpha},
      {"one-way", Fidelity::one_way, IntegratorKind::generalized_alpha},
      {"coupled", Fidelity::coupled, IntegratorKind::generalized_alpha},
      {"coupled", Fidelity::coupled, IntegratorKind::runge_kutta_4},
      {"coupled", Fidelity::coupled, IntegratorKind::explicit_euler}};
  std::vector<std::vector<std::string>> rows;
  for (Rotation& r : rotations) {
    simulate_rotation(body, r);
    rows.push_back({r.level, r.scheme(), fmt::format("{:.4f}", r.start),
                    fmt::format("{:.2e}", *std::max_element(r.elastic.begin(),
                                                            r.elastic.end())),
                    fmt::format("{:.1e}", r.worst())});
  }
  page.heading("Figure 11: energy of free rotation");
  page.text(
      "The free beam, undeformed at first, rotating at 1 rad/s about x; steps "
      "of 1e-5 s, 0.02 s (ten periods of the first axial mode, which it "
      "excites). The report sees variations of some 1e-12 of the total energy "
      "in its CoupledRB.");
  page.table({"level", "integrator", "energy [J]", "largest elastic [J]",
              "variation / total"},
             rows);
  page.figure(draw_rotations(rotations), "figure11",
              "Figure 11: energy of free rotation");
  explain_rotations(page, rotations);
}

}  // namespace

void write_energy(Page& page, Shared& shared) {
  write_single_mode(page);
  write_free_rotation(page, shared.beam());
}

}  // namespace limber::bench
