// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/material.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::material_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MshText;

const ElasticMaterial kSteel{210e9, 0.3, 7850.0};
const ElasticMaterial kAluminium{70e9, 0.33, 2700.0};

/// Two tetrahedra of volumes 1/6 and 1/3 in groups "steel" and "aluminium".
Mesh two_volumes() {
  MshText text;
  text.name_group(3, 1, "steel");
  text.name_group(3, 2, "aluminium");
  for (const Vector3& x : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0),
                           Vector3(0, 0, 1), Vector3(-2, 0, 0)})
    text.add_node(x);
  text.add_element(MshText::kTetrahedron, {1, 2, 3, 4}, 1);
  text.add_element(MshText::kTetrahedron, {5, 1, 3, 4}, 2);
  return read_mesh(testing::write_file("two.msh", text.str()));
}

Mesh one_volume() {
  return read_mesh(
      testing::write_file("one.msh", testing::unit_tetrahedron().str()));
}

std::string refusal(const Mesh& mesh,
                    const std::vector<MaterialAssignment>& assignments) {
  try {
    static_cast<void>(assign_materials(mesh, assignments));
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(Material, MassOfSeveralVolumesIsTheirSum) {
  const Mesh mesh = two_volumes();
  const auto materials =
      assign_materials(mesh, {{"aluminium", kAluminium}, {"", kSteel}});
  const auto body = calc_mass_properties(assemble(mesh, materials).M_s, mesh.x);
  EXPECT_NEAR(body.mass, 7850.0 / 6.0 + 2700.0 / 3.0, 1e-9);
}

TEST(Material, StiffnessOfSeveralVolumesIsTheirSum) {
  const Mesh mesh = two_volumes();
  const auto stiffness = [&](double first, double second) {
    return assemble(mesh,
                    assign_materials(mesh, {{"steel", {first, 0.3, 1.0}},
                                            {"aluminium", {second, 0.3, 1.0}}}))
        .K;
  };
  const MatrixX sum = stiffness(3.0, 5.0);
  const MatrixX parts = 3.0 * MatrixX(stiffness(1.0, 1e-300)) +
                        5.0 * MatrixX(stiffness(1e-300, 1.0));
  EXPECT_LT((sum - parts).norm() / sum.norm(), 1e-14);
}

TEST(Material, ValuesOutOfRangeAreRefused) {
  const Mesh mesh = one_volume();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double density : {-7850.0, 0.0, nan})
    EXPECT_THAT(refusal(mesh, {{"body", {210e9, 0.3, density}}}),
                AllOf(HasSubstr("group 'body'"), HasSubstr("density"),
                      HasSubstr("kg/m^3; expected a positive number")));
  for (const double modulus : {-210e9, 0.0, nan})
    EXPECT_THAT(refusal(mesh, {{"body", {modulus, 0.3, 7850.0}}}),
                AllOf(HasSubstr("group 'body'"), HasSubstr("Young's modulus"),
                      HasSubstr("Pa; expected a positive number")));
  for (const double ratio : {0.5, 0.7, -1.0, -2.0, nan})
    EXPECT_THAT(refusal(mesh, {{"body", {210e9, ratio, 7850.0}}}),
                AllOf(HasSubstr("group 'body'"), HasSubstr("Poisson's ratio"),
                      HasSubstr("expected above -1 and below 0.5")));
}

TEST(Material, AllProblemsAreReportedAtOnce) {
  try {
    static_cast<void>(
        assign_materials(one_volume(), {{"boody", {-1.0, 0.5, -1.0}}}));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 4U);
    EXPECT_THAT(error.what(), HasSubstr("'body'"));  // the likely name
  }
}

TEST(Material, VolumeWithoutAMaterialIsRefused) {
  EXPECT_THAT(refusal(two_volumes(), {{"steel", kSteel}}),
              AllOf(HasSubstr("two.msh"), HasSubstr("'aluminium'"),
                    HasSubstr("no materials; expected one")));
  EXPECT_THAT(refusal(one_volume(), {}), HasSubstr("no materials"));
}

TEST(Material, MoreMaterialsThanVolumesAreRefused) {
  EXPECT_THAT(refusal(one_volume(), {{"body", kSteel}, {"body", kAluminium}}),
              AllOf(HasSubstr("'body'"), HasSubstr("several materials")));
  EXPECT_THAT(refusal(one_volume(), {{"", kSteel}, {"", kAluminium}}),
              HasSubstr("several materials"));
  EXPECT_THAT(refusal(one_volume(), {{"body", kSteel}, {"", kAluminium}}),
              AllOf(HasSubstr("one.msh"), HasSubstr("left over"),
                    HasSubstr("Expected no more materials than volumes")));
  EXPECT_THAT(refusal(one_volume(), {{"body", kSteel}, {"arm", kAluminium}}),
              AllOf(HasSubstr("'arm'"), HasSubstr("volume group")));
}

}  // namespace
}  // namespace limber::fem::material_test
