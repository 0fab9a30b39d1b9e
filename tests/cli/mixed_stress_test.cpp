// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/stress_answers.hpp"
#include "places.hpp"

/// Stress of decks of solids beside beams and shells, by the command.
namespace limber::test::mixed_stress_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kDeck =
    read_text(LIMBER_SOURCE_DIR "/tests/data/structures/block_beam.bdf");

void write_robot(const Workspace& place, const std::string& flexible) {
  place.write("arm.urdf",
              "<robot name='arm'><link name='bar'/><flexible link='bar'>" +
                  flexible + "</flexible></robot>\n");
}

void write_deck(const Workspace& place, const std::string& text, int end,
                const std::string& unit = "m") {
  place.write("deck.bdf", text);
  write_robot(place, fmt::format("<mesh file='deck.bdf' unit='{}'/>"
                                 "<clamp group='spc:1'/><basis eigenmodes='2'/>"
                                 "<interface name='end' node='{}'/>",
                                 unit, end));
}

void write_scene(const Workspace& place, const std::string& force,
                 const std::string& probes) {
  place.write(
      "s.toml",
      fmt::format("robot = 'arm.urdf'\n[time]\nduration = 0.001\nstep = 1e-4\n"
                  "[output]\npictures = false\nstress = true\n"
                  "[[load]]\nname = 'pull'\nlink = 'bar'\ninterface = 'end'\n"
                  "force = {}\nframe = 'world'\n{}",
                  force, probes));
}

/// Cards, with the lines that continue them, by what replaces each.
std::string change_cards(
    const std::string& text,
    const std::function<std::string(const std::string&)>& change) {
  std::istringstream in(text);
  std::string changed;
  std::string card;
  for (std::string line; std::getline(in, line); card += line + '\n') {
    if (line.starts_with(",")) continue;
    if (!card.empty()) changed += change(card);
    card.clear();
  }
  return changed + card;
}

// ---- a bar of 0.1 x 0.06 m, half of it of solids and half a beam, held at
// its foot, under 1 kN along y at the beam's end

constexpr double kForce = 1000.0;
constexpr double kInertia = 0.06 * 1e-3 / 12.0;
const std::string kForceText = "[0, 1000, 0]";

const std::string kProbes =
    probe_text("solid", "stress", "nearest = [0.25, 0.05, 0]") +
    probe_text("below", "stress", "nearest = [0.25, -0.05, 0]") +
    probe_text("beam", "von_mises", "node = 5004") +
    probe_text("foot", "section_force", "node = 5000\nelement = 900") +
    probe_text("most", "max_principal", "");

TEST(MixedStress, OfASolidThatABeamContinuesIsThatOfACantilever) {
  const Workspace place;
  write_deck(place, kDeck, 5008);
  write_scene(place, kForceText, kProbes);
  const json summary = answer(place, "static s.toml");
  const auto bend = [](double arm) { return kForce * arm * 0.05 / kInertia; };
  EXPECT_NEAR(value(summary, "solid.sxx"), -bend(0.75), 0.005 * bend(0.75));
  EXPECT_NEAR(value(summary, "below.sxx"), bend(0.75), 0.005 * bend(0.75));
  EXPECT_NEAR(value(summary, "beam.von_mises"), bend(0.25), 1e-5 * bend(0.25));
  EXPECT_NEAR(value(summary, "foot.Mz"), 0.5 * kForce, 1e-5 * kForce);
  // At the foot, of the solid, in its corners more than a beam's.
  const json& largest = summary.at("stress").at(0);
  EXPECT_EQ(largest.at("layer"), "solid");
  EXPECT_GT(largest.at("von_mises").get<double>(), 0.95 * bend(1.0));
  EXPECT_LT(largest.at("place").at(0).get<double>(), 0.1);
  EXPECT_GT(value(summary, "most.max_principal"), 0.95 * bend(1.0));
}

