// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/command.hpp"
#include "places.hpp"

/// Decks of beams and shells, by the command.
namespace limber::test::structures_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kFolder = LIMBER_SOURCE_DIR "/tests/data/structures/";

class Structures : public ::testing::Test {
 protected:
  void expect_frequencies(const std::string& deck,
                          const std::vector<double>& expected,
                          double tolerance) const {
    const CommandResult result =
        place_.limber("modes " + kFolder + deck + " --count 5 --json");
    ASSERT_EQ(result.status, 0) << result.errors;
    const json study = json::parse(result.out);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(study["frequencies_hz"][i].get<double>(), expected[i],
                  tolerance * expected[i]);
  }

  Workspace place_;
};

/// CalculiX 2.20 with twice the elements: B31 by C3D8I, S4 by C3D8I.
TEST_F(Structures, HaveTheFrequenciesOfCalculix) {
  expect_frequencies("frame20.inp",
                     {52.75766, 150.8678, 220.2013, 341.1313, 456.7671}, 0.01);
  expect_frequencies("plate16.inp",
                     {95.14645, 106.7729, 221.4544, 226.0225, 277.6190}, 0.015);
}

TEST_F(Structures, HaveMassesAndRigidArms) {
  const CommandResult result =
      place_.limber("modes " + kFolder + "boom.bdf --count 1 --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  // Two metres of tube, and 5 kg.
  const double tube = 2700.0 * 2.0 * M_PI * (0.05 * 0.05 - 0.045 * 0.045);
  EXPECT_NEAR(json::parse(result.out)["mass"].get<double>(), tube + 5.0, 1e-9);
}

TEST_F(Structures, TellWhatWouldBeLost) {
  place_.write("bad.bdf",
               "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nMAT1,1,7.E+10,,.33,2700.\n"
               "PBARL,1,1,,HAT\n,.05,.045\nCBAR,1,1,1,2,0.,1.,0.\n"
               "RBE3,3,,2,123456,1.,123,1\n");
  const CommandResult result = place_.limber("modes bad.bdf");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("bad.bdf:4: PBARL 1: section 'HAT'"));
  EXPECT_THAT(result.errors, HasSubstr("bad.bdf:7: RBE3 is not read"));
}

}  // namespace
}  // namespace limber::test::structures_test
