// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/stress_answers.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/types.hpp"

/// Stress of probes and of `[output] stress`: a steel bar of bricks along x,
/// 1 m x 0.1 m x 0.05 m, held at x = 0.
namespace limber::test::stress_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kLength = 1.0;
constexpr double kForce = 1000.0;
constexpr double kHalf = 0.025;
constexpr double kInertia = 0.1 * 0.05 * 0.05 * 0.05 / 12.0;
constexpr int kBadInput = 2;

struct BarText {
  std::string origin = "<origin xyz='0 0 0'/>";
  std::string rows = "boundary";
  std::string load = "force = [0.0, 0.0, 1000.0]\nframe = 'body'\n";
  std::string time = "time = { kind = 'constant' }\n";
  std::string more;  // of the scenario
  std::string output = "stress = true";
  double interval = 0.001;  // between outputs
};

void write_mesh(const Workspace& place) {
  place.write("bar.geo",
              "Point(1) = {0, 0, 0};\n"
              "l[] = Extrude {0, 0.1, 0} { Point{1}; Layers{1}; };\n"
              "s[] = Extrude {0, 0, 0.05} { Line{l[1]}; Layers{1}; "
              "Recombine; };\n"
              "v[] = Extrude {1, 0, 0} { Surface{s[1]}; Layers{12}; "
              "Recombine; };\n"
              "Physical Surface(\"root\") = {s[1]};\n"
              "Physical Surface(\"tip\") = {v[0]};\n"
              "Physical Volume(\"bar\") = {v[1]};\n");
}

void write_bar(const Workspace& place, const BarText& text) {
  write_mesh(place);
  place.write(
      "bar.urdf",
      fmt::format(
          "<robot name='bar'><link name='bar'/><flexible link='bar'>"
          "<mesh file='bar.geo' order='2'/>{}<material youngs_modulus='200e9' "
          "poisson_ratio='0.3' density='8000'/><clamp group='root'/>"
          "<basis eigenmodes='6' rows='{}'/></flexible></robot>\n",
          text.origin, text.rows));
  place.write(
      "s.toml",
      fmt::format("robot = 'bar.urdf'\n[time]\nduration = 0.02\nstep = 1e-4\n"
                  "output_interval = {}\n[output]\npictures = false\n{}\n"
                  "[[load]]\nname = 'tip'\nlink = 'bar'\ngroup = 'tip'\n{}{}{}",
                  text.interval, text.output, text.load, text.time, text.more));
}

/// Beam theory at the upper side: the load bends towards +z.
double bend_at(double x) { return -kForce * (kLength - x) * kHalf / kInertia; }

TEST(Stress, OfACantileverIsThatOfBeamTheory) {
  const Workspace place;
  BarText text;
  const std::string where = "nearest = [0.5, 0.05, 0.05]";
  text.more = probe_text("a", "stress", where) +
              probe_text("b", "von_mises", where) +
              probe_text("c", "max_principal", "nearest = [0.5, 0.05, 0.0]") +
              probe_text("all", "von_mises", "") +
              probe_text("tip", "von_mises", "group = 'tip'");
  write_bar(place, text);
  const json summary = answer(place, "static s.toml");
  const double bend = bend_at(0.5);
  EXPECT_NEAR(value(summary, "a.sxx"), bend, 0.01 * -bend);
  for (const char* other : {"a.syy", "a.szz", "a.sxy", "a.syz", "a.sxz"}) {
    EXPECT_NEAR(value(summary, other), 0.0, 0.02 * -bend) << other;
  }
  EXPECT_NEAR(value(summary, "b.von_mises"), -bend, 0.01 * -bend);
  EXPECT_NEAR(value(summary, "c.max_principal"), -bend, 0.01 * -bend);
  EXPECT_LT(value(summary, "tip.von_mises"), 0.1 * -bend);
  const json& largest = summary.at("stress").at(0);
  EXPECT_EQ(largest.at("link"), "bar");
  EXPECT_EQ(largest.at("von_mises"), value(summary, "all.von_mises"));
  EXPECT_EQ(largest.at("von_mises"), value(summary, "bar.surface.von_mises"));
  // By the clamp: within a thickness of it, where Poisson's effect is held,
  // von Mises stress differs from the beam's.
  EXPECT_GT(largest.at("von_mises").get<double>(), -0.9 * bend_at(0.0));
  EXPECT_LT(largest.at("von_mises").get<double>(), -2.0 * bend_at(0.0));
  EXPECT_LT(largest.at("place").at(0).get<double>(), 0.1);
  EXPECT_LT(largest.at("averaging_error").get<double>(), 0.2);
}