TEST(MixedStress, IsTheSameFromASavedBodyAndInMillimetres) {
  const Workspace place;
  write_deck(place, kDeck, 5008);
  write_scene(place, kForceText, kProbes);
  const json own = answer(place, "static s.toml");
  const auto expect_same = [&](const json& other) {
    for (const auto& [name, column] : own.at("probes").items()) {
      const double expected = column.at("value").get<double>();
      EXPECT_NEAR(
          value(other, name), expected,
          1e-5 * std::abs(expected) + (name.starts_with("foot") ? 1e-3 : 100.0))
          << name;
    }
  };
  const CommandResult made = place.limber(
      "reduce deck.bdf --clamp spc:1 --interface node:5008 --modes 2 --stress "
      "-o b.h5");
  ASSERT_EQ(made.status, 0) << made.errors;
  write_robot(place, "<reduced file='b.h5'/>");
  expect_same(
      answer(place, "static s.toml --set load.pull.interface=node:5008"));

  const std::string millimetres =
      change_cards(kDeck, [](const std::string& card) -> std::string {
        if (card.starts_with("MAT1")) return "MAT1,1,70000.,,0.33,2.7-9\n";
        if (card.starts_with("PBARL")) return "PBARL,9,1,,BAR\n,60.,100.\n";
        if (!card.starts_with("GRID")) return card;
        std::istringstream in(card.substr(5));
        std::vector<std::string> cells;
        for (std::string cell; std::getline(in, cell, ',');)
          cells.push_back(cell);
        return fmt::format("GRID,{},,{:.9g},{:.9g},{:.9g}\n", cells[0],
                           1e3 * std::stod(cells[2]), 1e3 * std::stod(cells[3]),
                           1e3 * std::stod(cells[4]));
      });
  write_deck(place, millimetres, 5008, "mm");
  expect_same(answer(place, "static s.toml"));
}

TEST(MixedStress, IsRecordedInARun) {
  const Workspace place;
  write_deck(place, kDeck, 5008);
  write_scene(place, kForceText, kProbes);
  const CommandResult r = place.limber("run s.toml --cache c --out o --json");
  ASSERT_EQ(r.status, 0) << r.errors;
  const json summary = json::parse(r.out);
  EXPECT_GT(summary.at("stress").at(0).at("von_mises").get<double>(), 0.0);
  const json& probes = summary.at("probes");
  EXPECT_NE(probes.at("solid.sxx").at("peak").get<double>(), 0.0);
  EXPECT_TRUE(probes.at("most.max_principal").contains("peak_layer"));
}

TEST(MixedStress, OfASolidHasNoLayers) {
  const Workspace place;
  write_deck(place, kDeck, 5008);
  write_scene(
      place, kForceText,
      probe_text("a", "stress", "nearest = [0.25, 0.05, 0]\nlayer = 'top'"));
  const CommandResult r = place.limber("static s.toml --cache c --out o");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.errors, HasSubstr("no such layer; expected one of those there: "
                                  "solid"));
}

/// A beam that hangs on a mean of nodes and carries nothing changes nothing, on
/// the surface, of which solids alone keep the nodes.
TEST(MixedStress, IsThatOfTheSolidsAloneBesideABeamWithoutLoad) {
  constexpr int kCorner = 198;
  const std::string hung =
      change_cards(kDeck, [](const std::string& card) -> std::string {
        if (!card.starts_with("RBE2")) return card;
        return "RBE3,800,,5000,123456,1.,123,172\n,173,174,175,177\n";
      });
  const std::string alone =
      change_cards(kDeck, [](const std::string& card) -> std::string {
        for (const char* name : {"GRID,50", "CBAR", "PBARL", "RBE2"})
          if (card.starts_with(name) && !card.starts_with("GRID,50,"))
            return "";
        return card;
      });
  const Workspace place;
  std::string probes;
  for (const char* at : {"0.25, 0.05, 0", "0.25, 0, 0.03", "0.4166, -0.05, 0",
                         "0.5, -0.05, -0.03", "0.25, -0.05, 0.03"})
    probes += probe_text(fmt::format("p{}", probes.size()), "stress",
                         fmt::format("nearest = [{}]", at));
  write_scene(place, "[300, 1000, -500]", probes);
  write_deck(place, hung, kCorner);
  const json beside = answer(place, "static s.toml");
  write_deck(place, alone, kCorner);
  const json solids = answer(place, "static s.toml");
  const json& largest = solids.at("stress").at(0);
  const double scale = largest.at("von_mises").get<double>();
  ASSERT_GT(scale, 1e6);
  for (const auto& [name, column] : solids.at("probes").items())
    EXPECT_NEAR(value(beside, name), column.at("value").get<double>(),
                1e-6 * scale)
        << name;
  EXPECT_NEAR(beside.at("stress").at(0).at("von_mises").get<double>(), scale,
              1e-6 * scale);
  EXPECT_EQ(beside.at("stress").at(0).at("node"), largest.at("node"));
}

