// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// The report's beam hit for 10 ms, against an explicit finite-element run of
/// the whole mesh (tests/data/beam/impact.csv).
namespace limber::beam_struck {
namespace {

using Row = std::array<double, 10>;  ///< t, u of A, B, C [s, m]

std::vector<Row> read_reference() {
  std::ifstream file(test::beam_file("impact.csv"));
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream stream(line);
    Row row{};
    for (double& value : row) {
      std::string cell;
      std::getline(stream, cell, ',');
      value = std::stod(cell);
    }
    rows.push_back(row);
  }
  return rows;
}

const flexbody::ReducedBody& struck_body() {
  static const flexbody::ReducedBody body = [] {
    flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
    recipe.basis.eigenmodes = 50;
    recipe.interfaces = {
        {"patch",
         flexbody::BoxNodes{{-1e-6, 0.300001, 4.100001}, {1e-6, 1.1, 5.1}},
         flexbody::Weighting::equal, false}};
    return flexbody::reduce(recipe);
  }();
  return body;
}

/// Displacement of a corner since the start.
Vector3 displacement(const dynamics::SystemState& state,
                     const flexbody::NodeRows& rows, std::size_t row) {
  const auto i = static_cast<Eigen::Index>(row);
  const auto& b = state.bodies[0];
  const Vector3 x_B = rows.x_B.col(i);
  const Vector3 deformed = x_B + rows.Phi_B.middleRows<3>(3 * i) * state.eta;
  return b.p_WB + b.quat_WB * deformed - x_B;
}

std::vector<Row> simulate_strike(const std::vector<Row>& reference) {
  const auto body =
      std::make_shared<const flexbody::ReducedBody>(struck_body());
  dynamics::SystemBuilder builder;
  const auto& patch = body->interfaces[0];
  const auto beam =
      builder.add_flexible_body("beam", body, dynamics::Fidelity::coupled, {});
  const auto where = builder.attach_interface("patch", beam, patch,
                                              {Matrix3::Identity(), patch.p_B});
  builder.add_load(
      "strike", where, Vector3(100.0, 0.0, 10.0), Vector3::Zero(),
      dynamics::LoadFrame::world,
      dynamics::Pulse{dynamics::PulseShape::rectangular, 0.0, 0.01});
  const auto model = builder.build();
  dynamics::SimulationSettings settings{
      .integrator = dynamics::IntegratorKind::runge_kutta_4,
      .end_time = reference.back()[0],
      .step = 1e-5,
      .output_times = {}};
  for (const Row& row : reference) settings.output_times.push_back(row[0]);
  const std::array<std::size_t, 3> corners{flexbody::find_row(*body, 1),
                                           flexbody::find_row(*body, 5),
                                           flexbody::find_row(*body, 7)};
  std::vector<Row> rows;
  dynamics::SystemState state = make_state(model);
  simulate(
      model, state, settings,
      [&](const dynamics::SystemState& now, const dynamics::EnergyBalance&) {
        Row row{now.t};
        for (std::size_t c = 0; c < 3; ++c) {
          const Vector3 u = displacement(now, body->rows, corners[c]);
          for (int a = 0; a < 3; ++a) {
            row[1 + 3 * c + static_cast<std::size_t>(a)] = u[a];
          }
        }
        rows.push_back(row);
      });
  return rows;
}

Vector3 corner(const Row& row, std::size_t c) {
  return {row[1 + 3 * c], row[2 + 3 * c], row[3 + 3 * c]};
}

class StruckBeam : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    reference_ = read_reference();
    ours_ = simulate_strike(reference_);
  }
  void SetUp() override {
    ASSERT_GT(reference_.size(), 40u);
    ASSERT_EQ(ours_.size(), reference_.size());
  }
  static inline std::vector<Row> reference_;
  static inline std::vector<Row> ours_;
};

/// What the whole model's deformation comes to at most at A, B and C [m], and
/// the fraction of it that 50 free-free eigenmodes miss, both by a program that
/// shares no code with this one (tests/data/beam/README.md).
constexpr double kLargestDeformation = 1.1018e-8;
constexpr double kMissedBy50Modes = 0.02995;

TEST_F(StruckBeam, MissesNoMoreOfTheWholeModelThanItsBasisMust) {
  for (std::size_t i = 0; i < ours_.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LT((corner(ours_[i], c) - corner(reference_[i], c)).norm(),
                kMissedBy50Modes * kLargestDeformation)
          << "corner "
          << "ABC"[c] << " at " << ours_[i][0] << " s";
    }
  }
}

TEST_F(StruckBeam, MovesFarBeyondWhatItIsComparedTo) {
  // The rigid part is hundreds of times the deformation: agreement within the
  // deformation's own few per cent tests both.
  EXPECT_GT(corner(ours_.back(), 1).norm(), 100.0 * kLargestDeformation);
}

}  // namespace
}  // namespace limber::beam_struck
