// SPDX-License-Identifier: BSD-3-Clause
// Files that CalculiX 2.20 wrote (tests/data/matrices/README.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "limber/common/errors.hpp"
#include "unit/fem/matrices/sample_files.hpp"

namespace limber::fem::calculix_test {
namespace {

using test::copy_sample;
using test::find_read_error;
using test::read_sample;
using test::read_text;
using test::replace_text;
using test::rigid_motions;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Largest energy of rows of known kind in rigid motions, over that without
/// cancellation, after rows of unknown kind took their places.
double find_rigid_energy(const MatrixModel& model) {
  MatrixX X = rigid_motions(model);
  const MatrixX K = model.stiffness.entries;
  std::vector<int> unknown;
  for (std::size_t i = 0; i < model.rows.size(); ++i)
    if (model.rows[i].component < 0) unknown.push_back(static_cast<int>(i));
  if (!unknown.empty()) {
    const MatrixX stiffness = K(unknown, unknown);
    const MatrixX right = (K * X)(unknown, Eigen::all);
    const MatrixX left = stiffness.ldlt().solve(-right);
    X(unknown, Eigen::all) = left;
  }
  const MatrixX energy = X.transpose() * K * X;
  const MatrixX all = X.cwiseAbs().transpose() * K.cwiseAbs() * X.cwiseAbs();
  return (energy.diagonal().array() / all.diagonal().array()).abs().maxCoeff();
}

TEST(CalculixMatrices, ASpidersRotationsAndDependentNodesAreFound) {
  const MatrixModel model = read_sample("calculix_spider");
  EXPECT_THAT(model.tags, SizeIs(13));  // 12 of the bricks, the reference
  EXPECT_THAT(model.rows, SizeIs(29));
  for (const MatrixRow& row : model.rows) EXPECT_GE(row.component, 0);
  EXPECT_LT(find_rigid_energy(model), 1e-13);
  // Four nodes of the rigid body and one of the equation.
  EXPECT_THAT(model.condensed, SizeIs(4 * 3 + 1));
  const MatrixX X = rigid_motions(model);
  MatrixModel dependent = model;
  dependent.rows = model.condensed;
  EXPECT_LT(
      (model.equations * X - rigid_motions(dependent)).cwiseAbs().maxCoeff(),
      1e-15);
}

TEST(CalculixMatrices, ASpidersPointMassAndBricksMakeTheMass) {
  const MatrixModel model = read_sample("calculix_spider");
  const MatrixX X = rigid_motions(model).leftCols<3>();
  const MatrixX mass = X.transpose() * (model.mass.entries * X);
  // Bricks of 0.3 x 0.2 x 0.1 m, sheared.
  const double bricks = 7800.0 * 2.0 * 0.3 * 0.2 * 0.1;
  EXPECT_LT(
      (mass - (bricks + 100.0) * MatrixX::Identity(3, 3)).cwiseAbs().maxCoeff(),
      1e-10);
  EXPECT_EQ(model.mass.digits, 14);
  ASSERT_THAT(model.sets, SizeIs(3));
  EXPECT_EQ(model.sets[1].name, "ROOT");
  EXPECT_THAT(model.sets[1].nodes, ::testing::ElementsAre(0, 1, 2, 3));
  // Outer faces of two bricks: ten quadrilaterals.
  EXPECT_THAT(model.triangles, SizeIs(20));
}

TEST(CalculixMatrices, ExpandedShellsHaveTheNodesOfTheirSolids) {
  const MatrixModel model = read_sample("calculix_shell");
  EXPECT_THAT(model.tags, SizeIs(32));
  EXPECT_THAT(model.rows, SizeIs(96));
  for (const MatrixRow& row : model.rows) EXPECT_GE(row.component, 0);
  // Positions have six digits.
  EXPECT_LT(find_rigid_energy(model), 1e-10);
  EXPECT_THAT(model.triangles, SizeIs(20));
  // The edge's three nodes are eight of the solid.
  ASSERT_THAT(model.sets, SizeIs(2 + 13));  // and one of each node
  EXPECT_EQ(model.sets[0].name, "EDGE");
  EXPECT_THAT(model.sets[0].nodes, SizeIs(8));
}

TEST(CalculixMatrices, IncompatibleModesOfBeamsAreRowsOfUnknownKind) {
  const MatrixModel model = read_sample("calculix_beam");
  EXPECT_THAT(model.rows, SizeIs(54));
  EXPECT_THAT(model.tags, SizeIs(12));
  int unknown = 0;
  for (const MatrixRow& row : model.rows)
    if (row.component < 0) ++unknown;
  EXPECT_EQ(unknown, 18);
  EXPECT_THAT(model.found, Contains("18 rows are of unknown kind"));
  EXPECT_LT(find_rigid_energy(model), 1e-10);
}

// Four corners of the section about the beam's node in the input file.
TEST(CalculixMatrices, ANodeOfABeamMeansTheSolidsNodesAboutIt) {
  const MatrixModel model = read_sample("calculix_beam");
  const auto set = std::find_if(
      model.sets.begin(), model.sets.end(),
      [](const MatrixNodeSet& one) { return one.name == "node:2"; });
  ASSERT_NE(set, model.sets.end());
  ASSERT_THAT(set->nodes, SizeIs(4));
  Vector3 mean = Vector3::Zero();
  for (const int node : set->nodes) mean += 0.25 * model.x.col(node);
  EXPECT_LT((mean - Vector3(0.5, 0.0, 0.1)).norm(), 1e-6);  // six digits
}

TEST(CalculixMatrices, ShellsNeedTheResultsOfAnotherRun) {
  const auto folder = copy_sample("calculix_shell");
  std::filesystem::remove(folder / "shell_modes.frd");
  EXPECT_THAT(find_read_error(folder),
              AllOf(HasSubstr("0 result files (.frd) have nodes"),
                    HasSubstr("OUTPUT=3D")));
}

TEST(CalculixMatrices, SupportsLeaveTheirNodesOut) {
  const auto folder = copy_sample("calculix_spider");
  // As if nodes 3 and 4 were held: their rows, 6 to 11, are not there.
  for (const char* name : {"spider.sti", "spider.mas"}) {
    std::string kept;
    std::istringstream in(read_text(folder / name));
    for (std::string line; std::getline(in, line);) {
      std::istringstream fields(line);
      int row = 0;
      int column = 0;
      std::string value;
      fields >> row >> column >> value;
      const auto is_held = [](int i) { return i >= 6 && i <= 11; };
      if (is_held(row) || is_held(column)) continue;
      const auto moved = [](int i) { return i > 11 ? i - 6 : i; };
      kept += std::to_string(moved(row)) + " " + std::to_string(moved(column)) +
              " " + value + "\n";
    }
    replace_text(folder / name, kept);
  }
  std::string rows = read_text(folder / "spider.dof");
  const std::size_t first = rows.find("3.1");
  rows.erase(first, rows.find("5.1") - first);
  replace_text(folder / "spider.dof", rows);
  std::string deck = read_text(folder / "spider.inp");
  deck.insert(deck.find("*RIGID"), "*BOUNDARY\n3, 1, 3\n4, 1, 3\n");
  replace_text(folder / "spider.inp", deck);
  const MatrixModel model = read_matrices({{folder}});
  EXPECT_THAT(model.tags, SizeIs(11));
  EXPECT_THAT(model.found, Contains(HasSubstr("nodes have no rows")));
}

TEST(CalculixMatrices, FilesThatEndEarlyAreRefused) {
  for (const char* name : {"spider.sti", "spider.mas", "spider.dof"}) {
    const auto folder = copy_sample("calculix_spider");
    const std::string whole = read_text(folder / name);
    for (std::size_t end = whole.find('\n'); end + 1 < whole.size();
         end = whole.find('\n', end + 1)) {
      replace_text(folder / name, whole.substr(0, end + 1));
      EXPECT_THAT(find_read_error(folder), HasSubstr("spider."))
          << name << " after " << end;
    }
  }
}

}  // namespace
}  // namespace limber::fem::calculix_test
