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

/// CalculiX 2.20 of the same elements.
TEST_F(Structures, OfSolidsJoinedByARigidBodyHaveTheFrequenciesOfCalculix) {
  const std::vector<double> frequencies = {314.9101, 511.9711, 838.1658,
                                           1308.886, 1319.432};
  expect_frequencies("two_bars.inp", frequencies, 1e-6);
  expect_frequencies("two_instances.inp", frequencies, 1e-6);
}

/// CalculiX 2.20, the beam as solids of second order. A spider holds the
/// section of a solid in its plane, on its both sides there, on one here.
TEST_F(Structures, OfASolidAndABeamHaveTheFrequenciesOfCalculix) {
  expect_frequencies("block_beam.bdf",
                     {314.9101, 511.9711, 838.1658, 1308.886, 1319.432}, 0.015);
}

/// CalculiX 2.20: of this mesh, solids as C3D8I and shells as such; a finer one
/// has 161.69, 370.88, 581.70, 1156.5, 1492.7.
TEST_F(Structures, OfASolidAndAPlateHaveTheFrequenciesOfCalculix) {
  expect_frequencies("block_plate.inp",
                     {162.123, 373.107, 585.323, 1168.21, 1509.18}, 0.012);
}

TEST_F(Structures, HaveMassesAndRigidArms) {
  const CommandResult result =
      place_.limber("modes " + kFolder + "boom.bdf --count 1 --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  // Two metres of tube, and 5 kg.
  const double tube = 2700.0 * 2.0 * M_PI * (0.05 * 0.05 - 0.045 * 0.045);
  EXPECT_NEAR(json::parse(result.out)["mass"].get<double>(), tube + 5.0, 1e-9);
}

/// A tube of 2 m under 1 N at its end, small: F L^3 / (3 E I) + F L / (k G A)
/// with Cowper's k of a hollow circle, and of the end's rotation 0.2 F L^2 / (2
/// E I) at the end of the rigid arm.
TEST_F(Structures, BendAsTimoshenkosCantilever) {
  place_.write("arm.urdf",
               "<robot name='arm'><link name='boom'/><flexible link='boom'>"
               "<mesh file='" +
                   kFolder +
                   "boom.bdf'/><clamp group='spc:1'/><basis eigenmodes='2'/>"
                   "<interface name='end' node='3'/>"
                   "<interface name='tool' node='4'/></flexible></robot>\n");
  place_.write("s.toml",
               "robot = 'arm.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n"
               "[[load]]\nname = 'pull'\nlink = 'boom'\ninterface = 'end'\n"
               "force = [0, 1, 0]\nframe = 'world'\n"
               "[[probe]]\nname = 'end'\nlink = 'boom'\ninterface = 'end'\n"
               "quantity = 'deformation'\n"
               "[[probe]]\nname = 'tool'\nlink = 'boom'\ninterface = "
               "'tool'\nquantity = 'deformation'\n");
  const CommandResult result = place_.limber("static s.toml --out o --cache c");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json probes =
      json::parse(read_text(place_.folder() / "o/summary.json")).at("probes");
  const double E = 7e10;
  const double nu = 0.33;
  const double m2 = 0.81;  // square of the ratio of radii
  const double A = M_PI * 0.05 * 0.05 * (1.0 - m2);
  const double I = M_PI / 4.0 * std::pow(0.05, 4) * (1.0 - m2 * m2);
  const double k =
      6.0 * (1.0 + nu) * (1.0 + m2) * (1.0 + m2) /
      ((7.0 + 6.0 * nu) * (1.0 + m2) * (1.0 + m2) + (20.0 + 12.0 * nu) * m2);
  const double kGA = k * E / (2.0 * (1.0 + nu)) * A;
  const double end = 8.0 / (3.0 * E * I) + 2.0 / kGA;
  EXPECT_NEAR(probes.at("end.dy").at("value").get<double>(), end, 1e-7 * end);
  const double tool = end + 0.2 * 4.0 / (2.0 * E * I);
  EXPECT_NEAR(probes.at("tool.dy").at("value").get<double>(), tool,
              1e-7 * tool);
}

/// Of a plate that is struck and spins by 5 rad/s about an oblique axis.
TEST_F(Structures, KeepTheirEnergyInASpin) {
  place_.write("plate.urdf",
               "<robot name='plate'><link name='plate'/><flexible "
               "link='plate'><mesh file='" +
                   kFolder +
                   "plate16.inp'/><basis eigenmodes='6'/>"
                   "<interface name='tip' node='17'/></flexible></robot>\n");
  place_.write(
      "s.toml",
      "robot = 'plate.urdf'\n[time]\nduration = 0.2\nstep = 0.0005\n"
      "integrator = 'energy-conserving'\n[output]\npictures = false\n"
      "[initial.base]\nangular_velocity = [3, 2, 3.4641]\n"
      "[[load]]\nname = 'blow'\nlink = 'plate'\ninterface = 'tip'\n"
      "force = [0, 0, 20]\ntime = { kind = 'pulse', shape = 'half-sine', "
      "start = 0.0, duration = 0.01 }\n");
  const CommandResult result = place_.limber("run s.toml --out o --cache c");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json energy =
      json::parse(read_text(place_.folder() / "o/summary.json")).at("energy");
  EXPECT_GT(std::abs(energy.at("work").get<double>()), 0.1);  // J
  EXPECT_LT(std::abs(energy.at("relative_drift").get<double>()), 1e-9);
}

TEST_F(Structures, TellWhatWouldBeLost) {
  place_.write("bad.bdf",
               "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nMAT1,1,7.E+10,,.33,2700.\n"
               "PBARL,1,1,,HAT\n,.05,.045\nCBAR,1,1,1,2,0.,1.,0.\n"
               "RBE3,3,,2,1.,123,1\n");
  const CommandResult result = place_.limber("modes bad.bdf");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("bad.bdf:4: PBARL 1: section 'HAT'"));
  EXPECT_THAT(result.errors,
              HasSubstr("bad.bdf:7: RBE3 3: REFC is '1.'. Expected 123456"));
}

