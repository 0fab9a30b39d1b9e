// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "limber/flexbody/modal/modal_response.hpp"
#include "limber/reduction/reduce.hpp"
#include "sections.hpp"

/// What static-deformation modes of the loads are worth on the free beam, by
/// the deformation alone and against all modes, linear and exact in time.
namespace limber::bench {
namespace {

constexpr int kVectors = 16;
constexpr double kEnd = 1.0;                           // [s]
const std::vector<double> kRises = {0.0, 1e-3, 5e-3};  // [s]

struct Case {
  std::string name;
  StepForces forces;
};

/// Of a load that is put on, and taken off, as (1 - cos) / 2 within `rise`;
/// 0: at once.
flexbody::ModalLoads make_loads(const StepForces& forces, const MatrixX& Phi,
                                double rise) {
  const MatrixX f = Phi.transpose() * forces.forces;
  flexbody::ModalLoads loads;
  if (rise == 0.0) {
    loads.steps = {forces.times, f};
    return loads;
  }
  const VectorX zero = VectorX::Zero(f.rows());
  loads.steps.values.resize(f.rows(), 2 * f.cols());
  for (Eigen::Index i = 0; i < f.cols(); ++i) {
    const double t = forces.times[static_cast<std::size_t>(i)];
    const VectorX before = i > 0 ? VectorX(f.col(i - 1)) : zero;
    const VectorX change = f.col(i) - before;
    loads.steps.times.insert(loads.steps.times.end(), {t, t + rise});
    loads.steps.values.col(2 * i) = before + 0.5 * change;
    loads.steps.values.col(2 * i + 1) = f.col(i);
    loads.sinusoids.push_back(
        {std::numbers::pi / rise, -0.5 * change, zero, t, t + rise});
  }
  return loads;
}

MatrixX respond(const StepForces& forces, const MatrixX& Phi,
                const VectorX& lambda, double rise, int count) {
  return flexbody::ModalResponse(lambda, VectorX::Zero(lambda.size()),
                                 make_loads(forces, Phi, rise), {})
      .evaluate(spread_times(kEnd, count))
      .eta;
}

/// Rows of A, B, C in a 3n-row matrix; nodes 1, 5 and 7 of the mesh.
MatrixX take_corners(const MatrixX& Phi) {
  MatrixX rows(9, Phi.cols());
  rows << Phi.middleRows<3>(0), Phi.middleRows<3>(12), Phi.middleRows<3>(18);
  return rows;
}

/// Every tenth of the times.
MatrixX take_tenths(const MatrixX& eta) {
  return eta(Eigen::all, Eigen::seq(0, eta.cols() - 1, 10));
}

/// Deformation by all modes under one load.
struct Truth {
  MatrixX corners;  // 9 x T, each 0.1 ms [m]
  MatrixX all;      // 3n x T, each 1 ms [m]
};

Truth find_truth(const FullModes& modes, const StepForces& forces,
                 double rise) {
  const MatrixX eta = respond(forces, modes.Phi, modes.lambda, rise, 10000);
  return {take_corners(modes.Phi) * eta, modes.Phi * take_tenths(eta)};
}

struct Error {
  double largest;  // at A, B, C, of the largest component there [-]
  double mean;     // root mean square over all nodes and times [-]
};

Error compare(const flexbody::ReducedBody& body, const StepForces& forces,
              double rise, const Truth& truth) {
  const MatrixX& Phi = body.rows.Phi_B;
  const MatrixX eta = respond(forces, Phi, body.lambda, rise, 10000);
  const MatrixX u = take_corners(Phi) * eta;
  return {(u - truth.corners).cwiseAbs().maxCoeff() /
              truth.corners.cwiseAbs().maxCoeff(),
          (Phi * take_tenths(eta) - truth.all).norm() / truth.all.norm()};
}

/// Lower bound of `mean` for any basis of this size: the remainder beyond its
/// leading singular values.
double find_bound(const Truth& truth, Eigen::Index vectors) {
  const MatrixX gram = truth.all.transpose() * truth.all;
  const VectorX squares =
      Eigen::SelfAdjointEigenSolver<MatrixX>(gram, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return std::sqrt(squares.head(squares.size() - vectors).cwiseMax(0.0).sum() /
                   squares.sum());
}

flexbody::ReducedBody reduce_with(const StepForces& forces, int eigenmodes,
                                  int terms) {
  flexbody::Recipe recipe = make_recipe();
  recipe.basis.eigenmodes = eigenmodes;
  recipe.basis.terms = std::max(terms, 1);
  recipe.basis.load_modes = terms > 0;
  recipe.nodal_forces = {{"loads", forces.times, forces.forces}};
  return flexbody::reduce(recipe);
}

/// Uniform tractions of 100 N along y on the tip, -100 N on the root; a row a
/// node: tag, place, force.
VectorX read_couple(const flexbody::ReducedBody& body) {
  std::ifstream file(find_source_file("tests/data/beam/couple_forces.csv"));
  VectorX forces = VectorX::Zero(body.rows.x_B.size());
  std::string line;
  std::getline(file, line);  // names of columns
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    std::size_t tag = 0;
    Vector3 place;
    Vector3 force;
    cells >> tag >> place[0] >> place[1] >> place[2] >> force[0] >> force[1] >>
        force[2];
    const auto row = static_cast<Eigen::Index>(flexbody::find_row(body, tag));
    forces.segment<3>(3 * row) = force;
  }
  return forces;
}

std::vector<Case> list_cases(const Body& beam) {
  return {{"impact", make_strike(*beam, 0.01)},
          {"couple", {{0.0}, read_couple(*beam)}},
          {"complex", make_complex_forcing(*beam, 0.5)}};
}

std::vector<std::string> make_row(const std::string& load,
                                  const std::string& basis,
                                  const std::vector<Error>& errors) {
  std::vector<std::string> row = {load, basis};
  for (const Error& error : errors) {
    row.push_back(fmt::format("{:.2f}", 100.0 * error.largest));
    row.push_back(fmt::format("{:.2f}", 100.0 * error.mean));
  }
  return row;
}

std::string describe(int eigenmodes, int terms, Eigen::Index vectors) {
  const std::string count = fmt::format("{} eigenmodes", eigenmodes);
  if (terms == 0) return count;
  return fmt::format("{} + {} static{}", count, vectors - eigenmodes,
                     terms == 1 ? "" : fmt::format(", {} terms", terms));
}

using Rows = std::vector<std::vector<std::string>>;

struct Claims {
  bool jumps_are_beyond = true;   // any basis of so many vectors
  bool smooth_is_reached = true;  // with plain static modes
  bool eigenmodes_fall_short = true;
};

void study(const Case& load, const FullModes& modes, Rows& rows,
           Claims& claims) {
  std::vector<Truth> truths;
  for (const double rise : kRises)
    truths.push_back(find_truth(modes, load.forces, rise));
  const int directions = static_cast<int>(load.name == "complex" ? 2 : 1);
  for (const int terms : {0, 1, 2, 3}) {
    const int eigenmodes = kVectors - terms * directions;
    const flexbody::ReducedBody body =
        reduce_with(load.forces, eigenmodes, terms);
    std::vector<Error> errors;
    for (std::size_t i = 0; i < kRises.size(); ++i)
      errors.push_back(compare(body, load.forces, kRises[i], truths[i]));
    rows.push_back(make_row(
        load.name, describe(eigenmodes, terms, body.lambda.size()), errors));
    for (std::size_t i = 1; i < kRises.size(); ++i) {
      if (terms == 0) claims.eigenmodes_fall_short &= errors[i].largest > 0.01;
      if (terms == 1)
        claims.smooth_is_reached &=
            errors[i].largest < 0.01 && errors[i].mean < 0.01;
    }
  }
  std::vector<std::string> bound = {load.name, "any 16 vectors"};
  for (const Truth& truth : truths) {
    const double least = find_bound(truth, kVectors);
    if (&truth == truths.data()) claims.jumps_are_beyond &= least > 0.01;
    bound.insert(bound.end(), {"", fmt::format("> {:.2f}", 100.0 * least)});
  }
  rows.push_back(bound);
}

}  // namespace

void write_static_modes(Page& page, Shared& shared) {
  page.heading("Static-deformation modes of the loads");
  page.text(fmt::format(
      "The free beam; deformation alone, without rigid motion, by {} vectors "
      "against all 1731 modes, linear and exact in time. The impact of section "
      "6 (100 N and 10 N for 10 ms); a couple of 100 N on the end faces; the "
      "complex forcing of Figure 6c, which changes at 0.5 s. Loads are applied "
      "and removed at once, or as (1 - cos) / 2 within 1 ms or 5 ms; the first "
      "mode's period is 5.4 ms. Errors in percent over 1 s: the largest "
      "component at the corners A, B, C each 0.1 ms, of the largest there; "
      "root mean square over all nodes each 1 ms. Nothing is damped.",
      kVectors));
  Rows rows;
  Claims claims;
  for (const Case& load : list_cases(shared.beam()))
    study(load, shared.free(), rows, claims);
  page.table({"load", "basis", "at once: largest", "mean", "1 ms: largest",
              "mean", "5 ms: largest", "mean"},
             rows);
  page.text(
      "The last rows are the remainder of the motion of all nodes beyond its "
      "16 largest singular values: no 16 vectors do better. A discontinuous "
      "load excites every mode of the mesh, and the part that the lowest do "
      "not carry is spread over hundreds.");
  page.check(claims.jumps_are_beyond,
             "under discontinuous loads no basis of 16 vectors is within 1 %.");
  page.check(claims.smooth_is_reached,
             "with the static-deformation modes of the loads among them, 16 "
             "vectors are within 1 % when the loads take 1 ms or 5 ms.");
  page.check(claims.eigenmodes_fall_short, "16 eigenmodes are not.");
}

}  // namespace limber::bench
