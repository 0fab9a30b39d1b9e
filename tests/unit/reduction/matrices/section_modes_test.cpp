// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "limber/common/material/section_place.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/model/kept_modes.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"
#include "places.hpp"
#include "support/temporary_folder.hpp"

/// Stress modes of beams and shells.
namespace limber::flexbody::section_modes_test {
namespace {

const char* const kBoom = LIMBER_SOURCE_DIR "/tests/data/structures/boom.bdf";

Recipe make_recipe(const std::filesystem::path& deck) {
  Recipe recipe;
  recipe.name = "boom";
  recipe.mesh.file = deck;
  recipe.clamped_groups = {"spc:1"};
  recipe.interfaces = {{"end", TaggedNode{3}}};
  recipe.basis.eigenmodes = 2;
  recipe.stress = true;
  return recipe;
}

ReducedBody reduce_deck(const Recipe& recipe) {
  return reduce_matrices(recipe, read_matrix_part(recipe.mesh));
}

/// Modal coordinates in equilibrium under a force on the interface.
VectorX find_static(const ReducedBody& body, const Vector3& force) {
  const VectorX load = body.interfaces[0].Phi_B.transpose() * force;
  return load.cwiseQuotient(body.lambda);
}

/// A tube of two metres under 100 N across its end.
TEST(SectionModes, HaveTheForcesAndStressOfACantilever) {
  const ReducedBody body = reduce_deck(make_recipe(kBoom));
  ASSERT_TRUE(body.stress.has_value());
  const SectionModes& sections = body.stress->sections;
  const VectorX eta = find_static(body, Vector3(0, 100, 0));
  const VectorX forces = sections.Force * eta;
  ASSERT_EQ(sections.ends.size(), 4U);
  EXPECT_EQ(body.rows.tags[sections.ends[0]], 1U);
  EXPECT_EQ(sections.elements[3], 2U);
  EXPECT_NEAR(forces[1], 100.0, 1e-5);       // Vy at node 1
  EXPECT_NEAR(forces[5], 200.0, 1e-5);       // Mz
  EXPECT_NEAR(forces[12 + 5], 100.0, 1e-5);  // at node 2 of beam 2
  EXPECT_NEAR(forces[18 + 5], 0.0, 1e-5);
  const double I = M_PI / 4.0 * (std::pow(0.05, 4) - std::pow(0.045, 4));
  const VectorX stress = body.stress->Sigma_B * eta;
  double largest = 0.0;
  for (Eigen::Index p = 0; p < stress.size() / 6; ++p)
    largest = std::max(largest, calc_von_mises(stress.segment<6>(6 * p)));
  EXPECT_NEAR(largest, 200.0 * 0.05 / I, 1e-6 * largest);
  EXPECT_EQ(sections.left_out, 0U);
  EXPECT_EQ(sections.bare_beams, 0U);
  EXPECT_TRUE(
      std::is_sorted(body.stress->rows.begin(), body.stress->rows.end()));
}

TEST(SectionModes, AreTheSameAfterAFile) {
  const ReducedBody body = reduce_deck(make_recipe(kBoom));
  const std::filesystem::path file = limber::test::own_folder() / "boom.h5";
  write_body(body, file);
  const ReducedBody read = read_body(file);
  const StressModes& a = *body.stress;
  const StressModes& b = *read.stress;
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.Sigma_B, b.Sigma_B);
  EXPECT_EQ(a.sections.nodes, b.sections.nodes);
  EXPECT_EQ(a.sections.faces, b.sections.faces);
  EXPECT_EQ(a.sections.plies, b.sections.plies);
  EXPECT_EQ(a.axes, b.axes);
  EXPECT_EQ(a.sections.strengths, b.sections.strengths);
  EXPECT_EQ(a.sections.elements, b.sections.elements);
  EXPECT_EQ(a.sections.ends, b.sections.ends);
  EXPECT_EQ(a.sections.Force, b.sections.Force);
  EXPECT_FALSE(read_body(file, StressTables::skipped).stress.has_value());
  const ReducedBody fewer = keep_lowest_modes(read, 2);
  EXPECT_EQ(fewer.stress->sections.Force, a.sections.Force.leftCols(2));
}

TEST(SectionModes, CountWhatIsNotKept) {
  Recipe recipe = make_recipe(kBoom);
  recipe.rows = parse_rows({"spc:1"});
  const ReducedBody body = reduce_deck(recipe);
  const SectionModes& sections = body.stress->sections;
  EXPECT_EQ(sections.nodes.size(), 24U);  // around node 1, and the interface
  EXPECT_EQ(sections.left_out + sections.nodes.size(), 48U);
}

// ---- a strip of one ply along x, of 0.1 m x 0.02 m, 2 mm thick, held at x = 0

struct Deck {
  double length = 1.0;  ///< units of length per metre
  bool is_turned = false;
};

std::filesystem::path write_strip(const Deck& deck) {
  const std::filesystem::path file = limber::test::own_folder() / "strip.bdf";
  std::ofstream out(file);
  const double l = deck.length;
  const double area = l * l;
  out.precision(12);
  out << "BEGIN BULK\n";
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i <= 4; ++i)
      out << "GRID," << 1 + i + 5 * j << ",," << 0.025 * l * i << ','
          << 0.02 * l * j << ",0.\n";
  for (int i = 0; i < 4; ++i) {
    const int a = 1 + i;
    out << "CQUAD4," << a << ",1," << a << ',';
    if (deck.is_turned) {
      out << a + 5 << ',' << a + 6 << ',' << a + 1 << ",0\n";
    } else {
      out << a + 1 << ',' << a + 6 << ',' << a + 5 << ",0\n";
    }
  }
  out << "MAT8,1," << 1.4e11 / area << ',' << 1e10 / area << ",.3,"
      << 5e9 / area << ',' << 5e9 / area << ',' << 3e9 / area << ','
      << 1600.0 / area / area << "\n,,,," << 1.5e9 / area << ',' << 1.2e9 / area
      << ',' << 5e7 / area << ',' << 2.5e8 / area << ',' << 7e7 / area << '\n';
  out << "PCOMP,1\n,1," << 0.002 * l << ",0.\n";
  out << "SPC1,1,123456,1,6\nENDDATA\n";
  return file;
}

