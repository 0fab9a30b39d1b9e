// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "limber/flexbody/modal/modal_response.hpp"
#include "sections.hpp"

/// Figure 7: a sinusoidal load as steps, against Eq. 37.
namespace limber::bench {
namespace {

constexpr double kOmega = 1096.0;  // the mode [rad/s]
constexpr double kEnd = 0.08;      // of the comparison [s]

struct Case {
  std::string name;
  double forcing;  // omega_F [rad/s]
};

/// Report, eq. 37.
double find_exact(double forcing, double t) {
  if (forcing == kOmega) return t / (2.0 * kOmega) * std::sin(kOmega * t);
  return (std::cos(forcing * t) - std::cos(kOmega * t)) /
         (kOmega * kOmega - forcing * forcing);
}

VectorX sample_exact(double forcing, const std::vector<double>& times) {
  VectorX exact(std::ssize(times));
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    exact[i] = find_exact(forcing, times[static_cast<std::size_t>(i)]);
  }
  return exact;
}

/// cos(forcing t) as steps, each with its value at the middle.
flexbody::ModalLoads make_steps(double forcing, int per_period) {
  const double h = 2.0 * M_PI / forcing / per_period;
  const auto count = static_cast<Eigen::Index>(std::ceil(kEnd / h)) + 1;
  flexbody::ModalLoads loads;
  loads.steps.values.resize(1, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    loads.steps.times.push_back(n * h);
    loads.steps.values(0, i) = std::cos(forcing * (n + 0.5) * h);
  }
  return loads;
}

flexbody::ModalLoads make_sinusoid(double forcing) {
  flexbody::ModalLoads loads;
  loads.sinusoids.push_back(
      {.omega = forcing, .cosine = VectorX::Ones(1), .sine = VectorX::Zero(1)});
  return loads;
}

VectorX respond(const flexbody::ModalLoads& loads,
                const std::vector<double>& times) {
  const flexbody::ModalResponse response(VectorX::Constant(1, kOmega * kOmega),
                                         VectorX::Zero(1), loads, {});
  return response.evaluate(times).eta.row(0).transpose();
}

/// Largest error over the largest exact value.
double find_error(const VectorX& answer, const VectorX& exact) {
  return (answer - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

Panel draw_case(const Case& c, const std::vector<double>& times) {
  constexpr int kPerPeriod = 8;
  Panel panel;
  panel.title =
      fmt::format("{}: {:g} on {:g} rad/s", c.name, c.forcing, kOmega);
  panel.x_label = "time [s]";
  panel.y_label = "r";
  panel.curves = {{"Eq. 37", times, to_list(sample_exact(c.forcing, times))},
                  {fmt::format("{} steps a period", kPerPeriod), times,
                   to_list(respond(make_steps(c.forcing, kPerPeriod), times)),
                   Mark::dashed}};
  panel.commands = {"set format y '%.1e'"};
  return panel;
}

}  // namespace

void write_step_approximation(Page& page) {
  page.heading("Figure 7: loads as steps");
  page.text(
      "r'' + omega^2 r = cos(omega_F t) from rest, the load held at its "
      "mid-step value over each step; the closed form is the report's Eq. 37. "
      "Errors are the largest over 0.08 s, relative to the largest |r|.");
  const std::vector<Case> cases = {{"not resonant", 400.0},
                                   {"resonant", kOmega}};
  const std::vector<double> times = spread_times(kEnd, 1600);
  Plot plot;
  plot.columns = 3;
  plot.panel_width = 420;
  Panel errors;
  errors.title = "error against steps a period";
  errors.x_label = "steps a period";
  errors.y_label = "relative error";
  errors.is_log_x = errors.is_log_y = true;
  errors.commands = {"set format x '%g'", "set key bottom left"};
  const std::vector<int> counts = {4, 8, 16, 32, 64, 128, 256, 512, 1024};
  std::vector<std::vector<std::string>> rows;
  for (const int n : counts) rows.push_back({fmt::format("{}", n)});
  rows.push_back({"order, last two"});
  rows.push_back({"sinusoidal load"});
  for (const Case& c : cases) {
    const VectorX exact = sample_exact(c.forcing, times);
    Curve curve{c.name, {}, {}, Mark::line_points};
    for (std::size_t i = 0; i < counts.size(); ++i) {
      curve.x.push_back(counts[i]);
      curve.y.push_back(
          find_error(respond(make_steps(c.forcing, counts[i]), times), exact));
      rows[i].push_back(fmt::format("{:.2e}", curve.y.back()));
    }
    const double order =
        std::log2(curve.y[curve.y.size() - 2] / curve.y.back());
    const double sinusoid =
        find_error(respond(make_sinusoid(c.forcing), times), exact);
    rows[counts.size()].push_back(fmt::format("{:.3f}", order));
    rows[counts.size() + 1].push_back(fmt::format("{:.1e}", sinusoid));
    plot.panels.push_back(draw_case(c, times));
    errors.curves.push_back(curve);
    page.check(std::abs(order - 2.0) < 0.05 && sinusoid < 1e-12,
               fmt::format("{}: second order in the step; round-off with the "
                           "sinusoid itself.",
                           c.name));
  }
  plot.panels.push_back(errors);
  page.table({"steps a period", "error, not resonant", "error, resonant"},
             rows);
  page.figure(plot, "figure07",
              "Figure 7: Eq. 37 by steps (eight a period), and the error");
}

}  // namespace limber::bench