// ---- a strip of shells, 0.5 m x 0.1 m x 20 mm, held at x = 0, with a block of
// solids 0.4 m x 0.1 m x 0.1 m at its end on a rigid spider

constexpr int kAlong = 10;

std::string make_strip() {
  std::string text =
      "SOL 101\nBEGIN BULK\nMAT1,1,7.+10,,.3,2700.\n"
      "PSHELL,1,1,.02,1,,1\nPSOLID,2,1\n";
  const auto node = [](int i, int j) { return 1 + i + (kAlong + 1) * j; };
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= kAlong; ++i)
      text += fmt::format("GRID,{},,{:.6f},{:.6f},0.\n", node(i, j),
                          0.5 * i / kAlong, 0.05 * j);
  int number = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < kAlong; ++i)
      text += fmt::format("CQUAD4,{},1,{},{},{},{}\n", ++number, node(i, j),
                          node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
  const auto corner = [](int i, int j, int k) {
    return 101 + i + 9 * (j + 3 * k);
  };
  for (int k = 0; k <= 2; ++k)
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 8; ++i)
        text += fmt::format("GRID,{},,{:.6f},{:.6f},{:.6f}\n", corner(i, j, k),
                            0.5 + 0.05 * i, 0.05 * j, 0.05 * (k - 1));
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 8; ++i)
        text += fmt::format(
            "CHEXA,{},2,{},{},{},{},{},{}\n,{},{}\n", ++number, corner(i, j, k),
            corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k),
            corner(i, j, k + 1), corner(i + 1, j, k + 1),
            corner(i + 1, j + 1, k + 1), corner(i, j + 1, k + 1));
  text += fmt::format("RBE2,900,{},123456,{},{}", node(kAlong, 1),
                      node(kAlong, 0), node(kAlong, 2));
  std::vector<int> face;
  for (int k = 0; k <= 2; ++k)
    for (int j = 0; j <= 2; ++j) face.push_back(corner(0, j, k));
  text +=
      fmt::format(",{},{},{}\n,{},{},{},{},{},{}\n", face[0], face[1], face[2],
                  face[3], face[4], face[5], face[6], face[7], face[8]);
  text += fmt::format("SPC1,1,123456,{},{},{}\nENDDATA\n", node(0, 0),
                      node(0, 1), node(0, 2));
  return text;
}

TEST(MixedStress, OfAStripWithABlockAtItsEndIsThatOfBars) {
  const Workspace place;
  write_deck(place, make_strip(), 101 + 8 + 9 * 4);  // middle of the end
  write_scene(
      place, "[10000, 0, 100]",
      probe_text("top", "stress", "node = 17\nlayer = 'top'") +
          probe_text("bottom", "stress", "node = 17\nlayer = 'bottom'") +
          probe_text("block", "stress", "nearest = [0.7, 0.05, 0.0]") +
          probe_text("faces", "von_mises", "layer = 'bottom'"));
  const json summary = answer(place, "static s.toml");
  const double pull = 10000.0 / (0.1 * 0.02);
  const auto bend = [](double arm) { return 6.0 * 100.0 * arm / (0.1 * 4e-4); };
  EXPECT_NEAR(value(summary, "top.sxx"), pull - bend(0.65), 0.01 * bend(0.65));
  EXPECT_NEAR(value(summary, "bottom.sxx"), pull + bend(0.65),
              0.01 * bend(0.65));
  EXPECT_NEAR(value(summary, "block.sxx"), 10000.0 / (0.1 * 0.1), 2e4);
  EXPECT_GT(value(summary, "faces.von_mises"), bend(0.9));
  EXPECT_EQ(summary.at("stress").at(0).at("layer"), "bottom");
}

}  // namespace
}  // namespace limber::test::mixed_stress_test