struct Strip {
  Vector6 top;
  Vector6 bottom;
  Vector6 strengths;
};

/// Stress at node 3 under 1 N at node 5, upwards.
Strip load_strip(const Deck& deck) {
  Recipe recipe = make_recipe(write_strip(deck));
  recipe.mesh.unit = 1.0 / deck.length;
  recipe.interfaces = {{"end", TaggedNode{5}}};
  const ReducedBody body = reduce_deck(recipe);
  const StressModes& modes = *body.stress;
  const VectorX stress = modes.Sigma_B * find_static(body, Vector3(0, 0, 1));
  Strip strip;
  for (std::size_t p = 0; p < modes.rows.size(); ++p) {
    if (body.rows.tags[modes.sections.nodes[p]] != 3) continue;
    const auto i = static_cast<Eigen::Index>(p);
    const auto face = static_cast<SectionFace>(modes.sections.faces[p]);
    if (face == SectionFace::top) strip.top = stress.segment<6>(6 * i);
    if (face == SectionFace::bottom) strip.bottom = stress.segment<6>(6 * i);
    strip.strengths = modes.sections.strengths.col(i);
    // Drawn points are on the faces.
    const double z =
        body.rows.x_B(2, static_cast<Eigen::Index>(modes.rows[p])) +
        body.p_MoBcm_M[2];
    const double side = deck.is_turned ? -1.0 : 1.0;
    EXPECT_NEAR(z,
                face == SectionFace::top      ? side * 0.001
                : face == SectionFace::bottom ? side * -0.001
                                              : 0.0,
                1e-12);
  }
  return strip;
}

TEST(SectionModes, OfAShellAreInPascalsInAnyUnit) {
  const Strip metres = load_strip({});
  // Compressed above: 6 M / (b t^2) half-way.
  const double bend = 6.0 * 0.05 / (0.02 * 0.002 * 0.002);
  EXPECT_NEAR(0.5 * (metres.bottom[0] - metres.top[0]), bend, 0.1 * bend);
  EXPECT_LT(metres.top[0], 0.0);
  EXPECT_NEAR(metres.strengths[0], 1.5e9, 1.0);
  const Strip millimetres = load_strip({.length = 1000.0});
  EXPECT_LT((millimetres.top - metres.top).norm(), 1e-6 * bend);
  EXPECT_NEAR(millimetres.strengths[4], 7e7, 1.0);
  const Strip turned = load_strip({.is_turned = true});
  EXPECT_LT((turned.top - metres.bottom).norm(), 1e-6 * bend);
  EXPECT_LT((turned.bottom - metres.top).norm(), 1e-6 * bend);
}

TEST(FailureIndex, IsOneWhereThePlyFails) {
  Vector6 strengths;
  strengths << 1.5e9, 1.2e9, 5e7, 2.5e8, 7e7, 0.0;
  const auto at = [](double s1, double s2, double s12) {
    Vector6 stress = Vector6::Zero();
    stress << s1, s2, 0.0, s12, 0.0, 0.0;
    return stress;
  };
  for (const Vector6& stress :
       {at(1.5e9, 0, 0), at(-1.2e9, 0, 0), at(0, 5e7, 0), at(0, -2.5e8, 0),
        at(0, 0, 7e7), at(0, 0, -7e7)}) {
    EXPECT_NEAR(calc_tsai_wu(stress, strengths), 1.0, 1e-12);
    EXPECT_NEAR(calc_maximum_stress(stress, strengths), 1.0, 1e-12);
  }
  // F12 couples both, and the maximum stress does not.
  const Vector6 both = at(7.5e8, 2.5e7, 0.0);
  const double without = calc_tsai_wu(both, strengths);
  strengths[5] = -1e-18;
  EXPECT_NEAR(calc_tsai_wu(both, strengths), without - 2e-18 * 7.5e8 * 2.5e7,
              1e-12);
  EXPECT_NEAR(calc_maximum_stress(both, strengths), 0.5, 1e-12);
}

}  // namespace
}  // namespace limber::flexbody::section_modes_test