// The mesh's x is the link's y: rotated by 90 degrees about z.
TEST(Stress, IsInTheAxesOfTheLink) {
  const Workspace place;
  BarText text;
  text.origin = "<origin xyz='0 0 0' rpy='0 0 1.5707963267948966'/>";
  text.more = probe_text("a", "stress", "nearest = [0.5, 0.05, 0.05]");
  write_bar(place, text);
  const json summary = answer(place, "static s.toml");
  const double bend = bend_at(0.5);
  EXPECT_NEAR(value(summary, "a.syy"), bend, 0.01 * -bend);
  EXPECT_NEAR(value(summary, "a.sxx"), 0.0, 0.02 * -bend);
  const json& at = summary.at("stress").at(0).at("place");
  EXPECT_LT(at.at(1).get<double>(), 0.1);   // by the root
  EXPECT_LT(at.at(0).get<double>(), 1e-9);  // the mesh's y is -x
}

// Cauchy's stress of the whole mesh. A load too small to bend it far gives that
// of small strain, whose static-deformation mode of the load has all of it.
TEST(Stress, OfTheWholeMeshIsThatOfItsModesForASmallLoad) {
  json reduced;
  for (const char* level : {"coupled", "full"}) {
    const Workspace place;
    BarText text;
    text.load = "force = [0.0, 0.0, 1.0]\nframe = 'body'\n";
    text.more = probe_text("a", "stress", "nearest = [0.5, 0.05, 0.05]") +
                probe_text("p", "max_principal", "nearest = [0.5, 0.05, 0.0]") +
                probe_text("tip", "von_mises", "group = 'tip'");
    write_bar(place, text);
    const json summary =
        answer(place, std::string("static s.toml --fidelity ") + level);
    const json& largest = summary.at("stress").at(0);
    if (reduced.is_null()) {
      reduced = summary;
      EXPECT_GT(largest.at("correction_share").get<double>(), 0.001);
      EXPECT_LT(largest.at("correction_share").get<double>(), 1.0);
      continue;
    }
    const double most = largest.at("von_mises").get<double>();
    for (const char* column : {"a.sxx", "a.syy", "a.szz", "a.sxy", "a.syz",
                               "a.sxz", "p.max_principal", "tip.von_mises"}) {
      EXPECT_NEAR(value(summary, column), value(reduced, column), 1e-4 * most)
          << column;
    }
    const json& before = reduced.at("stress").at(0);
    EXPECT_NEAR(most / before.at("von_mises").get<double>(), 1.0, 1e-4);
    EXPECT_EQ(largest.at("node"), before.at("node"));
    EXPECT_TRUE(largest.at("averaging_error").is_null());
    EXPECT_TRUE(largest.at("correction_share").is_null());
  }
}

