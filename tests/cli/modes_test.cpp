// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::modes_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const char* const kBeam = LIMBER_SOURCE_DIR "/tests/data/beam/beam579_v22.msh";
constexpr double kClamped = 0.0;  ///< z of the group "root" [m]

/// Positions in the order of the tags, from the file itself.
std::vector<std::array<double, 3>> read_positions() {
  std::ifstream file(kBeam);
  std::string word;
  while (file >> word && word != "$Nodes") continue;
  std::size_t count = 0;
  file >> count;
  std::vector<std::array<double, 3>> positions(count);
  for (auto& x : positions) file >> word >> x[0] >> x[1] >> x[2];
  return positions;
}

bool is_near(double a, double b) { return std::abs(a - b) < 1e-9; }

/// The report's shear test (section 5.3, Figure 6a): 500 N in x on each of the
/// five nodes of the edge x = 0, z = 5; then twice that, which is the same
/// load case.
std::string shear_file() {
  std::string text = "0 1\n";
  int loaded = 0;
  for (const auto& x : read_positions()) {
    if (is_near(x[2], kClamped)) continue;
    const bool is_loaded = is_near(x[0], 0.0) && is_near(x[2], 5.0);
    loaded += is_loaded ? 1 : 0;
    text += is_loaded ? "500 1000\n" : "0 0\n";
    text += "0 0\n0 0\n";
  }
  EXPECT_EQ(loaded, 5);
  return text;
}

class Modes : public ::testing::Test {
 protected:
  [[nodiscard]] CommandResult modes(const std::string& more) const {
    return place_.limber(std::string("modes ") + kBeam +
                         " --youngs-modulus 200e9 --poisson-ratio 0 --density "
                         "8000 " +
                         more);
  }
  Workspace place_;
};

// Table 2, left: percentages of all modes, total 1.71e-3. "Only the first mode
// is necessary" for 90 %.
TEST_F(Modes, GiveTheEffectiveMassesOfTheReportsTable2) {
  place_.write("shear.txt", shear_file());
  const CommandResult result = modes("--clamp root --force shear.txt --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json cases = json::parse(result.out)["load_cases"];
  ASSERT_EQ(cases.size(), 1U);
  const json& found = cases[0];
  constexpr double kPoint = 0.5;
  constexpr std::array<double, 10> kReport{94.91, 0.97, 0.39, 1.96, 0.00,
                                           0.00,  0.18, 0.00, 0.04, 0.01};
  double sum = 0.0;
  for (std::size_t i = 0; i < kReport.size(); ++i) {
    const double percent = found["effective_mass_percent"][i];
    sum += percent;
    EXPECT_NEAR(percent, kReport[i], kPoint) << "mode " << i + 1;
    EXPECT_NEAR(found["effective_mass_cumulative_percent"][i], sum, 1e-9);
  }
  EXPECT_NEAR(found["effective_mass_total"], 1.71e-3, 0.005e-3);
}

// Blevins, Formulas for Natural Frequency and Mode Shape, 1979, tables 8-1 and
// 8-16: bending 0.613 of a cantilever's mass, stretching 8 / pi^2. The nodes
// of the clamp have 1.3 % of the mass.
TEST_F(Modes, OfAClampedBodyGiveItsEffectiveModalMasses) {
  const CommandResult result = modes("--clamp root --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json base = json::parse(result.out)["base_motion"];
  const auto percent = [&](std::size_t mode, std::size_t axis) {
    return base["effective_mass_percent"][mode][axis].get<double>();
  };
  const double bending =
      0.5 * (percent(0, 0) + percent(0, 1) + percent(1, 0) + percent(1, 1));
  EXPECT_NEAR(bending, 61.3, 1.3);
  EXPECT_NEAR(percent(5, 2), 800.0 / (M_PI * M_PI), 1.3);
  EXPECT_NEAR(base["total"][2], 40000.0, 0.013 * 40000.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0.0;
    for (std::size_t mode = 0; mode < 10; ++mode) {
      const double factor = base["participation_factors"][mode][axis];
      EXPECT_NEAR(base["effective_mass"][mode][axis], factor * factor, 1e-6);
      sum += percent(mode, axis);
    }
    EXPECT_NEAR(base["cumulative_percent"][9][axis], sum, 1e-9);
    EXPECT_LT(sum, 100.0);
  }
}

TEST_F(Modes, OfAFreeBodyHaveNoBaseMotion) {
  const json free = json::parse(modes("--json").out);
  EXPECT_FALSE(free.contains("base_motion"));
  EXPECT_FALSE(free.contains("load_cases"));
}

// A static-deformation mode represents its load exactly; by Rayleigh-Ritz,
// modes added to the lowest eigenmodes lie above them and do not change them.
TEST_F(Modes, OfABasisWithStaticDeformationAnswerTheLoadWhole) {
  place_.write("shear.txt", shear_file());
  const std::string load = "--clamp root --force shear.txt --json ";
  const json alone = json::parse(modes(load + "--count 3").out);
  for (const int terms : {1, 3}) {
    const CommandResult r =
        modes(load + fmt::format("--count 2 --static {}", terms));
    ASSERT_EQ(r.status, 0) << r.errors;
    const json basis = json::parse(r.out);
    const json& values = basis["eigenvalues"];
    ASSERT_EQ(values.size(), 2U + static_cast<std::size_t>(terms));
    for (const std::size_t i : {0U, 1U}) {
      const double eigenvalue = alone["eigenvalues"][i];
      EXPECT_NEAR(values[i], eigenvalue, 1e-8 * eigenvalue);
    }
    EXPECT_GT(values[2], alone["eigenvalues"][2]);
    const json& fractions =
        basis["load_cases"][0]["compliance_cumulative_percent"];
    EXPECT_NEAR(fractions.back(), 100.0, 1e-7);
    EXPECT_LT(alone["load_cases"][0]["compliance_cumulative_percent"].back(),
              99.9);
  }
}

TEST_F(Modes, RefuseStaticDeformationOfNothing) {
  for (const char* more :
       {"--static 2", "--interface tip", "--count 0 --clamp root"}) {
    EXPECT_EQ(modes(more).status, 2) << more;
  }
}

TEST_F(Modes, PrintTablesForPeople) {
  place_.write("shear.txt", shear_file());
  const CommandResult result =
      modes("--clamp root --force shear.txt --count 2");
  EXPECT_THAT(result.out, HasSubstr("load 'shear.txt from 0 s'"));
  EXPECT_THAT(result.out, HasSubstr("94.9"));
  EXPECT_THAT(result.out, HasSubstr("base motion"));
}

TEST_F(Modes, RefuseAForceFileForAnotherSupport) {
  place_.write("shear.txt", shear_file());
  const CommandResult result = modes("--force shear.txt");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("1626 rows of forces; expected 1737"));
}

}  // namespace
}  // namespace limber::test::modes_test
