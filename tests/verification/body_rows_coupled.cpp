// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verification/beam_scene.hpp"

/// The report's boundary approach at level `coupled`: a beam that spins and is
/// struck moves bitwise the same, whichever rows are stored.
namespace limber::body_rows_coupled {
namespace {

/// Everything that a run gives, output by output.
struct Record {
  std::size_t rows = 0;
  std::vector<std::vector<double>> states;
  std::vector<std::vector<double>> energies;
  std::vector<std::vector<double>> probes;
};

void append(std::vector<double>& values, const MatrixX& more) {
  values.insert(values.end(), more.data(), more.data() + more.size());
}

std::vector<double> flatten(const dynamics::SystemState& state) {
  std::vector<double> values{state.t};
  const dynamics::BodyState& body = state.bodies[0];
  append(values, body.p_WB);
  append(values, body.quat_WB.coeffs());
  append(values, body.v_WB_W);
  append(values, body.w_WB_B);
  append(values, state.eta);
  append(values, state.etadot);
  return values;
}

std::vector<double> flatten(const dynamics::EnergyBalance& energy) {
  std::vector<double> values{energy.kinetic_rigid, energy.kinetic_modal,
                             energy.elastic,       energy.coupler,
                             energy.dissipated,    energy.work};
  append(values, energy.linear_momentum);
  append(values, energy.angular_momentum);
  return values;
}

scene::ProbeSpec deformation_at(const std::string& name,
                                const flexbody::NodeSelection& nodes) {
  scene::PointProbeSpec probe;
  probe.where.link = "beam";
  probe.where.nodes = nodes;
  probe.quantity = scene::Quantity::deformation;
  return {name, probe};
}

/// Spins about all axes; its tip is struck in the world's x and y.
scene::Scene make_scene(const std::string& rows,
                        const std::vector<scene::ProbeSpec>& probes) {
  scene::Scene scene = test::beam_scene();
  scene.robot.links[0].flexible->rows = flexbody::parse_rows({rows});
  scene::Scenario& scenario = scene.scenario;
  scenario.fidelity = dynamics::Fidelity::coupled;
  scenario.base.angular_velocity = Vector3(20.0, -15.0, 5.0);
  scene::LoadSpec strike;
  strike.name = "strike";
  strike.where.link = "beam";
  strike.where.nodes = flexbody::GroupNodes{"tip"};
  strike.force = Vector3(1e6, 3e5, 0.0);
  strike.frame = dynamics::LoadFrame::world;
  strike.time = dynamics::Pulse{dynamics::PulseShape::half_sine, 0.005, 0.01};
  scenario.loads = {strike};
  scenario.probes = probes;
  scenario.settings.integrator = dynamics::IntegratorKind::generalized_alpha;
  scenario.settings.step = 2.5e-4;
  scenario.settings.end_time = 0.04;
  for (int i = 0; i <= 40; ++i)
    scenario.settings.output_times.push_back(1e-3 * i);
  return scene;
}

Record run(const std::string& rows,
           const std::vector<scene::ProbeSpec>& probes) {
  const test::SceneBench bench;
  const scene::BuiltScene built = bench.build(make_scene(rows, probes));
  Record record;
  record.rows = built.model.bodies[0].reduced->rows.tags.size();
  dynamics::SystemState state = built.initial;
  dynamics::simulate(built.model, state, built.settings,
                     [&](const dynamics::SystemState& now,
                         const dynamics::EnergyBalance& energy) {
                       record.states.push_back(flatten(now));
                       record.energies.push_back(flatten(energy));
                       record.probes.push_back(
                           scene::evaluate_all(built.probes, built.model, now));
                     });
  return record;
}

double find_peak(const std::vector<std::vector<double>>& rows) {
  double peak = 0.0;
  for (const std::vector<double>& row : rows)
    for (const double value : row) peak = std::max(peak, std::abs(value));
  return peak;
}

// Counts of tests/data/beam/README.md; node 5 is a corner of the tip.
TEST(BodyRowsOfACoupledRun, ChangeNoBitOfIt) {
  const std::vector<scene::ProbeSpec> probes = {
      deformation_at("corner", flexbody::TaggedNode{5})};
  const Record all = run("all", probes);
  ASSERT_EQ(all.rows, 579U);
  ASSERT_EQ(all.states.size(), 41U);
  // It does deform, and turns by more than a radian.
  ASSERT_GT(find_peak(all.probes), 1e-4);
  ASSERT_NE(all.states.front(), all.states.back());
  for (const char* rows : {"boundary", "tip", "root", "interfaces"}) {
    const Record few = run(rows, probes);
    EXPECT_LT(few.rows, all.rows) << rows;
    EXPECT_EQ(few.states, all.states) << rows;
    EXPECT_EQ(few.energies, all.energies) << rows;
    EXPECT_EQ(few.probes, all.probes) << rows;
  }
}

// A node of the long side, and the mean of the root.
TEST(BodyRowsOfACoupledRun, ShowTheSameDeformationWhereTheyAreKept) {
  const std::vector<scene::ProbeSpec> probes = {
      deformation_at("side", flexbody::NearestNode{Vector3(0.0, 0.5, 2.5)}),
      deformation_at("root", flexbody::GroupNodes{"root"})};
  const Record all = run("all", probes);
  ASSERT_GT(find_peak(all.probes), 1e-4);
  for (const char* rows : {"boundary", "side"}) {
    const Record few = run(rows, probes);
    EXPECT_LT(few.rows, all.rows) << rows;
    EXPECT_EQ(few.probes, all.probes) << rows;
    EXPECT_EQ(few.energies, all.energies) << rows;
  }
}

}  // namespace
}  // namespace limber::body_rows_coupled
