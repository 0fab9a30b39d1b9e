// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "beam_choices.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "sections.hpp"

/// Scene 5: a spin so fast that linear elasticity stops being enough.
namespace limber::bench::trade {
namespace {

using flexbody::MaterialLaw;

const std::vector<double> kRates = {3,   10,  30,  60,
                                    100, 200, 300, 400};  // [rad/s]
constexpr IntegratorKind kScheme = IntegratorKind::runge_kutta_4;
constexpr double kStep = 5e-5;  // of the reduced levels [s]

std::function<void(scene::Scene&)> spin_at(double rate) {
  return [rate](scene::Scene& scene) {
    scene.scenario.base.angular_velocity = {rate, 0.0, 0.0};
  };
}

Choice make_level(Fidelity level, int modes = 40) {
  return make_stepped(fmt::format("{} modes", modes), level,
                      make_basis(modes, false), kScheme, kStep);
}

Choice make_neo_hookean() {
  Choice choice = make_reference();
  choice.name = "full, neo-Hookean, Runge-Kutta 1.7e-5 s";
  choice.label = "neo-Hookean";
  choice.full.law = MaterialLaw::neo_hookean;
  return choice;
}

/// Frequency of the tip's swing along x, across the plane of the spin, from
/// its zeros [Hz]; none if it has fewer than five.
double find_frequency(const Outcome& outcome) {
  const MatrixX u = find_deformation(outcome);
  const auto& rows = outcome.run.built.model.bodies[0].reduced->rows.tags;
  const auto tip = std::find(rows.begin(), rows.end(), 5U) - rows.begin();
  std::vector<double> zeros;
  const std::vector<double>& t = outcome.run.history.times;
  constexpr double kAfterStrike = 0.003;  // [s]
  for (Eigen::Index j = 1; j < u.cols(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    const double a = u(3 * tip, j - 1);
    const double b = u(3 * tip, j);
    if (t[i] < kAfterStrike || (a < 0.0) == (b < 0.0)) continue;
    zeros.push_back(t[i - 1] + (t[i] - t[i - 1]) * a / (a - b));
  }
  if (zeros.size() < 5) return std::nan("");
  return 0.5 * static_cast<double>(zeros.size() - 1) /
         (zeros.back() - zeros.front());
}

/// What one spin rate gives; not a number where a run stopped.
struct Point {
  double rate = 0.0;     // [rad/s]
  double stretch = 0.0;  // largest deformation of any node [m]
  // Of uncoupled, one-way, coupled, nonlinear [-].
  std::vector<double> errors = {};
  double neo_hookean = 0.0;              // from St. Venant-Kirchhoff [-]
  std::vector<double> frequencies = {};  // coupled, nonlinear, full [Hz]
  Fidelity advised = Fidelity::rigid;
  std::vector<std::string> stops = {};
};

double find_largest(const MatrixX& u) {
  const Eigen::Map<const Matrix3X> nodes(u.data(), 3, u.size() / 3);
  return nodes.colwise().norm().maxCoeff();
}

Point study_rate(double rate, const Context& context) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Study study("spin", context.cache);
  const auto at_rate = [&](Choice choice) {
    choice.change = spin_at(rate);
    choice.repeats = 1;
    return choice;
  };
  const Outcome& full = study.add_reference(at_rate(make_reference()));
  Point point{.rate = rate, .stretch = find_largest(find_deformation(full))};
  for (const Fidelity level : {Fidelity::uncoupled, Fidelity::one_way,
                               Fidelity::coupled, Fidelity::nonlinear}) {
    const Outcome& run = study.add(at_rate(make_level(level)));
    point.errors.push_back(run.error ? run.deformation() : kNone);
    if (!run.stopped.empty()) point.stops.push_back(run.stopped);
    if (level < Fidelity::coupled) continue;
    point.frequencies.push_back(run.error ? find_frequency(run) : kNone);
  }
  point.frequencies.push_back(find_frequency(full));
  const Outcome& other = study.add(at_rate(make_neo_hookean()));
  point.neo_hookean = other.error ? other.deformation() : kNone;
  scene::Scene scene = scene::load_scene(study.file());
  spin_at(rate)(scene);
  point.advised = app::advise(scene, context.cache, {}).levels[0].advice.level;
  return point;
}

std::string to_cell(double fraction) {
  return std::isfinite(fraction) ? to_percent(fraction) : "stopped";
}

void write_sweep(Page& page, const std::vector<Point>& points) {
  std::vector<std::vector<std::string>> rows;
  Panel errors{.title = "error of the deformation against full",
               .x_label = "spin rate [rad/s]",
               .y_label = "percent",
               .is_log_x = true,
               .is_log_y = true,
               .curves = {{"uncoupled", {}, {}, Mark::line_points},
                          {"one-way", {}, {}, Mark::line_points},
                          {"coupled", {}, {}, Mark::line_points},
                          {"nonlinear", {}, {}, Mark::line_points},
                          {"neo-Hookean full", {}, {}, Mark::dashed}},
               .commands = {}};
  Panel swing{.title = "swing across the plane of the spin",
              .x_label = "spin rate [rad/s]",
              .y_label = "frequency [Hz]",
              .curves = {{"coupled", {}, {}, Mark::line_points, 2},
                         {"nonlinear", {}, {}, Mark::line_points, 3},
                         {"full", {}, {}, Mark::line_points, 6}},
              .commands = {}};
  const auto put = [](Curve& curve, double x, double y) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  };
  for (const Point& point : points) {
    rows.push_back({fmt::format("{:g}", point.rate),
                    fmt::format("{:.2g}", 1e3 * point.stretch),
                    to_cell(point.errors[0]), to_cell(point.errors[1]),
                    to_cell(point.errors[2]), to_cell(point.errors[3]),
                    to_cell(point.neo_hookean),
                    fmt::format("{:.1f}", point.frequencies[0]),
                    fmt::format("{:.1f}", point.frequencies[1]),
                    fmt::format("{:.1f}", point.frequencies[2]),
                    std::string(to_string(point.advised))});
    for (std::size_t i = 0; i < point.errors.size(); ++i) {
      put(errors.curves[i], point.rate, 100.0 * point.errors[i]);
    }
    put(errors.curves.back(), point.rate, 100.0 * point.neo_hookean);
    for (std::size_t i = 0; i < point.frequencies.size(); ++i) {
      put(swing.curves[i], point.rate, point.frequencies[i]);
    }
  }
  page.table({"spin [rad/s]", "largest deformation [mm]", "uncoupled %",
              "one-way %", "coupled %", "nonlinear %", "neo-Hookean full %",
              "swing, coupled [Hz]", "nonlinear [Hz]", "full [Hz]", "advised"},
             rows);
  page.figure({{errors, swing}, 2, 560, 380}, "spin_rates",
              "Errors of deformation over spin rate, and the frequency of the "
              "struck beam's swing");
}

void add_runs(Study& study) {
  add_whole_meshes(study);
  study.add(make_neo_hookean());
  study.add(make_stepped("no modes", Fidelity::rigid, make_basis(10, false),
                         kScheme, 5e-4));
  study.add(make_level(Fidelity::uncoupled, 10));
  study.add(make_level(Fidelity::one_way, 10));
  study.add(make_level(Fidelity::coupled, 10));
  study.add(make_level(Fidelity::coupled, 40));
  study.add(make_level(Fidelity::nonlinear, 10));
  study.add(make_level(Fidelity::nonlinear, 40));
  study.add(make_stepped("10 modes", Fidelity::coupled, make_basis(10, false),
                         IntegratorKind::generalized_alpha, 2e-4));
}

void write(Page& page, const Context& context, const Study& study,
           const Verdict& verdict, const std::vector<Point>& points) {
  const Point& slow = points.front();
  const Point& fast = points[4];
  page.heading("Scene 5: a fast spin, where linear elasticity ends");
  page.text(fmt::format(
      "In 0.1 s `coupled` becomes {} % off in deformation at {:g} rad/s and {} "
      "% at {:g}. A beam that spins is stiffened and vibrates faster, {:.1f} "
      "Hz instead of {:.1f} at {:g} rad/s; linear elasticity lacks this, but "
      "includes the softening by rotation. So `coupled` is not much better "
      "than `one-way` here, and most of the error is one of phase, which grows "
      "with time. `nonlinear` has the stiffening of bending, {:.1f} Hz, and is "
      "{} % off: the beam, spun at once, rings along its length, where this "
      "level is linear. So does the material law make a difference: {} % with "
      "the neo-Hookean. The report's beam is spun about x and struck at its "
      "tip ([scene](../scenes/spin.toml)); outputs every 0.5 ms.",
      to_percent(slow.errors[2]), slow.rate, to_percent(fast.errors[2]),
      fast.rate, fast.frequencies[2], slow.frequencies[2], fast.rate,
      fast.frequencies[1], to_percent(fast.errors[3]),
      to_percent(fast.neo_hookean)));
  page.text("The choices at 100 rad/s:");
  write_choices(page, context.folder, "spin", "fast spin, 100 rad/s", study,
                find_lumped(study));
  write_verdict(page, verdict);
  page.text(
      "Over the spin rate, 40 eigenmodes in steps of 0.05 ms against the whole "
      "mesh of St. Venant-Kirchhoff material. The dashed line is the same "
      "whole mesh with the other law, neo-Hookean: where it rises, the strains "
      "are no longer small and the material law matters. *Advised*: the level "
      "that `limber advise` names.");
  write_sweep(page, points);
  for (const Point& point : points) {
    for (const std::string& stop : point.stops) {
      page.text(
          fmt::format("At {:g} rad/s a run stopped: {}.", point.rate, stop));
    }
  }
}

/// Where `coupled` or `nonlinear` is off by more than 10 %, the advice should
/// be a level above it.
void claim_advice(Context& context, const std::vector<Point>& points) {
  std::string reported;
  bool is_held = true;
  for (const Point& point : points) {
    const bool is_coupled_wrong = !(point.errors[2] < 0.1);
    const bool is_nonlinear_wrong = !(point.errors[3] < 0.1);
    const Fidelity needed = is_nonlinear_wrong ? Fidelity::full
                            : is_coupled_wrong ? Fidelity::nonlinear
                                               : Fidelity::rigid;
    is_held = is_held && point.advised >= needed;
    reported += fmt::format("{}{:g} rad/s {}", reported.empty() ? "" : ", ",
                            point.rate, to_string(point.advised));
  }
  context.claims.push_back(
      {is_held,
       fmt::format("Scene 5: spin: `limber advise` names no level that is off "
                   "by more than 10 % in deformation: {}.",
                   reported),
       "its estimates are of the first order in the strain."});
}

}  // namespace

Writer study_spin(Context& context) {
  const auto study = std::make_shared<Study>("spin", context.cache);
  add_runs(*study);
  const Verdict verdict =
      judge_advice(*study, make_level(Fidelity::coupled, 10));
  std::vector<Point> points;
  points.reserve(kRates.size());
  for (const double rate : kRates) points.push_back(study_rate(rate, context));
  add_verdict_claim(context, "Scene 5: spin", verdict);
  claim_advice(context, points);
  return [study, verdict, points, &context](Page& page) {
    write(page, context, *study, verdict, points);
  };
}

}  // namespace limber::bench::trade
