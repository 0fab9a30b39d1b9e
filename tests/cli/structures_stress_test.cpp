// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "cli/command.hpp"
#include "cli/stress_answers.hpp"
#include "limber/common/types.hpp"
#include "places.hpp"

/// Stress of decks of beams and shells, by the command.
namespace limber::test::structures_stress_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kFolder = LIMBER_SOURCE_DIR "/tests/data/structures/";

// ---- a tube of 2 m, held at node 1, under 100 N across at node 3

constexpr double kForce = 100.0;
const double kInertia = M_PI / 4.0 * (std::pow(0.05, 4) - std::pow(0.045, 4));

class Boom : public ::testing::Test {
 protected:
  /// Of its deck, or of a saved body.
  void write_robot(const std::string& flexible) {
    place_.write("arm.urdf",
                 "<robot name='arm'><link name='bar'/><flexible link='bar'>" +
                     flexible + "</flexible></robot>\n");
  }
  void write_scene(const std::string& probes, const std::string& output = "") {
    place_.write(
        "s.toml",
        fmt::format("robot = 'arm.urdf'\n[time]\nduration = 0.02\nstep = 1e-3\n"
                    "[output]\npictures = false\n{}\n"
                    "[[load]]\nname = 'pull'\nlink = 'bar'\ninterface = 'end'\n"
                    "force = [0, {}, 0]\nframe = 'world'\n{}",
                    output, kForce, probes));
  }
  void write_boom() {
    write_robot("<mesh file='" + kFolder +
                "boom.bdf'/><clamp group='spc:1'/><basis eigenmodes='2'/>"
                "<interface name='end' node='3'/>");
  }
  void expect_error(const std::string& probe, const std::string& text) {
    write_scene(probe);
    const CommandResult r = place_.limber("static s.toml --cache c --out o");
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_THAT(r.errors, HasSubstr(text));
  }

  Workspace place_;
};

const std::string kProbes =
    probe_text("root", "section_force", "node = 1") +
    probe_text("middle", "section_force", "node = 2\nelement = 2") +
    probe_text("all", "section_force", "") +
    probe_text("mises", "von_mises", "node = 2") +
    probe_text("axial", "stress", "node = 1\naxes = 'layer'") +
    probe_text("shear", "von_mises", "node = 3");

TEST_F(Boom, HasTheSectionForcesAndStressOfACantilever) {
  write_boom();
  write_scene(kProbes, "stress = true");
  const json summary = answer(place_, "static s.toml");
  EXPECT_NEAR(value(summary, "root.Mz"), 2.0 * kForce, 1e-6 * kForce);
  EXPECT_NEAR(value(summary, "root.Vy"), kForce, 1e-6 * kForce);
  EXPECT_NEAR(value(summary, "root.N"), 0.0, 1e-6 * kForce);
  EXPECT_NEAR(value(summary, "middle.Mz"), kForce, 1e-6 * kForce);
  EXPECT_NEAR(value(summary, "all.Mz"), 2.0 * kForce, 1e-6 * kForce);
  const double bend = kForce * 0.05 / kInertia;  // a metre from the end
  EXPECT_NEAR(value(summary, "mises.von_mises"), bend, 1e-6 * bend);
  EXPECT_NEAR(std::abs(value(summary, "axial.s11")), 2.0 * bend, 2e-6 * bend);
  // At the end, without moment, V (a^2 + a b + b^2) / (3 I).
  const double shear =
      kForce * (0.05 * 0.05 + 0.05 * 0.045 + 0.045 * 0.045) / (3.0 * kInertia);
  EXPECT_NEAR(value(summary, "shear.von_mises"), std::sqrt(3.0) * shear,
              1e-6 * bend);
  const json& largest = summary.at("stress").at(0);
  EXPECT_NEAR(largest.at("von_mises").get<double>(), 2.0 * bend, 2e-6 * bend);
  EXPECT_EQ(largest.at("node"), 1);
  EXPECT_THAT(largest.at("layer").get<std::string>(), HasSubstr("outline"));
  EXPECT_TRUE(largest.at("averaging_error").is_null());
}

