// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/akantu_material.hpp"

#include <gmock/gmock.h>

#include "unit/scene/temporary_file.hpp"

namespace limber::scene::akantu_material_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<flexbody::MaterialRegion> read(const std::string& text) {
  const TemporaryFile file("material.dat", text);
  return read_akantu_materials(file.path());
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)read(text); });
}

TEST(AkantuMaterial, OneSectionHoldsForTheWholeMesh) {
  const auto regions = read(
      "# steel\nmaterial elastic [\n  name = steel\n  rho = 7800 # density\n"
      "  E   = 2.1e11\n  nu  = 0.3\n]\n");
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].group, "");
  EXPECT_EQ(regions[0].material.density, 7800.0);
  EXPECT_EQ(regions[0].material.youngs_modulus, 2.1e11);
  EXPECT_EQ(regions[0].material.poisson_ratio, 0.3);
}

TEST(AkantuMaterial, SeveralSectionsGoToTheGroupsOfTheirNames) {
  const auto regions = read(
      "material elastic [name=a rho=1 E=2]\n"
      "material elastic [ name = b rho = 3 E = 4 nu = 0.1 ]\n");
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].group, "a");
  EXPECT_EQ(regions[0].material.poisson_ratio, 0.0);
  EXPECT_EQ(regions[1].group, "b");
}

TEST(AkantuMaterial, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(error_of("material neohookean [ E = 1 rho = 1 ]"),
              AllOf(HasSubstr("material.dat:1"), HasSubstr("neohookean")));
  EXPECT_THAT(error_of("material elastic [\nrh = 1\nE = 1 ]"),
              AllOf(HasSubstr("material.dat:2"), HasSubstr("rho")));
}

TEST(AkantuMaterial, RefusesValuesOutOfRange) {
  EXPECT_THAT(error_of("material elastic [\nrho = -1\nE = 1 ]"),
              AllOf(HasSubstr("material.dat:2"), HasSubstr("rho")));
  EXPECT_THAT(error_of("material elastic [\nrho = 1\nE = 1\nnu = 0.5 ]"),
              HasSubstr("nu"));
  EXPECT_THAT(error_of("material elastic [ rho = 1 E = many ]"),
              HasSubstr("many"));
  EXPECT_THAT(error_of("material elastic [ rho = 1 E = inf ]"),
              HasSubstr("inf"));
  EXPECT_THAT(error_of(std::string("material elastic [rho=1 E=1\0 ]", 30)),
              HasSubstr("E [Pa]"));
}

TEST(AkantuMaterial, RefusesASectionThatIsNotWhole) {
  EXPECT_THAT(error_of("material elastic [ rho = 1 ]"), HasSubstr("'E'"));
  EXPECT_THAT(error_of("material elastic [ rho = 1 E = 2"),
              HasSubstr("ends within"));
  EXPECT_THAT(error_of("model solid [ ]"), HasSubstr("no 'material"));
}

}  // namespace
}  // namespace limber::scene::akantu_material_test
