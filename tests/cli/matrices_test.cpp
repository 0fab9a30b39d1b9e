// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

/// Bodies from stiffness and mass matrices, by the command.
namespace limber::test::matrices_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kFolder = LIMBER_SOURCE_DIR "/tests/data/matrices/";

class Matrices : public ::testing::Test {
 protected:
  Workspace place_;
};

TEST_F(Matrices, GiveTheModesOfABeam) {
  const CommandResult result = place_.limber(
      "modes --matrices " + kFolder + "beam --mass 4.68 --count 2 --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json study = json::parse(result.out);
  EXPECT_FALSE(study["found"].empty());
  EXPECT_NEAR(study["mass"].get<double>(), 4.68, 1e-12);
  // Euler and Bernoulli: 22.3733 / (2 pi) sqrt(EI / (m L^3)).
  const double f = 22.37329 / (2.0 * M_PI) * std::sqrt(4000.0 / 4.68);
  EXPECT_NEAR(study["frequencies_hz"][0].get<double>(), f, 1e-4 * f);
}

TEST_F(Matrices, InMillimetresNeedTheirUnit) {
  const std::string model = "modes --matrices " + kFolder + "beam_mm ";
  EXPECT_EQ(place_.limber(model + "--mass 4.68 --unit mm").status, 0);
  const CommandResult result = place_.limber(model + "--mass 4.68");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("if lengths were in mm"));
}

TEST_F(Matrices, NeedTheirMassAndNoMaterial) {
  const std::string model = "modes --matrices " + kFolder + "beam ";
  const CommandResult result = place_.limber(model);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("--mass is 0 kg"));
  EXPECT_THAT(place_.limber(model + "--mass 4.68 --density 7800").errors,
              HasSubstr("go with a mesh"));
}

/// A cantilever of 1 m under 1 N at its tip, small: F L^3 / (3 E I) and, of the
/// node's own rotation, F L^2 / (2 E I).
TEST_F(Matrices, OfARobotsLinkBendAsACantilever) {
  place_.write("arm.urdf",
               "<robot name='arm'><link name='beam'/><flexible link='beam'>"
               "<matrices path='" +
                   kFolder +
                   "beam' mass='4.68'/><clamp group='node:1'/>"
                   "<basis eigenmodes='4'/><interface name='tip' node='21'/>"
                   "</flexible></robot>\n");
  place_.write("s.toml",
               "robot = 'arm.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n"
               "[[load]]\nname = 'tip'\nlink = 'beam'\ninterface = 'tip'\n"
               "force = [0, 1, 0]\nframe = 'world'\n"
               "[[probe]]\nname = 'tip'\nlink = 'beam'\ninterface = 'tip'\n"
               "quantity = 'deformation'\n");
  const CommandResult result = place_.limber("static s.toml --out o --cache c");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json summary =
      json::parse(read_text(place_.folder() / "o/summary.json"));
  const double found = summary.at("probes").at("tip.dy").at("value");
  EXPECT_NEAR(found, 1.0 / (3.0 * 4000.0), 1e-9 / (3.0 * 4000.0) + 1e-12);
  // From the cache, without reading the matrices.
  EXPECT_EQ(place_.limber("static s.toml --out o2 --cache c").status, 0);
}

/// A free superelement that spins: its recovery rows say where its mass moves.
class Superelement : public Matrices {
 protected:
  [[nodiscard]] CommandResult run(const std::string& level,
                                  const std::string& recovery) const {
    const std::string folder = kFolder + "superelement";
    place_.write("arm.urdf",
                 "<robot name='arm'><link name='arm'/><flexible link='arm'>"
                 "<matrices path='" +
                     folder + "' mass='7.4'" + recovery +
                     "/><basis eigenmodes='4'/><interface name='tip' node='2'/>"
                     "</flexible></robot>\n");
    place_.write("s.toml",
                 "robot = 'arm.urdf'\n[time]\nduration = 0.002\nstep = "
                 "0.0002\n[output]\npictures = false\n[fidelity]\ndefault = '" +
                     level +
                     "'\n[[load]]\nname = 'tip'\nlink = 'arm'\ninterface = "
                     "'tip'\nforce = [0, 1, 0]\n");
    return place_.limber("run s.toml --out o --cache c");
  }
};

TEST_F(Superelement, RunsAtLevelUncoupled) {
  const CommandResult result = run("uncoupled", "");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("only levels rigid and uncoupled"));
  EXPECT_THAT(result.out + result.errors, HasSubstr("found K.mtx: stiffness"));
}

TEST_F(Superelement, IsRefusedAboveWithTheReason) {
  for (const char* level : {"one-way", "coupled"}) {
    const CommandResult result = run(level, "");
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors, HasSubstr("rows without a node"));
    EXPECT_THAT(result.errors, HasSubstr("choose level uncoupled"));
  }
}

TEST_F(Superelement, WithRecoveryRowsRunsAtLevelCoupled) {
  const std::string folder = kFolder + "superelement/recovery/";
  const CommandResult result =
      run("coupled", " recovery_file='" + folder + "otm.mtx' points_file='" +
                         folder + "points.csv'");
  EXPECT_EQ(result.status, 0) << result.errors;
  const CommandResult reduced = place_.limber(
      "reduce --matrices " + kFolder + "superelement --mass 7.4 --recovery " +
      folder + "otm.mtx " + folder + "points.csv -o b.h5 --interface node:110");
  EXPECT_EQ(reduced.status, 0) << reduced.errors;
  EXPECT_EQ(reduced.errors, "");
}

TEST_F(Superelement, NeedsMatricesForItsRecoveryRows) {
  EXPECT_THAT(place_
                  .limber("reduce a.msh --recovery x.mtx --youngs-modulus 1 "
                          "--poisson-ratio 0.3 --density 1 -o b.h5")
                  .errors,
              HasSubstr("--recovery goes with --matrices"));
}

}  // namespace
}  // namespace limber::test::matrices_test