TEST_F(Boom, HasTheSameFromASavedBody) {
  write_boom();
  write_scene(kProbes, "stress = true");
  const json own = answer(place_, "static s.toml");
  const CommandResult made = place_.limber(
      "reduce " + kFolder +
      "boom.bdf --clamp spc:1 --interface node:3 --modes 2 --stress -o "
      "b.h5");
  ASSERT_EQ(made.status, 0) << made.errors;
  write_robot("<reduced file='b.h5'/>");
  const json saved =
      answer(place_, "static s.toml --set load.pull.interface=node:3");
  for (const auto& [name, column] : own.at("probes").items()) {
    const double expected = column.at("value").get<double>();
    EXPECT_NEAR(value(saved, name), expected,
                1e-6 * std::abs(expected) + 1e-4 * kForce)
        << name;
  }
  ASSERT_EQ(place_.limber("info b.h5").status, 0);
}

TEST_F(Boom, RunsWithStress) {
  write_boom();
  write_scene(kProbes, "stress = true");
  const CommandResult r = place_.limber("run s.toml --cache c --out o --json");
  ASSERT_EQ(r.status, 0) << r.errors;
  const json summary = json::parse(r.out);
  EXPECT_GT(summary.at("stress").at(0).at("von_mises").get<double>(), 0.0);
  EXPECT_EQ(summary.at("probes").at("axial.s11").at("peak_node"), 1);
  EXPECT_TRUE(summary.at("probes").at("axial.s11").contains("peak_layer"));
}

TEST_F(Boom, RefusesWhatItDoesNotHave) {
  write_boom();
  expect_error(probe_text("a", "section_force", "node = 1\nelement = 2"),
               "beam 2 does not end there; expected one of 1");
  expect_error(probe_text("a", "von_mises", "node = 1\nlayer = 'top'"),
               "it has no such layer");
  expect_error(probe_text("a", "tsai_wu", "node = 1"), "no strengths");
  expect_error(probe_text("a", "von_mises", "node = 4"),
               "no shell, and no beam");
  expect_error(probe_text("a", "von_mises", "node = 1\naxes = 'layer'"),
               "probe 1.axes: is for the components");
  expect_error(probe_text("a", "section_force", "node = 1\nply = 1"),
               "not for section forces");
}

TEST_F(Boom, WithoutDimensionsHasSectionForcesAlone) {
  std::string deck = read_text(kFolder + "boom.bdf");
  const std::string tube = "PBARL,1,1,,TUBE\n,.05,.045\n";
  deck.replace(deck.find(tube), tube.size(),
               "PBAR,1,1,1.4923E-3,1.6881E-6,1.6881E-6,3.3763E-6\n");
  place_.write("bar.bdf", deck);
  write_robot(
      "<mesh file='bar.bdf'/><clamp group='spc:1'/><basis eigenmodes='2'/>"
      "<interface name='end' node='3'/>");
  write_scene(probe_text("root", "section_force", "node = 1") +
              probe_text("all", "section_force", ""));
  const json summary = answer(place_, "static s.toml");
  EXPECT_NEAR(value(summary, "root.Mz"), 2.0 * kForce, 1e-6 * kForce);
  expect_error(probe_text("a", "von_mises", "node = 1"),
               "no shell, and no beam");
  expect_error(probe_text("a", "von_mises", ""),
               "2 of its beams have a section without dimensions");
}

// ---- a strip of plies 0, 90 and 0 degrees, 1 m x 0.1 m, held at x = 0, under
// 10 N along z at its end

constexpr int kAlong = 20;
constexpr int kAcross = 2;

int node_at(int i, int j) { return 1 + i + (kAlong + 1) * j; }

