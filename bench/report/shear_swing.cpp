// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "beam_theory.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "limber/flexbody/modal/modal_response.hpp"
#include "sections.hpp"

/// Figure 14, and where the report's 191 rad/s comes from.
namespace limber::bench {
namespace {

/// The tip under a step load by ten modes, as the report ran it.
struct Swing {
  std::vector<double> times;  // [s]
  VectorX u;                  // of the loaded edge's corner, along x [m]
  double settled = 0.0;       // mean over all time: the static response [m]
};

Swing simulate_swing(int modes, const VectorX& load,
                     const fem::Eigenmodes& eigen, Eigen::Index observed) {
  Swing swing;
  swing.times = spread_times(0.1, 20000);
  const MatrixX Phi = eigen.Phi.leftCols(modes);
  flexbody::ModalLoads loads;
  loads.steps.times = {0.0};
  loads.steps.values = Phi.transpose() * load;
  const flexbody::ModalResponse response(eigen.lambda.head(modes),
                                         VectorX::Zero(modes), loads, {});
  swing.u =
      (Phi.row(observed) * response.evaluate(swing.times).eta).transpose();
  swing.settled = Phi.row(observed).dot(
      loads.steps.values.cwiseQuotient(eigen.lambda.head(modes)).col(0));
  return swing;
}

/// What a reader of the curve measures: half of the first maximum, and the
/// time from it to the second.
BeamAnswer read_off(const Swing& swing) {
  const auto find_peak = [&](double from, double to) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < swing.times.size(); ++i) {
      if (swing.times[i] < from || swing.times[i] > to) continue;
      const auto at = static_cast<Eigen::Index>(i);
      if (best == 0 || swing.u[at] > swing.u[static_cast<Eigen::Index>(best)]) {
        best = i;
      }
    }
    return best;
  };
  constexpr double kPeriod = 0.0317;  // of the first mode [s]
  const std::size_t first = find_peak(0.0, kPeriod);
  const std::size_t second = find_peak(kPeriod, 2.0 * kPeriod);
  return {0.5 * swing.u[static_cast<Eigen::Index>(first)],
          2.0 * M_PI / (swing.times[second] - swing.times[first])};
}

/// First frequency with row sums as masses: the largest 1 / omega^2 of
/// K^-1 M, by the power method on the beam's bending shape.
double find_lumped_omega(const ClampedBeam& beam) {
  const fem::ElasticInverse inverse = invert(beam);
  const VectorX row_sums =
      beam.matrices.M_s * VectorX::Ones(beam.matrices.M_s.cols());
  VectorX masses(beam.x.size());
  for (Eigen::Index c = 0; c < 3; ++c) {
    masses(Eigen::seqN(c, beam.x.cols(), 3)) = row_sums;
  }
  VectorX shape = inverse.solve(beam.face);
  double ratio = 0.0;
  for (int i = 0; i < 30; ++i) {
    const VectorX force = masses.cwiseProduct(shape);
    const VectorX next = inverse.solve(force);
    ratio = force.dot(next) / force.dot(shape);
    shape = next / next.norm();
  }
  return 1.0 / std::sqrt(ratio);
}

/// The clamped beam of 579 nodes, its modes, and the load on the tip's edge.
struct ShearTest {
  ClampedBeam beam;
  fem::Eigenmodes eigen;
  VectorX edge;             // 500 N shared by the five nodes of x = 0, z = 5
  Eigen::Index corner = 0;  // x of the node (0, 0, 5)

  [[nodiscard]] Swing swing(int modes, const VectorX& load) const {
    return simulate_swing(modes, load, eigen, corner);
  }
};

ShearTest make_shear_test() {
  ShearTest test{make_clamped_beam(make_recipe().mesh.file, {}), {}, {}};
  test.eigen = fem::find_eigenmodes(invert(test.beam), 40);
  const Matrix3X& x = test.beam.x;
  test.edge = VectorX::Zero(x.size());
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    if (!is_at(x(0, n), 0.0) || !is_at(x(2, n), kLength)) continue;
    test.edge[3 * n] = kTipForce / 5.0;
    if (is_at(x(1, n), 0.0)) test.corner = 3 * n;
  }
  return test;
}

/// Mean of the curve from its start to `end` [s].
double find_mean(const Swing& swing, double end) {
  const auto count = static_cast<Eigen::Index>(std::lround(
      end / swing.times.back() * static_cast<double>(swing.times.size() - 1)));
  return swing.u.head(count + 1).mean();
}

