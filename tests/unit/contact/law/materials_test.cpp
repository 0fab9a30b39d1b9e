// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/materials.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/contact/law/hertz_law.hpp"

namespace limber::contact::materials_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr SurfaceMaterial kSteel{.youngs_modulus = 210e9, .poisson_ratio = 0.3};
constexpr SurfaceMaterial kAluminium{.youngs_modulus = 70e9,
                                     .poisson_ratio = 0.33};

// Mindlin (1949): of equal spheres k_t / k_n = 2 (1 - nu) / (2 - nu).
TEST(Materials, EqualSidesHaveMindlinsRatioOfStiffnesses) {
  for (const double nu : {0.0, 0.2, 0.3, 0.49}) {
    const SurfaceMaterial side{.youngs_modulus = 7e10, .poisson_ratio = nu};
    EXPECT_NEAR(find_pair_moduli(side, side)->tangential_ratio(),
                2.0 * (1.0 - nu) / (2.0 - nu), 1e-14);
    EXPECT_NEAR(find_pair_moduli(side, {})->tangential_ratio(),
                2.0 * (1.0 - nu) / (2.0 - nu), 1e-14);
  }
  const SurfaceMaterial usual{.youngs_modulus = 1.0, .poisson_ratio = 0.3};
  EXPECT_NEAR(find_pair_moduli(usual, usual)->tangential_ratio(),
              kDefaultTangentialRatio, 1e-15);
}

TEST(Materials, CompliancesOfTheSidesAdd) {
  const PairModuli both = *find_pair_moduli(kSteel, kAluminium);
  const PairModuli steel = *find_pair_moduli(kSteel, {});
  const PairModuli aluminium = *find_pair_moduli({}, kAluminium);
  const auto series = [](double a, double b) { return a * b / (a + b); };
  EXPECT_NEAR(both.normal / series(steel.normal, aluminium.normal), 1.0, 1e-14);
  EXPECT_NEAR(both.tangential / series(steel.tangential, aluminium.tangential),
              1.0, 1e-14);
  EXPECT_NEAR(both.torsional / series(steel.torsional, aluminium.torsional),
              1.0, 1e-14);
  EXPECT_NEAR(steel.normal / (210e9 / 0.91), 1.0, 1e-14);
  EXPECT_NEAR(steel.torsional / (210e9 / 2.6), 1.0, 1e-14);
}

TEST(Materials, TheSidesMayBeExchanged) {
  const PairModuli a = *find_pair_moduli(kSteel, kAluminium);
  const PairModuli b = *find_pair_moduli(kAluminium, kSteel);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.tangential, b.tangential);
  EXPECT_EQ(a.torsional, b.torsional);
}

TEST(Materials, WithoutAnyThereAreNoModuli) {
  EXPECT_FALSE(find_pair_moduli({}, {}).has_value());
}

// k_n = 2 a E* with a^3 = 3 f R_e / (4 E*), both of Johnson (1985, ch. 4).
TEST(Materials, HertzsStiffnessIsThatOfTheAreasRadius) {
  const double modulus = find_pair_moduli(kSteel, kAluminium)->normal;
  for (const double radius : {1e-4, 0.01, 3.0}) {
    const HertzLaw law({.stiffness = find_hertz_stiffness(modulus, radius)});
    for (const double depth : {1e-9, 1e-6, 1e-5}) {
      const HertzLaw::Response r = law.evaluate(depth);
      const double a = find_contact_radius(radius, r.hertz_depth);
      EXPECT_NEAR(r.stiffness / (2.0 * a * modulus), 1.0, 1e-13);
      EXPECT_NEAR(a / std::cbrt(0.75 * r.force * radius / modulus), 1.0, 1e-13);
    }
  }
}

TEST(Materials, BadValuesAreRefused) {
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    EXPECT_THROW(static_cast<void>(find_pair_moduli(
                     SurfaceMaterial{.youngs_modulus = bad}, kSteel)),
                 InputError);
    EXPECT_THROW(static_cast<void>(find_pair_moduli(
                     kSteel, SurfaceMaterial{.youngs_modulus = bad})),
                 InputError);
    EXPECT_THROW(static_cast<void>(find_hertz_stiffness(bad, 1.0)), InputError);
    EXPECT_THROW(static_cast<void>(find_hertz_stiffness(1.0, bad)), InputError);
  }
  for (const double bad : {-1.0, 0.51, kNaN}) {
    EXPECT_THROW(
        static_cast<void>(find_pair_moduli(
            SurfaceMaterial{.youngs_modulus = 1.0, .poisson_ratio = bad}, {})),
        InputError);
  }
  EXPECT_THROW(static_cast<void>(find_contact_radius(1.0, -1e-9)),
               ContractError);
  EXPECT_THROW(static_cast<void>(find_contact_radius(1.0, kNaN)),
               ContractError);
}

}  // namespace
}  // namespace limber::contact::materials_test