struct StripDeck {
  double length = 1.0;     ///< units of length per metre
  double turn = 0.0;       ///< of the fibres [degrees]
  double outer = 1.0;      ///< thickness of outer plies [mm]
  bool is_turned = false;  ///< order of nodes
};

void write_strip(const Workspace& place, const StripDeck& deck) {
  const double l = deck.length;
  const double area = l * l;
  const auto pa = [&](double value) { return value / area; };
  std::string text = "SOL 101\nBEGIN BULK\n";
  for (int j = 0; j <= kAcross; ++j)
    for (int i = 0; i <= kAlong; ++i)
      text += fmt::format("GRID,{},,{:.9f},{:.9f},0.\n", node_at(i, j),
                          l * i / kAlong, 0.1 * l * j / kAcross);
  int number = 0;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAlong; ++i) {
      const int a = node_at(i, j);
      const int b = node_at(i + 1, j);
      const int c = node_at(i + 1, j + 1);
      const int d = node_at(i, j + 1);
      text += deck.is_turned ? fmt::format("CQUAD4,{},1,{},{},{},{},0\n",
                                           ++number, a, d, c, b)
                             : fmt::format("CQUAD4,{},1,{},{},{},{},0\n",
                                           ++number, a, b, c, d);
    }
  // N, the unit of length, s: masses in N s^2 per length.
  text += fmt::format(
      "MAT8,1,{:.8e},{:.8e},.3,{:.8e},{:.8e},{:.8e},{:.8e}\n"
      ",,,,{:.8e},{:.8e},{:.8e},{:.8e},{:.8e}\n",
      pa(140e9), pa(10e9), pa(5e9), pa(5e9), pa(3e9), 1600.0 / area / area,
      pa(1500e6), pa(1200e6), pa(50e6), pa(250e6), pa(70e6));
  text +=
      fmt::format("PCOMP,1\n,1,{0:.6e},{1},,1,{2:.6e},{3},\n,1,{0:.6e},{1}\n",
                  deck.outer * 1e-3 * l, deck.turn, 2e-3 * l, 90.0 + deck.turn);
  text += fmt::format("SPC1,1,123456,{},{},{}\nENDDATA\n", node_at(0, 0),
                      node_at(0, 1), node_at(0, 2));
  place.write("strip.bdf", text);
}

void write_strip_scene(const Workspace& place, const std::string& mesh,
                       const std::string& probes) {
  place.write(
      "arm.urdf",
      fmt::format("<robot name='arm'><link name='bar'/><flexible link='bar'>"
                  "<mesh file='strip.bdf' {}/><clamp group='spc:1'/>"
                  "<basis eigenmodes='2'/><interface name='end' node='{}'/>"
                  "</flexible></robot>\n",
                  mesh, node_at(kAlong, 1)));
  place.write("s.toml",
              fmt::format("robot = 'arm.urdf'\n[time]\nduration = 1.0\nstep = "
                          "0.01\n[output]\npictures = false\nstress = true\n"
                          "[[load]]\nname = 'pull'\nlink = 'bar'\ninterface = "
                          "'end'\nforce = [0, 0, 10]\nframe = 'world'\n{}",
                          probes));
}

std::string at_middle(const std::string& more) {
  return fmt::format("node = {}\n{}", node_at(kAlong / 2, 1), more);
}

const std::string kPlies =
    probe_text("top", "stress", at_middle("layer = 'top'\naxes = 'layer'")) +
    probe_text("ply2", "stress",
               at_middle("ply = 2\nlayer = 'top'\naxes = 'layer'")) +
    probe_text("bottom", "stress",
               at_middle("layer = 'bottom'\naxes = 'layer'")) +
    probe_text("link", "stress", at_middle("ply = 2\nlayer = 'top'")) +
    probe_text("wu", "tsai_wu", at_middle("")) +
    probe_text("most", "maximum_stress", at_middle("layer = 'top'"));