/// A choice that the report may have made, and what comes of it; 0: nothing.
struct Choice {
  std::string what;
  BeamAnswer answer;
};

std::vector<Choice> try_choices(const ShearTest& test) {
  const double omega = std::sqrt(test.eigen.lambda[0]);
  const auto box = find_source_file("meshes/box/box.geo");
  const auto settle = [&](int modes, const VectorX& load) {
    return BeamAnswer{test.swing(modes, load).settled, omega};
  };
  const auto read = [&](int modes, const VectorX& load) {
    return read_off(test.swing(modes, load));
  };
  const VectorX& edge = test.edge;
  const VectorX& face = test.beam.face;
  const Swing ten = test.swing(kModes, edge);
  return {{"report", {1.26e-6, 191.0}},
          {"row sums as masses", {0.0, find_lumped_omega(test.beam)}},
          {"first-order elements, size 0.55",
           find_answer(make_clamped_beam(box, {0.55, 1, 1.0}))},
          {"static, 1 mode", settle(1, edge)},
          {"static, 5 modes", settle(5, edge)},
          {"static, 10 modes, load on the edge's nodes", settle(kModes, edge)},
          {"static, 10 modes, load spread over the face", settle(kModes, face)},
          {"static, 40 modes", settle(40, edge)},
          {"mean over one period (31.7 ms)",
           {find_mean(ten, 2.0 * M_PI / omega), 0.0}},
          {"mean over 0.1 s", {find_mean(ten, 0.1), 0.0}},
          {"read off the curve, 1 mode", read(1, edge)},
          {"read off the curve, 10 modes, face", read(kModes, face)},
          {"read off the curve, 10 modes, edge", read(kModes, edge)}};
}

void add_choices(Page& page, const std::vector<Choice>& choices) {
  std::vector<std::vector<std::string>> rows;
  for (const Choice& c : choices) {
    const double u = c.answer.deflection;
    const double omega = c.answer.omega;
    rows.push_back({c.what, u > 0.0 ? fmt::format("{:.3e}", u) : "",
                    omega > 0.0 ? fmt::format("{:.1f}", omega) : ""});
  }
  page.table({"choice", "deflection [m]", "omega [rad/s]"}, rows);
}

Plot draw_swing(const Swing& swing) {
  const BeamAnswer thin = find_euler_bernoulli();
  std::vector<double> theory;
  for (const double t : swing.times) {
    theory.push_back(thin.deflection * (1.0 - std::cos(thin.omega * t)));
  }
  const Panel panel{.title = "tip under a step of 500 N",
                    .x_label = "time [s]",
                    .y_label = "displacement [m]",
                    .curves = {{"Limber, ten modes", swing.times,
                                to_list(swing.u), Mark::line, 2},
                               {"Euler-Bernoulli, first mode", swing.times,
                                theory, Mark::line, 1}},
                    .commands = {"set format y '%.1e'"}};
  return {{panel}, 1, 760, 330};
}

}  // namespace

void write_shear_swing(Page& page) {
  const ShearTest test = make_shear_test();
  page.heading("Figure 14: the shear test in time");
  page.text(
      "The report measures 1.26e-6 m and 191 rad/s, although its own Table 2 "
      "says omega_1 = sqrt(39224) = 198.05 rad/s. Choices that might explain "
      "it, displacements at the corner (0, 0, 5):");
  const std::vector<Choice> choices = try_choices(test);
  add_choices(page, choices);
  page.text(
      "*Read off the curve* explains both: half of the first maximum as the "
      "steady value, and the time from the first to the second maximum as the "
      "period. The second bending mode is superposed on the first (see the "
      "figure) and moves the maxima by up to a millisecond, so neither is the "
      "intended quantity: the ten modes' own static deflection and first "
      "frequency are 1.278e-6 m and 198.05 rad/s. 500 N are the sum here; "
      "Table 2 has 500 N on each node.");
  const BeamAnswer& reading = choices.back().answer;
  page.check(std::lround(reading.deflection * 1e8) == 126 &&
                 std::lround(reading.omega) == 191,
             fmt::format("read off the curve, 500 N on the edge and ten modes "
                         "give {:.4g} m and {:.1f} rad/s, the report's 1.26e-6 "
                         "and 191 to all their digits.",
                         reading.deflection, reading.omega));
  page.figure(draw_swing(test.swing(kModes, test.edge)), "figure14",
              "Figure 14: the shear test and Euler-Bernoulli theory");
}

}  // namespace limber::bench
