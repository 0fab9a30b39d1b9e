// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/decision_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/dynamics/equations/node_motion.hpp"
#include "sections.hpp"

/// Figure 9: where `uncoupled` neglects too much, and simulated dots.
namespace limber::bench {
namespace {

using dynamics::Fidelity;
using dynamics::IntegratorKind;

constexpr double kNegligible = 1e-6;  // [m]
constexpr double kLinear = 0.05;      // [m]
constexpr double kFast = 100.0;       // gain that ends a run [rad/s]

/// One simulated combination.
struct Dot {
  double alpha = 0.0;       // about x, by a couple on the end faces [rad/s^2]
  double Omega = 0.0;       // the largest of the run [rad/s]
  double difference = 0.0;  // largest RMS over nodes, coupled - uncoupled [m]
  double own = 0.0;         // largest RMS of `uncoupled` itself [m]

  [[nodiscard]] double sum() const { return alpha + Omega * Omega; }
};

Run spin_up(const Body& body, Fidelity level, double alpha, double Omega) {
  // 3.7 periods of the first mode, or until it turns fast.
  const double end = std::min(0.02, kFast / std::max(alpha, 1.0));  // [s]
  StepForces forces;
  if (alpha > 0.0) {
    const VectorX couple = make_couple(*body, -Vector3::UnitY());
    const double torque =
        flexbody::reduce_nodal_load(*body, {0.0}, couple).moment(0, 0);
    forces = {{0.0}, couple * (alpha * body->inertia()(0, 0) / torque)};
  }
  const auto model = make_free_beam(body, level, forces);
  dynamics::SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Omega * Vector3::UnitX();
  return run(model, state,
             {.integrator = IntegratorKind::runge_kutta_4,
              .end_time = end,
              .step = 5e-5,
              .output_times = spread_times(end, 200)});
}

MatrixX find_deformation(const Body& body, const Run& run) {
  const auto model = make_free_beam(body, Fidelity::uncoupled, {});
  MatrixX u(body->rows.x_B.size(), std::ssize(run.states));
  calc_node_deformations(model, dynamics::BodyIndex(0), run.states, u);
  return u;
}

/// Largest over time of the root mean square over nodes [m].
double find_largest(const MatrixX& u) {
  const Eigen::Index nodes = u.rows() / 3;
  return u.colwise().norm().maxCoeff() / std::sqrt(nodes);
}

Dot simulate_dot(const Body& body, double alpha, double Omega) {
  const Run coupled = spin_up(body, Fidelity::coupled, alpha, Omega);
  const Run uncoupled = spin_up(body, Fidelity::uncoupled, alpha, Omega);
  const MatrixX u = find_deformation(body, uncoupled);
  return {alpha, uncoupled.states.back().bodies[0].w_WB_B.norm(),
          find_largest(find_deformation(body, coupled) - u), find_largest(u)};
}

std::vector<Dot> sweep(const Body& body) {
  const std::vector<double> alphas = {0.0, 0.01, 0.1,  0.3,   0.7,   1.1,
                                      3.0, 10.0, 30.0, 100.0, 300.0, 1e3,
                                      3e3, 1e4,  3e4,  5e4,   7e4};
  const std::vector<double> Omegas = {0.0,   0.03,  0.1,   0.3,  0.7,   1.05,
                                      1.5,   3.0,   10.0,  30.0, 100.0, 200.0,
                                      243.0, 300.0, 400.0, 600.0};
  std::vector<Dot> dots;
  for (const double alpha : alphas) {
    for (const double Omega : Omegas) {
      if (alpha + Omega > 0.0) dots.push_back(simulate_dot(body, alpha, Omega));
    }
  }
  return dots;
}

/// Dots on the unsafe side of `boundary`: below it, yet off by more than
/// `limit`.
int count_unsafe(const std::vector<Dot>& dots, double boundary, double limit) {
  return static_cast<int>(
      std::count_if(dots.begin(), dots.end(), [&](const Dot& dot) {
        return dot.sum() <= boundary && dot.difference > limit;
      }));
}
int count_below(const std::vector<Dot>& dots, double boundary) {
  return static_cast<int>(
      std::count_if(dots.begin(), dots.end(),
                    [&](const Dot& dot) { return dot.sum() <= boundary; }));
}
/// Dots above `boundary` that are nevertheless off by no more than `limit`.
int count_cautious(const std::vector<Dot>& dots, double boundary,
                   double limit) {
  return static_cast<int>(
      std::count_if(dots.begin(), dots.end(), [&](const Dot& dot) {
        return dot.sum() > boundary && dot.difference <= limit;
      }));
}

/// alpha = 0 is drawn at the foot of the logarithmic axis, as in the report.
constexpr double kFoot = 2e-3;

Curve draw_boundary(const std::string& name, double boundary, int colour) {
  Curve curve{name, {}, {}, Mark::line, colour};
  for (int i = 0; i <= 400; ++i) {
    const double alpha =
        kFoot * std::pow(boundary / kFoot, static_cast<double>(i) / 400.0);
    curve.x.push_back(std::sqrt(std::max(boundary - alpha, 1e-12)));
    curve.y.push_back(alpha);
  }
  return curve;
}

Plot draw_dots(const std::vector<Dot>& dots, double near, double far) {
  Panel panel;
  panel.title = "coupled - uncoupled, RMS over nodes";
  panel.x_label = "Omega [rad/s]";
  panel.y_label = "alpha [rad/s^2] (0 at the foot)";
  panel.is_log_x = panel.is_log_y = true;
  panel.curves = {draw_boundary("report's boundary, 1 um", near, 2),
                  draw_boundary("report's boundary, 5 cm", far, 1),
                  {"below 1 um", {}, {}, Mark::points, 2},
                  {"1 um to 5 cm", {}, {}, Mark::points, 4},
                  {"above 5 cm", {}, {}, Mark::points, 1}};
  for (const Dot& dot : dots) {
    const std::size_t kind = dot.difference <= kNegligible ? 2
                             : dot.difference <= kLinear   ? 3
                                                           : 4;
    panel.curves[kind].x.push_back(dot.Omega);
    panel.curves[kind].y.push_back(std::max(dot.alpha, kFoot));
  }
  panel.commands = {"set key outside right",
                    fmt::format("set yrange [{}:2e5]", kFoot / 2.0),
                    "set xrange [1e-4:1e3]"};
  return {{panel}, 1, 860, 480};
}

}  // namespace

void write_decision_boundary(Page& page, Shared& shared) {
  const Body& body = shared.beam();
  const fem::SparseMatrix& M_s = shared.free().matrices.M_s;
  const VectorX lumped = M_s * VectorX::Ones(M_s.cols());
  const auto report_boundary = [&](double limit) {
    return flexbody::find_report_displacement_boundary(
        body->rows.Phi_B, body->lambda, lumped, body->rows.x_B, limit);
  };
  const double near = report_boundary(kNegligible);
  const double far = report_boundary(kLinear);
  const flexbody::InertialDisplacementBound slow(*body);
  const flexbody::InertialDisplacementBound sudden(*body,
                                                   flexbody::Onset::sudden);
  const auto square = [](double Omega) { return Omega * Omega; };
  page.heading("Figure 9: where coupling matters");
  page.text(
      "|alpha| + |Omega|^2 at the displacement-limited boundary (report, eq. "
      "32), and the largest Omega^2 at which a bound that holds for every "
      "direction stays below the limit "
      "([choosing](../../../docs/theory/choosing.md)).");
  page.table(
      {"limit", "report", "Limber, report's formula", "Omega^2 bound, sudden",
       "Omega^2 bound, slow"},
      {{"1 um", "1.19", fmt::format("{:.4f}", near),
        fmt::format("{:.3f}", square(sudden.find_omega(0.0, kNegligible))),
        fmt::format("{:.3f}", square(slow.find_omega(0.0, kNegligible)))},
       {"5 cm", "59570", fmt::format("{:.0f}", far),
        fmt::format("{:.0f}", square(sudden.find_omega(0.0, kLinear))),
        fmt::format("{:.0f}", square(slow.find_omega(0.0, kLinear)))}});
  page.check(std::abs(near / 1.19 - 1.0) < 0.005 &&
                 std::abs(far / 59570.0 - 1.0) < 0.005,
             "the report's two figures within 0.5 %.");
  const std::vector<Dot> dots = sweep(body);
  page.text(fmt::format(
      "{} dots: the beam starts undeformed at Omega about x, and the couple "
      "of Figure 6b (equal forces on all nodes of the end faces) gives it "
      "alpha about x, for 20 ms or until that has added 100 rad/s. A dot's "
      "colour is the largest "
      "root-mean-square over all nodes of the difference in deformation (in "
      "the body frame) between `coupled` and `uncoupled`; its place is alpha "
      "and the run's largest Omega. Runge-Kutta, steps of 5e-5 s.",
      dots.size()));
  page.figure(draw_dots(dots, near, far), "figure09",
              "Figure 9: decision boundaries and simulated dots");
  for (const auto& [boundary, limit, name] :
       {std::tuple{near, kNegligible, "1 um"},
        std::tuple{far, kLinear, "5 cm"}}) {
    page.check(count_unsafe(dots, boundary, limit) == 0 &&
                   count_below(dots, boundary) > 0,
               fmt::format("no dot on the unsafe side of the {} boundary: of "
                           "{} below it, {} differ by more. ({} above it "
                           "differ by less.)",
                           name, count_below(dots, boundary),
                           count_unsafe(dots, boundary, limit),
                           count_cautious(dots, boundary, limit)));
  }
}

}  // namespace limber::bench