/// Stress [11, 22] along the strip at the height z under the moment of the
/// force half-way: classical laminate theory, no moment across.
Eigen::Vector2d find_stress_at(double z, bool is_inner) {
  const double d = 1.0 - 0.09 * 10.0 / 140.0;
  Eigen::Matrix2d outer;
  outer << 140e9 / d, 3e9 / d, 3e9 / d, 10e9 / d;
  Eigen::Matrix2d inner;
  inner << 10e9 / d, 3e9 / d, 3e9 / d, 140e9 / d;
  const double t = 0.002;
  const double h = 0.001;
  const Eigen::Matrix2d D = 2.0 / 3.0 * (t * t * t - h * h * h) * outer +
                            2.0 / 3.0 * h * h * h * inner;
  // Lifted: the top is compressed, z k with k = -w''.
  const Eigen::Vector2d k = D.inverse() * Eigen::Vector2d(-10.0 * 0.5 / 0.1, 0);
  return z * (is_inner ? inner : outer) * k;
}

TEST(Strip, HasTheStressOfClassicalLaminateTheory) {
  const Workspace place;
  write_strip(place, {});
  write_strip_scene(place, "", kPlies);
  const json summary = answer(place, "static s.toml");
  const Eigen::Vector2d top = find_stress_at(0.002, false);
  EXPECT_NEAR(value(summary, "top.s11"), top[0], 0.01 * std::abs(top[0]));
  EXPECT_NEAR(value(summary, "bottom.s11"), -top[0], 0.01 * std::abs(top[0]));
  const Eigen::Vector2d inner = find_stress_at(0.001, true);
  EXPECT_NEAR(value(summary, "ply2.s22"), inner[0],
              0.01 * std::abs(inner[0]));  // across its fibres
  EXPECT_NEAR(value(summary, "link.sxx"), inner[0], 0.01 * std::abs(inner[0]));
  EXPECT_NEAR(value(summary, "most.maximum_stress"), -top[0] / 1200e6,
              0.02 * -top[0] / 1200e6);
  const double s1 = value(summary, "bottom.s11");
  const double s2 = value(summary, "bottom.s22");
  const double s12 = value(summary, "bottom.s12");
  const double bottom = s1 * (1 / 1500e6 - 1 / 1200e6) +
                        s1 * s1 / (1500e6 * 1200e6) +
                        s2 * (1 / 50e6 - 1 / 250e6) + s2 * s2 / (50e6 * 250e6) +
                        s12 * s12 / (70e6 * 70e6);
  EXPECT_GE(value(summary, "wu.tsai_wu"), bottom - 1e-9);
}

TEST(Strip, HasTheSameInMillimetresAndTurned) {
  const Workspace place;
  write_strip(place, {});
  write_strip_scene(place, "", kPlies);
  const json metres = answer(place, "static s.toml");
  write_strip(place, {.length = 1000.0});
  write_strip_scene(place, "unit='mm'", kPlies);
  const json millimetres = answer(place, "static s.toml");
  for (const auto& [name, column] : metres.at("probes").items()) {
    const double expected = column.at("value").get<double>();
    EXPECT_NEAR(value(millimetres, name), expected,
                1e-5 * std::abs(expected) + 10.0 * (name[0] != 'w'))
        << name;
  }
  // Nodes the other way round: top is below.
  write_strip(place, {.is_turned = true});
  write_strip_scene(place, "", kPlies);
  const json turned = answer(place, "static s.toml");
  EXPECT_NEAR(value(turned, "top.s11"), value(metres, "bottom.s11"),
              1e-3 * std::abs(value(metres, "top.s11")));
}

