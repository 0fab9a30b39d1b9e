// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/stress_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/reduction/reduce.hpp"
#include "places.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::stress_modes_test {
namespace {

using testing::Bar;

/// Stress at all points of a deformation, 6 x p [Pa].
Matrix6X stress_of(const ReducedBody& body, const VectorX& eta) {
  return (body.stress->Sigma_B * eta).reshaped(6, body.stress->rows.size());
}

/// Static response to forces on interfaces, as the basis has it.
VectorX respond(const ReducedBody& body,
                const std::vector<LoadPattern>& loads) {
  VectorX force = VectorX::Zero(body.mode_count());
  for (const LoadPattern& load : loads) {
    const auto& table = body.interfaces[find_interface(body, load.interface)];
    force += table.Phi_B.transpose() * load.force;
  }
  return force.cwiseQuotient(body.lambda);
}

// ---- CalculiX

struct Reference {
  std::size_t node = 0;
  std::vector<double> values;  // 3 displacements, 6 stresses
};

std::vector<Reference> read_reference(const std::string& name) {
  std::ifstream in(LIMBER_SOURCE_DIR "/tests/data/stress/" + name + ".csv");
  std::vector<Reference> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    Reference row;
    std::string cell;
    std::getline(cells, cell, ',');
    row.node = std::stoul(cell);
    while (std::getline(cells, cell, ','))
      row.values.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

struct Case {
  std::string name;
  std::size_t tip = 0;
  std::size_t side = 0;
  int eigenmodes = 0;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name << c.eigenmodes;
}

class CalculiX : public ::testing::TestWithParam<Case> {};

TEST_P(CalculiX, HasTheSameStressNodeByNode) {
  const Case& c = GetParam();
  Recipe recipe;
  recipe.name = c.name;
  recipe.mesh.file = LIMBER_SOURCE_DIR "/tests/data/stress/" + c.name + ".msh";
  recipe.materials = {{"", {7e10, 0.33, 2700.0}}};
  recipe.clamped_groups = {"root"};
  recipe.interfaces = {{"tip", TaggedNode{c.tip}, Weighting::uniform, false},
                       {"side", TaggedNode{c.side}, Weighting::uniform, false}};
  const std::vector<LoadPattern> loads = {
      {"tip", Vector3(300, -500, 1000), Vector3::Zero(), true},
      {"side", Vector3(0, 800, 0), Vector3::Zero(), true}};
  recipe.basis.eigenmodes = c.eigenmodes;
  if (c.eigenmodes == 0) recipe.load_patterns = loads;
  recipe.rows = parse_rows({"all"});
  recipe.stress = true;
  const ReducedBody body = reduce(recipe);
  const VectorX eta = respond(body, loads);
  const Matrix6X stress = stress_of(body, eta);
  const double largest = stress.cwiseAbs().maxCoeff();
  const VectorX u = body.rows.Phi_B * eta;
  const auto reference = read_reference(c.name);
  ASSERT_EQ(reference.size(), body.rows.tags.size());
  for (const Reference& row : reference) {
    const auto i = static_cast<Eigen::Index>(find_row(body, row.node));
    for (Eigen::Index k = 0; k < 3; ++k) {
      EXPECT_NEAR(u[3 * i + k], row.values[static_cast<std::size_t>(k)],
                  1e-6 * u.cwiseAbs().maxCoeff());
    }
    for (Eigen::Index k = 0; k < 6; ++k) {
      EXPECT_NEAR(stress(k, i), row.values[static_cast<std::size_t>(3 + k)],
                  1e-6 * largest)
          << "node " << row.node << " component " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, CalculiX,
                         ::testing::Values(Case{"hex", 24, 13, 0},
                                           Case{"tet", 16, 9, 0},
                                           Case{"tet", 16, 9, 162}));

// ---- closed forms

TEST(StressModes, OfACantileverAreThoseOfBeamTheory) {
  Bar bar{.size = Vector3(1.0, 0.1, 0.05), .cells = 12};
  bar.material.poisson_ratio = 0.3;
  bar.is_clamped = true;
  Recipe recipe = make_recipe(bar);
  recipe.basis.eigenmodes = 0;
  recipe.stress = true;
  const ReducedBody body = reduce(recipe);
  const double F = 1000.0;
  const Matrix6X stress = stress_of(
      body, respond(body, {{"tip", Vector3(0, 0, F), Vector3::Zero(), true}}));
  const double I = 0.1 * std::pow(0.05, 3) / 12.0;
  const double root = F * 1.0 * 0.025 / I;
  int count = 0;
  for (std::size_t i = 0; i < body.stress->rows.size(); ++i) {
    const auto point = static_cast<Eigen::Index>(i);
    const Vector3 x =
        body.rows.x_B.col(static_cast<Eigen::Index>(body.stress->rows[i])) +
        body.p_MoBcm_M;
    if (x[0] < 0.2 || x[0] > 0.8) continue;
    const double bending = -F * (1.0 - x[0]) * (x[2] - 0.025) / I;
    EXPECT_NEAR(stress(0, point), bending, 0.01 * root * (1.0 - x[0]));
    ++count;
  }
  EXPECT_GT(count, 50);
}

// sigma = rho w^2 (L^2 - x^2) / 2 from the middle, half-length L: no
// Poisson's effect at nu = 0.
TEST(StressModes, OfASpunRodAreTheClosedForm) {
  const Bar bar{.size = Vector3(2.0, 0.05, 0.05), .cells = 40};
  Recipe recipe = make_recipe(bar);
  const double w = 30.0;
  {
    const MeshedBody meshed(recipe, {});
    Matrix3X arm = Matrix3X::Zero(3, meshed.mesh.x.cols());
    arm.row(0) = meshed.mesh.x.row(0).array() - 1.0;
    const MatrixX force = w * w * (arm * MatrixX(meshed.M_s));
    recipe.nodal_forces = {{"spin", {0.0}, force.reshaped()}};
  }
  recipe.basis.eigenmodes = 0;
  recipe.basis.interface_modes = false;
  recipe.rows = parse_rows({"all"});
  recipe.stress = true;
  const ReducedBody body = reduce(recipe);
  const VectorX eta =
      (body.rows.Phi_B.transpose() * recipe.nodal_forces[0].forces)
          .cwiseQuotient(body.lambda);
  const Matrix6X stress = stress_of(body, eta);
  const double middle = 8000.0 * w * w * 0.5;
  for (std::size_t i = 0; i < body.stress->rows.size(); ++i) {
    const double x =
        body.rows.x_B(0, static_cast<Eigen::Index>(body.stress->rows[i]));
    EXPECT_NEAR(stress(0, static_cast<Eigen::Index>(i)), middle * (1.0 - x * x),
                1e-3 * middle);
  }
}

// ---- what is stored

Recipe make_stressed(const Bar& bar) {
  Recipe recipe = make_recipe(bar);
  recipe.basis.eigenmodes = 3;
  recipe.stress = true;
  return recipe;
}

TEST(StressModes, AreThereOnlyWhenAskedFor) {
  Recipe recipe = make_recipe(Bar{});
  recipe.basis.eigenmodes = 3;
  EXPECT_FALSE(reduce(recipe).stress);
  const std::string plain = recipe_key(recipe);
  recipe.stress = true;
  EXPECT_NE(recipe_key(recipe), plain);
}

TEST(StressModes, KeepTheRowsOfTheBody) {
  Recipe recipe = make_stressed(Bar{});
  recipe.rows = parse_rows({"interfaces"});
  const ReducedBody body = reduce(recipe);
  const StressModes& modes = *body.stress;
  ASSERT_EQ(modes.rows.size(), body.rows.tags.size());
  EXPECT_EQ(modes.rows.size(), 18U);  // two faces of a 27-node brick
  EXPECT_EQ(modes.interface_rows[0].size(), 9U);
  for (const int on_surface : modes.on_surface) EXPECT_EQ(on_surface, 1);
}

TEST(StressModes, AreInTheBodysFile) {
  const ReducedBody body = reduce(make_stressed(Bar{}));
  const std::filesystem::path file = limber::test::own_folder() / "stressed.h5";
  write_body(body, file);
  const ReducedBody again = read_body(file);
  ASSERT_TRUE(again.stress);
  EXPECT_EQ(again.stress->rows, body.stress->rows);
  EXPECT_EQ(again.stress->materials, body.stress->materials);
  EXPECT_EQ(again.stress->on_surface, body.stress->on_surface);
  EXPECT_EQ(again.stress->Sigma_B, body.stress->Sigma_B);
  EXPECT_EQ(again.stress->averaging, body.stress->averaging);
  EXPECT_EQ(again.stress->constants, body.stress->constants);
  EXPECT_EQ(again.stress->interface_rows, body.stress->interface_rows);
}

TEST(StressModes, ThatDoNotFitTheirBodyAreRefused) {
  const ReducedBody body = reduce(make_stressed(Bar{.cells = 1}));
  const std::filesystem::path file = limber::test::own_folder() / "unfit.h5";
  const auto is_refused = [&](const auto& change) {
    ReducedBody changed = body;
    change(*changed.stress);
    write_body(changed, file);
    try {
      static_cast<void>(read_body(file));
      return false;
    } catch (const InputError&) {
      return true;
    }
  };
  EXPECT_FALSE(is_refused([](StressModes&) {}));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.rows.back() = 999; }));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.rows.pop_back(); }));
  EXPECT_TRUE(
      is_refused([](StressModes& s) { std::swap(s.rows[0], s.rows[1]); }));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.materials[0] = 1; }));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.on_surface[0] = 2; }));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.Sigma_B(0, 0) = NAN; }));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.averaging.resize(2, 3); }));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.constants.resize(3, 1); }));
  EXPECT_TRUE(is_refused([](StressModes& s) { s.interface_rows[0][0] = 999; }));
}

// K phi = lambda M phi: a mode's strain energy is lambda / 2, and with
// enough elements little of it is lost by averaging.
TEST(StressModes, LoseLittleByAveraging) {
  const ReducedBody body = reduce(make_stressed(Bar{.cells = 16}));
  for (int k = 0; k < body.mode_count(); ++k) {
    const VectorX eta = VectorX::Unit(body.mode_count(), k);
    EXPECT_LT(find_averaging_error(*body.stress, body.lambda, eta), 0.3) << k;
  }
}

}  // namespace
}  // namespace limber::flexbody::stress_modes_test
