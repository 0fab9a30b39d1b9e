// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "limber/flexbody/modal/modal_response.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// What eigenmodes and static-deformation modes of the loads miss of the free
/// beam's deformation, against all modes; linear and exact in time.
namespace limber::load_modes_slow {
namespace {

constexpr Eigen::Index kVectors = 16;
constexpr double kGoal = 0.01;

/// Tag, place and force of each loaded node; rows of all nodes [N].
VectorX read_forces(const std::string& name) {
  std::ifstream file(test::beam_file(name));
  VectorX forces = VectorX::Zero(3 * 579);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    Eigen::Index tag = 0;
    Vector3 place;
    Vector3 force;
    cells >> tag >> place[0] >> place[1] >> place[2] >> force[0] >> force[1] >>
        force[2];
    forces.segment<3>(3 * (tag - 1)) = force;
  }
  return forces;
}

struct Load {
  std::string name;
  VectorX forces;  // [N]
  double end;      // [s]
};

std::vector<Load> list_loads() {
  return {{"impact", read_forces("impact_forces.csv"), 0.01},
          {"couple", read_forces("couple_forces.csv"), 10.0}};
}

struct Modes {
  VectorX lambda;
  MatrixX Phi;
};

const Modes& all_modes() {
  static const Modes modes = [] {
    const flexbody::MeshedBody meshed(test::beam_recipe("beam579_v41.msh"), {});
    const fem::Eigenmodes found =
        fem::find_eigenmodes(meshed.inverse, 3 * 579 - 6);
    return Modes{found.lambda, found.Phi};
  }();
  return modes;
}

/// The load put on and taken off as (1 - cos) / 2 within `rise`, or at once.
flexbody::ModalLoads make_loads(const Load& load, const VectorX& f,
                                double rise) {
  flexbody::ModalLoads loads;
  const VectorX zero = VectorX::Zero(f.size());
  if (rise == 0.0) {
    loads.steps.times = {0.0, load.end};
    loads.steps.values.resize(f.size(), 2);
    loads.steps.values << f, zero;
    return loads;
  }
  loads.steps.times = {0.0, rise, load.end, load.end + rise};
  loads.steps.values.resize(f.size(), 4);
  loads.steps.values << 0.5 * f, f, 0.5 * f, zero;
  const double omega = std::numbers::pi / rise;
  loads.sinusoids = {{omega, -0.5 * f, zero, 0.0, rise},
                     {omega, 0.5 * f, zero, load.end, load.end + rise}};
  return loads;
}

/// Each 0.1 ms to 1 s.
MatrixX respond(const Modes& modes, const Load& load, double rise) {
  std::vector<double> times;
  for (int i = 0; i <= 10000; ++i) times.push_back(1e-4 * i);
  return flexbody::ModalResponse(
             modes.lambda, VectorX::Zero(modes.lambda.size()),
             make_loads(load, modes.Phi.transpose() * load.forces, rise), {})
      .evaluate(times)
      .eta;
}

/// A, B, C are nodes 1, 5 and 7.
MatrixX follow_corners(const Modes& modes, const MatrixX& eta) {
  MatrixX rows(9, modes.Phi.cols());
  rows << modes.Phi.middleRows<3>(0), modes.Phi.middleRows<3>(12),
      modes.Phi.middleRows<3>(18);
  return rows * eta;
}

double compare(const MatrixX& u, const MatrixX& truth) {
  return (u - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff();
}

/// "load": { ... "key": value
double read_figure(const std::string& load, const std::string& key) {
  std::ifstream file(test::beam_file("linear_modal_truncation.json"));
  std::stringstream text;
  text << file.rdbuf();
  const std::string all = text.str();
  const std::size_t at = all.find(key, all.find('"' + load + '"'));
  return std::strtod(all.c_str() + all.find(':', at) + 1, nullptr);
}

// Two programs that share no code, of one definition; eigenvalues agree to
// 1e-8, and so do phases up to omega t = 1e5.
TEST(LoadModes, AreMissedByEigenmodesAsInTheIndependentProgram) {
  for (const Load& load : list_loads()) {
    const MatrixX eta = respond(all_modes(), load, 0.0);
    const MatrixX truth = follow_corners(all_modes(), eta);
    EXPECT_NEAR(truth.cwiseAbs().maxCoeff() /
                    read_figure(load.name, "max_elastic_part"),
                1.0, 1e-6);
    for (const int count : {10, 20, 50, 100, 300}) {
      const Modes kept{all_modes().lambda.head(count),
                       all_modes().Phi.leftCols(count)};
      EXPECT_NEAR(compare(follow_corners(kept, eta.topRows(count)), truth),
                  read_figure(load.name, fmt::format("trunc{}_maxerr", count)),
                  1e-6)
          << load.name << ", " << count;
    }
  }
}

Modes reduce(const Load& load, bool with_load) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.basis.eigenmodes = static_cast<int>(kVectors) - (with_load ? 1 : 0);
  recipe.basis.load_modes = with_load;
  recipe.rows = flexbody::parse_rows({"all"});
  recipe.nodal_forces = {{load.name, {0.0}, load.forces}};
  const flexbody::ReducedBody body = flexbody::reduce(recipe);
  EXPECT_EQ(body.mode_count(), kVectors);
  return {body.lambda, body.rows.Phi_B};
}

// A rise of 1 ms is a fifth of the first mode's period.
TEST(LoadModes,
     BringSixteenVectorsBelowOnePercentForLoadsThatTakeAMillisecond) {
  for (const Load& load : list_loads()) {
    const Modes eigenmodes = reduce(load, false);
    const Modes mixed = reduce(load, true);
    for (const double rise : {1e-3, 5e-3}) {
      const MatrixX truth =
          follow_corners(all_modes(), respond(all_modes(), load, rise));
      const auto error = [&](const Modes& modes) {
        return compare(follow_corners(modes, respond(modes, load, rise)),
                       truth);
      };
      EXPECT_LT(error(mixed), kGoal) << load.name << ", " << rise;
      EXPECT_GT(error(eigenmodes), 2.0 * kGoal) << load.name << ", " << rise;
    }
  }
}

// The best of all bases, by Eckart and Young: what the singular values of the
// motion of all nodes leave beyond sixteen, root mean square each 1 ms.
TEST(LoadModes, CannotNorCanAnyBasisOfSixteenVectorsForLoadsThatJump) {
  for (const Load& load : list_loads()) {
    const MatrixX eta = respond(all_modes(), load, 0.0);
    const MatrixX thinned = eta(Eigen::all, Eigen::seq(0, 10000, 10));
    const MatrixX u = all_modes().Phi * thinned;
    const VectorX squares = dense::find_eigenvalues(MatrixX(u.transpose() * u));
    const double left = squares.head(squares.size() - kVectors).sum();
    EXPECT_GT(std::sqrt(left / squares.sum()), kGoal) << load.name;
  }
}

}  // namespace
}  // namespace limber::load_modes_slow