TEST(Strip, ChangesWithAnglesAndThickness) {
  const Workspace place;
  write_strip(place, {});
  write_strip_scene(place, "", kPlies);
  const double base = value(answer(place, "static s.toml"), "top.s11");
  write_strip(place, {.turn = 20.0});
  EXPECT_LT(std::abs(value(answer(place, "static s.toml"), "top.s11")),
            0.97 * std::abs(base));
  write_strip(place, {.outer = 1.5});
  EXPECT_LT(std::abs(value(answer(place, "static s.toml"), "top.s11")),
            0.8 * std::abs(base));
}

TEST(Strip, RefusesPliesThatItDoesNotHave) {
  const Workspace place;
  write_strip(place, {});
  write_strip_scene(place, "", probe_text("a", "stress", at_middle("ply = 4")));
  const CommandResult none = place.limber("static s.toml --cache c --out o");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.errors, HasSubstr("expected one of those there: ply 1 "
                                     "bottom, ply 1 top, ply 2 bottom"));
}

/// [0/90] of triangles under 1 kN of tension at its end: classical laminate
/// theory, [e; k] = [A B; B D]^-1 [N; 0].
TEST(Strip, OfTrianglesOfACoupledLaminateCurvesUnderTension) {
  const Workspace place;
  std::string text =
      "BEGIN BULK\nCORD2R,7,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
      "MAT8,1,1.4+11,1.+10,.3,5.+9,5.+9,3.+9,1600.\n"
      "PCOMP,1\n,1,.002,0.,,1,.002,90.\n";
  for (int j = 0; j <= kAcross; ++j)
    for (int i = 0; i <= kAlong; ++i)
      text += fmt::format("GRID,{},,{:.6f},{:.6f},0.\n", node_at(i, j),
                          1.0 * i / kAlong, 0.05 * j);
  int number = 0;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAlong; ++i)
      for (const auto& [b, c] :
           {std::pair{node_at(i + 1, j), node_at(i + 1, j + 1)},
            {node_at(i + 1, j + 1), node_at(i, j + 1)}})
        text += fmt::format("CTRIA3,{},1,{},{},{},7\n", ++number, node_at(i, j),
                            b, c);
  text += fmt::format("SPC1,1,123456,{},{},{}\nENDDATA\n", node_at(0, 0),
                      node_at(0, 1), node_at(0, 2));
  place.write("strip.bdf", text);
  write_strip_scene(place, "",
                    "[[probe]]\nname = 'w'\nlink = 'bar'\nquantity = "
                    "'displacement'\ninterface = 'end'\n" +
                        probe_text("low", "stress",
                                   at_middle("ply = 1\nlayer = 'bottom'\n"
                                             "axes = 'layer'")));
  const json summary =
      answer(place, "static s.toml --set load.pull.force=[1000,0,0]");
  const double d = 1.0 - 0.09 / 14.0;
  Matrix3 Q0 = Matrix3::Zero();
  Q0 << 140e9 / d, 3e9 / d, 0, 3e9 / d, 10e9 / d, 0, 0, 0, 5e9;
  Matrix3 Q9 = Q0;
  std::swap(Q9(0, 0), Q9(1, 1));
  const double t = 0.002;
  Matrix6 ABD;
  ABD << t * (Q0 + Q9), 0.5 * t * t * (Q9 - Q0), 0.5 * t * t * (Q9 - Q0),
      t * t * t / 3.0 * (Q0 + Q9);
  const Vector6 strain = ABD.inverse() * (1000.0 / 0.1 * Vector6::Unit(0));
  EXPECT_NEAR(value(summary, "w.uz"), -0.5 * strain[3],
              2e-3 * std::abs(0.5 * strain[3]));
  const Vector3 low = Q0 * (strain.head<3>() - t * strain.tail<3>());
  EXPECT_NEAR(value(summary, "low.s11"), low[0], 2e-3 * std::abs(low[0]));
  EXPECT_NEAR(value(summary, "low.s22"), low[1], 2e-3 * std::abs(low[0]));
}

}  // namespace
}  // namespace limber::test::structures_stress_test
