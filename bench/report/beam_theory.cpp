// SPDX-License-Identifier: BSD-3-Clause
#include "beam_theory.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/fem/mesh/node_weights.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "sections.hpp"

namespace limber::bench {
namespace {

constexpr double kArea = kSide * kSide;
constexpr double kInertia = kSide * kSide * kSide * kSide / 12.0;  // [m^4]
constexpr double kShear = 0.5 * kYoung;  // Poisson's ratio 0 [Pa]
constexpr double kKappa = 5.0 / 6.0;     // of a rectangle without Poisson

/// Timoshenko's frequency equation of a cantilever (Huang, J. Appl. Mech. 28,
/// 1961), zero at a natural frequency [rad/s].
double find_timoshenko_residual(double omega) {
  const double EI = kYoung * kInertia;
  const double b2 =
      kDensity * kArea * std::pow(kLength, 4) * omega * omega / EI;
  const double r2 = kInertia / (kArea * kLength * kLength);
  const double s2 = EI / (kKappa * kArea * kShear * kLength * kLength);
  const double b = std::sqrt(b2);
  const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4.0 / b2);
  const double alpha = std::sqrt(0.5 * (root - r2 - s2));
  const double beta = std::sqrt(0.5 * (root + r2 + s2));
  return 2.0 +
         (b2 * (r2 - s2) * (r2 - s2) + 2.0) * std::cosh(b * alpha) *
             std::cos(b * beta) -
         b * (r2 + s2) / std::sqrt(1.0 - b2 * r2 * s2) * std::sinh(b * alpha) *
             std::sin(b * beta);
}

}  // namespace

BeamAnswer find_euler_bernoulli() {
  return {kTipForce * std::pow(kLength, 3) / (3.0 * kYoung * kInertia),
          1.8751040687 * 1.8751040687 *
              std::sqrt(kYoung * kInertia /
                        (kDensity * kArea * std::pow(kLength, 4)))};
}

BeamAnswer find_timoshenko() {
  double low = 100.0;
  double high = 220.0;
  while (high - low > 1e-10) {
    const double middle = 0.5 * (low + high);
    const bool is_same =
        find_timoshenko_residual(low) * find_timoshenko_residual(middle) > 0.0;
    (is_same ? low : high) = middle;
  }
  return {find_euler_bernoulli().deflection +
              kTipForce * kLength / (kKappa * kShear * kArea),
          low};
}

ClampedBeam make_clamped_beam(const std::filesystem::path& file,
                              const fem::MeshOptions& options) {
  const fem::Mesh mesh = fem::read_mesh(file, options);
  const fem::StructuralMatrices whole = fem::assemble(
      mesh, fem::assign_materials(mesh, {{"", {kYoung, 0.0, kDensity}}}));
  const fem::WeightedNodes tip =
      fem::weigh_group(mesh, mesh.groups[fem::find_group(mesh, "tip")]);
  VectorX load = VectorX::Zero(mesh.x.cols());
  for (std::size_t i = 0; i < tip.nodes.size(); ++i) {
    load[tip.nodes[i]] = kTipForce * tip.weights[static_cast<Eigen::Index>(i)];
  }
  std::vector<int> free;
  for (int n = 0; n < static_cast<int>(mesh.x.cols()); ++n) {
    if (!is_at(mesh.x(2, n), 0.0)) free.push_back(n);
  }
  ClampedBeam beam{mesh.node_count(),
                   mesh.x(Eigen::all, free),
                   fem::restrict_to(whole, free),
                   {}};
  beam.face = VectorX::Zero(beam.x.size());
  beam.face(Eigen::seqN(0, beam.x.cols(), 3)) = load(free);
  return beam;
}

fem::ElasticInverse invert(const ClampedBeam& beam) {
  return {beam.matrices, MatrixX(beam.matrices.dof_count(), 0), beam.x};
}

BeamAnswer find_answer(const ClampedBeam& beam) {
  const fem::ElasticInverse inverse = invert(beam);
  return {beam.face.dot(inverse.solve(beam.face).col(0)) / kTipForce,
          std::sqrt(fem::find_eigenmodes(inverse, 1).lambda[0])};
}