TEST_F(Structures, ListKeywordsThatAreNotUsedAndRefuseOthers) {
  std::string deck = read_text(kFolder + "frame20.inp");
  deck.insert(deck.find("*DENSITY"), "*PLASTIC\n1e9, 0.\n*STOP\n");
  place_.write("frame.inp", deck);
  const CommandResult refused = place_.limber("modes frame.inp --count 1");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("*STOP would be lost"));
  const CommandResult result =
      place_.limber("modes frame.inp --count 1 --ignore STOP");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("so that the body lacks them: 1 *STOP"));
  EXPECT_THAT(result.errors, HasSubstr("linear elastic: 1 *PLASTIC"));
}

TEST_F(Structures, AreDescribed) {
  const CommandResult result =
      place_.limber("info " + kFolder + "boom.bdf --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json info = json::parse(result.out);
  EXPECT_EQ(info.at("kind"), "beams and shells");
  EXPECT_EQ(info.at("beams"), 2);
  EXPECT_NEAR(info.at("size")[0].get<double>(), 2.2, 1e-12);
  const CommandResult operate =
      place_.limber("operate " + kFolder + "boom.bdf");
  EXPECT_EQ(operate.status, 2);
  EXPECT_THAT(operate.errors, HasSubstr("needs a body of solids"));
}

/// A tube in metres and newtons, and in inches and pounds.
TEST_F(Structures, HaveForcesInPounds) {
  const auto find_lowest = [&](const std::string& deck,
                               const std::string& more) {
    place_.write("tube.bdf", deck);
    const CommandResult result =
        place_.limber("modes tube.bdf --count 1 --json" + more);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.out)["frequencies_hz"][0].get<double>();
  };
  const std::string ends = "GRID,1,,0.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\n";
  const double metric =
      find_lowest(ends +
                      "GRID,2,,2.54,0.,0.\nPBARL,1,1,,TUBE\n,.0508,.0254\n"
                      "MAT1,1,6.894757293168361E+10,,.3,2767.9342783\n",
                  "");
  const std::string imperial = ends +
                               "GRID,2,,100.,0.,0.\nPBARL,1,1,,TUBE\n,2.,1.\n"
                               "MAT1,1,1.E+7,,.3,2.5900266E-4\n";
  EXPECT_NEAR(find_lowest(imperial, " --unit in --force-unit lbf"), metric,
              1e-6 * metric);
  const CommandResult result = place_.limber("modes tube.bdf --unit in");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("unit of force is not known"));
}

}  // namespace
}  // namespace limber::test::structures_test