/// Index of the node nearest to a point, of positions as columns.
Eigen::Index find_nearest(const MatrixX& x, const Vector3& point) {
  Eigen::Index nearest = 0;
  (x.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

// At level full it has shapes of its own, from which pages and ParaView have
// it.
TEST(Stress, OfTheWholeMeshIsInResultsAndExportsAsBeamTheorySays) {
  const Workspace place;
  write_bar(place, {});
  answer(place, "static s.toml --fidelity full");
  const double bend = bend_at(0.5);
  const auto results = Hdf5File::open(place.folder() / "o/results.h5");
  const std::string at = "scene/bodies/bar/";
  const MatrixX x_B = results.read_matrix("scene/surfaces/0000/x_B");
  const VectorX stress =
      results.read_matrix(at + "Sigma_B") *
      results.read_matrix(at + "zeta").bottomRows<1>().transpose();
  ASSERT_EQ(stress.size(), 6 * x_B.cols());
  // In the middle of the upper side, from the centre of mass.
  const Eigen::Index node = find_nearest(x_B, {0.0, 0.0, kHalf});
  EXPECT_NEAR(stress[6 * node], bend, 0.01 * -bend);
  for (Eigen::Index c = 1; c < 6; ++c) {
    EXPECT_NEAR(stress[6 * node + c], 0.0, 0.02 * -bend) << c;
  }
  EXPECT_LT(results.read_matrix(at + "stress_truncation")(0, 0), 1e-4 * -bend);

  const CommandResult made = place.limber("export o -o m.xdmf");
  ASSERT_EQ(made.status, 0) << made.errors;
  const auto motion = Hdf5File::open(place.folder() / "m.h5");
  const MatrixX points = motion.read_matrix("steps/000000/points").transpose();
  const MatrixX exported = motion.read_matrix("steps/000000/stress");
  const Eigen::Index same = find_nearest(points, {0.5, 0.05, 2.0 * kHalf});
  EXPECT_NEAR(exported(same, 0), bend, 0.01 * -bend);
}

// A load that begins at once makes twice its static stress at most, in a bar
// of one mode; the peak is that of all steps.
TEST(Stress, PeaksAreThoseOfAllStepsWithTheirNode) {
  json first;
  for (const double interval : {0.0005, 0.01}) {
    const Workspace place;
    BarText text;
    text.interval = interval;
    text.more = probe_text("top", "von_mises", "nearest = [0.5, 0.05, 0.05]") +
                probe_text("tip", "von_mises", "group = 'tip'");
    write_bar(place, text);
    const json summary = answer(place, "run s.toml");
    const json& peak = summary.at("stress").at(0);
    if (first.is_null()) first = summary;
    const json& before = first.at("stress").at(0);
    EXPECT_NEAR(peak.at("von_mises").get<double>() /
                    before.at("von_mises").get<double>(),
                1.0, 1e-6);
    EXPECT_EQ(peak.at("node"), before.at("node"));
    EXPECT_NEAR(peak.at("time").get<double>(), before.at("time").get<double>(),
                1e-6);
    const json& column = summary.at("probes").at("bar.surface.von_mises");
    EXPECT_EQ(column.at("peak"), peak.at("von_mises"));
    EXPECT_EQ(column.at("peak_node"), peak.at("node"));
    EXPECT_FALSE(
        summary.at("probes").at("top.von_mises").contains("peak_node"));
    EXPECT_TRUE(summary.at("probes").at("tip.von_mises").contains("peak_node"));
    // Of the middle: twice the static one, and some of higher modes.
    const double top =
        summary.at("probes").at("top.von_mises").at("peak").get<double>();
    EXPECT_GT(top, 1.6 * -bend_at(0.5));
    EXPECT_LT(top, 2.6 * -bend_at(0.5));
    EXPECT_GE(peak.at("von_mises").get<double>(), top);
  }
}

TEST(Stress, IsInTheTextOfARun) {
  const Workspace place;
  write_bar(place, {});
  const CommandResult r = place.limber("run s.toml --cache c --out o");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(r.out, HasSubstr("von Mises stress"));
  EXPECT_THAT(r.out, HasSubstr("averaging"));
}

// rho w^2 L^2 / 2 in the middle of a rod of half-length L.
TEST(Stress, OfASpunRodIsTheClosedForm) {
  const Workspace place;
  write_mesh(place);
  const CommandResult r = place.limber(
      "operate bar.geo --order 2 --youngs-modulus 200e9 --poisson-ratio 0 "
      "--density 8000 --state spinning --axis 0 0 1 --through 0.5 0.05 0.025 "
      "--speed 10 --json");
  ASSERT_EQ(r.status, 0) << r.errors;
  const json stress = json::parse(r.out).at("stress");
  EXPECT_NEAR(stress.at("von_mises").get<double>(), 8000.0 * 100.0 * 0.25 / 2.0,
              0.03 * 1e5);
  EXPECT_NEAR(stress.at("place").at(0).get<double>(), 0.5, 1e-6);
}

TEST(Stress, OfASavedBodyNeedsItsStressModes) {
  const Workspace place;
  BarText text;
  text.output = "";
  text.more = probe_text("a", "stress", "nearest = [0.5, 0.05, 0.05]") +
              probe_text("t", "von_mises", "group = 'tip'");
  write_bar(place, text);
  const json direct = answer(place, "static s.toml");
  place.write("bar.urdf",
              "<robot name='bar'><link name='bar'/><flexible link='bar'>"
              "<reduced file='bar.h5'/><clamp group='root'/></flexible>"
              "</robot>\n");
  place.write("s.toml", [&] {
    std::string scenario = read_text(place.folder() / "s.toml");
    for (std::size_t i;
         (i = scenario.find("group = 'tip'")) != std::string::npos;) {
      scenario.replace(i, 13, "interface = 'tip'");
    }
    return scenario;
  }());
  const std::string reduce =
      "reduce bar.geo --order 2 --youngs-modulus 200e9 --poisson-ratio 0.3 "
      "--density 8000 --clamp root --interface tip --modes 6 -o bar.h5";
  ASSERT_EQ(place.limber(reduce).status, 0);
  const CommandResult without = place.limber("static s.toml --out p");
  EXPECT_EQ(without.status, kBadInput);
  EXPECT_THAT(without.errors, HasSubstr("limber reduce --stress"));
  const CommandResult made = place.limber(reduce + " --stress");
  ASSERT_EQ(made.status, 0) << made.errors;
  const json saved = answer(place, "static s.toml");
  for (const char* column : {"a.sxx", "t.von_mises"}) {
    EXPECT_NEAR(value(saved, column) / value(direct, column), 1.0, 1e-3);
  }
}

struct Refusal {
  std::string name;
  BarText text;
  std::string words;
};

void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.name;
}

class StressIsRefused : public ::testing::TestWithParam<Refusal> {};

TEST_P(StressIsRefused, InOneClearError) {
  const Workspace place;
  write_bar(place, GetParam().text);
  const CommandResult r = place.limber("run s.toml --cache c --out o");
  EXPECT_EQ(r.status, kBadInput) << r.out;
  EXPECT_THAT(r.errors, HasSubstr(GetParam().words));
}

Refusal refuse_probe(const std::string& name, const std::string& more,
                     const std::string& words) {
  BarText text;
  text.output = "";
  text.more = more;
  return {name, text, words};
}

Refusal refuse_rows() {
  BarText text;
  text.rows = "interfaces";
  return {"rows", text, "rows=\"boundary\""};
}

const std::string kMid = "nearest = [0.5, 0.05, 0.05]";

INSTANTIATE_TEST_SUITE_P(
    Inputs, StressIsRefused,
    ::testing::Values(
        refuse_probe("misspelt", probe_text("a", "von_misses", kMid),
                     "von_mises"),
        refuse_probe("relative",
                     probe_text("a", "stress",
                                kMid + "\nrelative_to = { link = "
                                       "'bar', group = 'tip' }"),
                     "relative_to"),
        refuse_probe("distribution",
                     probe_text("a", "stress",
                                "group = 'tip'\ndistribution = 'equal'"),
                     "distribution"),
        refuse_probe("node", probe_text("a", "stress", "node = 123456"),
                     "123456"),
        refuse_probe("group", probe_text("a", "stress", "group = 'tipp'"),
                     "tip"),
        refuse_probe("point", probe_text("a", "stress", "point = [0.5, 0, 0]"),
                     "nearest"),
        refuse_probe("rigid",
                     probe_text("a", "von_mises", kMid) +
                         "[fidelity]\ndefault = 'rigid'\n",
                     "a rigid link has no stress"),
        refuse_rows()),
    [](const auto& one) { return one.param.name; });

// Levels of the command line are for comparing: what they lack is left out, and
// told.
TEST(Stress, OfLinksThatAreMadeRigidIsLeftOutWithAWarning) {
  const Workspace place;
  BarText text;
  text.more = probe_text("a", "von_mises", kMid);
  write_bar(place, text);
  const CommandResult r =
      place.limber("run s.toml --cache c --out o --fidelity rigid");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("[output] stress of link 'bar' changes "
                                  "nothing: it is rigid in this run"));
  EXPECT_THAT(r.errors, HasSubstr("probe 'a' of stress is left out"));
}

TEST(Stress, IsComparedBetweenLevelsThatHaveIt) {
  const Workspace place;
  BarText text;
  text.more = probe_text("a", "von_mises", kMid);
  write_bar(place, text);
  const std::string compare = "compare s.toml --cache c --fidelity coupled,";
  const CommandResult both = place.limber(compare + "uncoupled --out b --json");
  ASSERT_EQ(both.status, 0) << both.errors;
  EXPECT_THAT(both.out, HasSubstr("a.von_mises"));
  const CommandResult rigid = place.limber(compare + "rigid --out r --json");
  ASSERT_EQ(rigid.status, 0) << rigid.errors;
  EXPECT_THAT(rigid.errors, HasSubstr("stress is not compared"));
  EXPECT_EQ(rigid.out.find("a.von_mises"), std::string::npos);
}

}  // namespace
}  // namespace limber::test::stress_test