namespace {

std::vector<std::string> make_row(const std::string& name,
                                  const std::string& nodes,
                                  const BeamAnswer& answer) {
  return {name, nodes, fmt::format("{:.5e}", answer.deflection),
          fmt::format("{:.3f}", answer.omega)};
}

/// Results of successively finer meshes.
struct Refinement {
  std::vector<double> nodes;
  std::vector<double> deflections;  // [m]
  std::vector<double> omegas;       // [rad/s]
};

Plot draw_refinement(const Refinement& refinement) {
  const BeamAnswer thin = find_euler_bernoulli();
  const BeamAnswer thick = find_timoshenko();
  const auto flat = [&](const std::string& name, double value, int colour) {
    return Curve{name,
                 {refinement.nodes.front(), refinement.nodes.back()},
                 {value, value},
                 Mark::dashed,
                 colour};
  };
  Panel deflection{.title = "static deflection of the tip",
                   .x_label = "nodes",
                   .y_label = "deflection [m]",
                   .is_log_x = true,
                   .curves = {{"second order", refinement.nodes,
                               refinement.deflections, Mark::line_points},
                              flat("Timoshenko", thick.deflection, 2),
                              flat("Euler-Bernoulli", thin.deflection, 1)},
                   .commands = {"set format y '%.3e'"}};
  Panel omega{.title = "first frequency",
              .x_label = "nodes",
              .y_label = "omega_1 [rad/s]",
              .is_log_x = true,
              .curves = {{"second order", refinement.nodes, refinement.omegas,
                          Mark::line_points},
                         flat("Timoshenko", thick.omega, 2),
                         flat("Euler-Bernoulli", thin.omega, 1)},
              .commands = {}};
  return {{deflection, omega}, 2, 480, 330};
}

void check_answers(Page& page, const BeamAnswer& own,
                   const Refinement& refinement) {
  const BeamAnswer thick = find_timoshenko();
  page.check(std::abs(own.deflection / 1.27901468831e-06 - 1.0) < 1e-8 &&
                 std::abs(own.omega * own.omega / 39224.0940501 - 1.0) < 1e-8,
             "on `beam579.msh` both agree with the independent program to "
             "1e-8.");
  page.check(
      std::abs(refinement.deflections.back() / thick.deflection - 1.0) < 2e-4 &&
          std::abs(refinement.omegas.back() / thick.omega - 1.0) < 2e-3,
      "the finest mesh is within 0.02 % of Timoshenko's deflection and 0.2 % "
      "of his frequency.");
}

}  // namespace

void write_beam_theory(Page& page) {
  const BeamAnswer own =
      find_answer(make_clamped_beam(make_recipe().mesh.file, {}));
  std::vector<std::vector<std::string>> rows = {
      make_row("Euler-Bernoulli (report: 1.25e-6, 203)", "",
               find_euler_bernoulli()),
      make_row("Timoshenko", "", find_timoshenko()),
      make_row("`beam579.msh`", "579", own)};
  const auto box = find_source_file("meshes/box/box.geo");
  Refinement refinement;
  for (const double size : {2.0, 1.05, 0.7, 0.55, 0.4, 0.3, 0.2, 0.14}) {
    const ClampedBeam beam = make_clamped_beam(box, {size, 2, 1.0});
    const BeamAnswer answer = find_answer(beam);
    rows.push_back(make_row(fmt::format("`box.geo` at {:g} m", size),
                            fmt::format("{}", beam.nodes), answer));
    refinement.nodes.push_back(static_cast<double>(beam.nodes));
    refinement.deflections.push_back(answer.deflection);
    refinement.omegas.push_back(answer.omega);
  }
  page.heading("Section 5.7.1: beam theory");
  page.text(
      "Clamped at z = 0, 500 N along x spread evenly over the tip face: mean "
      "deflection of the face, first natural frequency. Independent programs "
      "(CalculiX and one written for this comparison) give 1.27901e-6 m and "
      "198.05 rad/s on `beam579.msh`, 1.28009e-6 m on 29 764 nodes "
      "(tests/data/beam).");
  page.table({"", "nodes", "deflection [m]", "omega_1 [rad/s]"}, rows);
  page.figure(draw_refinement(refinement), "figure14_mesh",
              "Convergence with the mesh of what Figure 14 compares");
  check_answers(page, own, refinement);
}

}  // namespace limber::bench
