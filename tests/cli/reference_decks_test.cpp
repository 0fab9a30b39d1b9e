// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "places.hpp"

/// Decks against CalculiX 2.20 and a closed form.
namespace limber::test::reference_decks_test {
namespace {

using nlohmann::json;

const std::string kFolder = LIMBER_SOURCE_DIR "/tests/data/";

std::vector<double> find_frequencies(const std::string& arguments) {
  const Workspace place;
  const CommandResult result =
      place.limber("modes " + kFolder + arguments + " --count 6 --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out).at("frequencies_hz");
}

struct ReferenceDeck {
  const char* arguments;
  std::vector<double> frequencies;  // [Hz]
  double tolerance;
};

void PrintTo(const ReferenceDeck& deck, std::ostream* out) {
  *out << deck.arguments;
}

class ReferenceDecks : public ::testing::TestWithParam<ReferenceDeck> {};

TEST_P(ReferenceDecks, HaveTheFrequenciesOfCalculix) {
  const ReferenceDeck& deck = GetParam();
  const std::vector<double> found = find_frequencies(deck.arguments);
  for (std::size_t i = 0; i < deck.frequencies.size(); ++i)
    EXPECT_NEAR(found.at(i) / deck.frequencies[i], 1.0, deck.tolerance) << i;
}

double to_frequency(double eigenvalue) {
  return std::sqrt(eigenvalue) / (2.0 * M_PI);
}

const std::vector<double> kBimetal = {
    to_frequency(2.2856450e6), to_frequency(4.9696320e6),
    to_frequency(5.6351810e7), to_frequency(1.0949250e8),
    to_frequency(2.1857000e8), to_frequency(3.0038940e8)};

INSTANTIATE_TEST_SUITE_P(
    Solids, ReferenceDecks,
    ::testing::Values(
        ReferenceDeck{"solids/arch.inp",
                      {to_frequency(7.2657640e6), to_frequency(3.1472310e7),
                       to_frequency(3.2717220e7), to_frequency(5.6313540e7),
                       to_frequency(1.4648670e8), to_frequency(1.8488710e8)},
                      2e-3},
        ReferenceDeck{"solids/bimetal.inp --clamp boundary", kBimetal, 6e-3},
        ReferenceDeck{"solids/bimetal.bdf --unit mm --clamp spc:1", kBimetal,
                      6e-3}));

// Of finer meshes, so that what remains is the error of this one.
INSTANTIATE_TEST_SUITE_P(
    Structures, ReferenceDecks,
    ::testing::Values(
        ReferenceDeck{"structures/roof.inp --clamp ROOT",
                      {86.10821, 137.9013, 257.3053, 332.656, 340.2559},
                      0.02},
        ReferenceDeck{"structures/cone.inp --clamp ROOT",
                      {217.6014, 237.5146, 516.3683, 549.1933, 681.9747},
                      0.025},
        ReferenceDeck{"structures/laminate.inp --clamp ROOT",
                      {24.0658, 82.87793, 149.9072, 234.0736, 290.0383},
                      0.035},
        ReferenceDeck{"structures/portal.inp --clamp FEET",
                      {7.663, 12.89678, 24.71029, 31.03093, 54.54832},
                      0.012}));

// CalculiX joins bars by rigid knots of their thickness. Slender beams
// (Euler-Bernoulli) of the same mesh, by a program of its own in SciPy:
INSTANTIATE_TEST_SUITE_P(Bars, ReferenceDecks,
                         ::testing::Values(ReferenceDeck{
                             "structures/portal.inp --clamp FEET",
                             {7.59321113, 12.75628619, 24.5657683, 30.79056318,
                              54.12550269},
                             1.5e-3}));

TEST(DeckInTwoFormats, IsOneBody) {
  const std::vector<double> metres =
      find_frequencies("solids/bimetal.inp --clamp ROOT");
  const std::vector<double> millimetres =
      find_frequencies("solids/bimetal.bdf --unit mm --clamp spc:1");
  for (std::size_t i = 0; i < metres.size(); ++i)
    EXPECT_NEAR(millimetres[i] / metres[i], 1.0, 1e-8) << i;
}

/// Length, E, area, moments of inertia about y and z.
struct ChainPart {
  double L = 0.0;
  double E = 0.0;
  double A = 0.0;
  double I_y = 0.0;
  double I_z = 0.0;
};

/// Each part stretches by F L / (E A) and turns by M L / (E I).
TEST(DeckOfSolidsABeamAndShells, StretchesAndBendsAsItsParts) {
  const std::array<ChainPart, 3> parts = {
      {{0.4, 7e10, 8e-3, 0.1 * std::pow(0.08, 3) / 12.0,
        0.08 * std::pow(0.1, 3) / 12.0},
       {0.5, 2.1e11, 1.2e-3, 5e-7, 3e-7},
       {0.4, 1.1e11, 1.2e-3, 0.12 * std::pow(0.01, 3) / 12.0,
        0.01 * std::pow(0.12, 3) / 12.0}}};
  const double F = 1.0;
  const double M_y = 3e-3;
  const double M_z = 5e-3;
  double stretch = 0.0;
  std::array<double, 2> turned = {0.0, 0.0};
  std::array<double, 2> moved = {0.0, 0.0};
  for (const ChainPart& part : parts) {
    stretch += F * part.L / (part.E * part.A);
    const std::array<double, 2> turns = {M_y * part.L / (part.E * part.I_y),
                                         M_z * part.L / (part.E * part.I_z)};
    for (std::size_t i = 0; i < 2; ++i) {
      moved[i] += (turned[i] + 0.5 * turns[i]) * part.L;
      turned[i] += turns[i];
    }
  }
  const Workspace place;
  place.write(
      "r.urdf",
      "<robot name='r'><link name='l'/><flexible link='l'><mesh file='" +
          kFolder +
          "structures/chain.bdf'/><clamp group='spc:1'/>"
          "<basis eigenmodes='2'/><interface name='tip' node='53'/>"
          "</flexible></robot>\n");
  const auto probe = [](const char* name, const char* quantity) {
    return fmt::format(
        "[[probe]]\nname = '{}'\nlink = 'l'\ninterface = 'tip'\nquantity = "
        "'{}'\n",
        name, quantity);
  };
  place.write("s.toml",
              "robot = 'r.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n[[load]]"
              "\nname = 'end'\nlink = 'l'\ninterface = 'tip'\nforce = [1.0, 0, "
              "0]\nmoment = [0, 3e-3, 5e-3]\nframe = 'world'\n" +
                  probe("tip", "deformation") + probe("turn", "rotation"));
  const CommandResult result = place.limber("static s.toml --out o --cache c");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json probes =
      json::parse(read_text(place.folder() / "o/summary.json")).at("probes");
  const auto expect = [&](const char* column, double right, double tolerance) {
    EXPECT_NEAR(probes.at(column).at("value").get<double>() / right, 1.0,
                tolerance)
        << column;
  };
  // Rotations about the normal of shells are tied to their surface by 1e-3 of
  // their shear stiffness, which adds that much in their plane.
  constexpr double kTied = 3e-5;
  expect("tip.dx", stretch, 1e-9);
  expect("tip.dy", moved[1], kTied);
  expect("tip.dz", -moved[0], 1e-6);
  expect("turn.ry", turned[0], 1e-6);
  expect("turn.rz", turned[1], kTied);
}

}  // namespace
}  // namespace limber::test::reference_decks_test
