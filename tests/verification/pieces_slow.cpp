// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/reduction/full_body_maker.hpp"
#include "limber/reduction/reduce.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "unit/results/temporary_folder.hpp"

/// A link in pieces against level `full` of the same mesh, and against the link
/// in one piece where it bends little.
namespace limber::pieces_slow {
namespace {

using dynamics::Fidelity;

/// A bar held at its root by a joint that adds 0.01 % to its flexibility.
struct Beam {
  std::string geometry;
  double youngs_modulus = 2e11;  // [Pa]
  double poisson_ratio = 0.3;
  double density = 7800.0;  // [kg/m^3]
  double translational_stiffness = 5e12;
  double rotational_stiffness = 1.05e9;
};

std::string section(double y, double z, int cells) {
  return fmt::format(
      "Point(1) = {{0, {}, {}}};\n"
      "l[] = Extrude {{0, {}, 0}} {{ Point{{1}}; Layers{{{}}}; }};\n"
      "s[] = Extrude {{0, 0, {}}} {{ Line{{l[1]}}; Layers{{1}}; Recombine; "
      "}};\n",
      -0.5 * y, -0.5 * z, y, cells, z);
}

std::string sweep(const std::string& how, int layers) {
  return fmt::format(
      "v[] = Extrude {} {{ Surface{{s[1]}}; Layers{{{}}}; Recombine; }};\n"
      "Physical Surface(\"root\") = {{s[1]}};\n"
      "Physical Surface(\"tip\") = {{v[0]}};\n"
      "Physical Volume(\"body\") = {{v[1]}};\n"
      "Mesh.ElementOrder = 2;\n",
      how, layers);
}

// Of 1 m, 20 times as long as thick.
const Beam kBar{section(0.05, 0.05, 1) + sweep("{1, 0, 0}", 20)};
constexpr double kEI = 2e11 * 0.05 * 0.05 * 0.05 * 0.05 / 12.0;  // [N m^2]
constexpr double kUnit = 3.0 * kEI;  // bends it by 1 m, by linear theory [N]
constexpr double kEuler =
    std::numbers::pi * std::numbers::pi / 4.0 * kEI;  // [N]

// A quarter of a circle in the plane of x and y, 1 m long.
const Beam kArc{
    section(0.05, 0.025, 1) +
        fmt::format("{}", sweep("{{0, 0, 1}, {0, 2 / Pi, 0}, Pi / 2}", 20)),
    2e11,
    0.3,
    7800.0,
    2.5e12,
    4e9};

// Of the Princeton experiment.
const Beam kStrip{section(12.77e-3, 3.2024e-3, 2) + sweep("{0.508, 0, 0}", 40),
                  71.7e9,
                  0.31,
                  2700.0,
                  5.8e10,
                  2.1e7};

class Pieces : public ::testing::Test {
 protected:
  scene::BuiltScene build(const Beam& beam, const Vector3& force, int pieces,
                          Fidelity level) const {
    std::ofstream(folder_.path() / "beam.geo") << beam.geometry;
    std::ofstream(folder_.path() / "robot.urdf") << fmt::format(
        "<robot name='r'><link name='world'/><link name='beam'/>\n"
        "<joint name='clamp' type='fixed'><parent link='world'/>"
        "<child link='beam'/></joint>\n"
        "<coupler joint='clamp' translational_stiffness='{}' "
        "rotational_stiffness='{}'/>\n"
        "<flexible link='beam' pieces='{}'><mesh file='beam.geo'/>\n"
        "<material youngs_modulus='{}' poisson_ratio='{}' density='{}'/>\n"
        "<basis eigenmodes='4'/><attach joint='clamp' interface='root'/>"
        "</flexible></robot>\n",
        beam.translational_stiffness, beam.rotational_stiffness, pieces,
        beam.youngs_modulus, beam.poisson_ratio, beam.density);
    std::ofstream(folder_.path() / "scene.toml") << fmt::format(
        "robot = 'robot.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n"
        "[fidelity]\ndefault = '{}'\n"
        "[[load]]\nname = 'pull'\nlink = 'beam'\ngroup = 'tip'\n"
        "frame = 'world'\nforce = [{}, {}, {}]\n"
        "time = {{ kind = 'constant' }}\n"
        "[[probe]]\nname = 'tip'\nlink = 'beam'\ngroup = 'tip'\n"
        "quantity = 'displacement'\n",
        to_string(level), force.x(), force.y(), force.z());
    return scene::build_system(
        scene::load_scene(folder_.path() / "scene.toml"),
        flexbody::make_reducer(), folder_.path() / "cache",
        [](const flexbody::Recipe& recipe, const flexbody::FullOptions& options,
           const flexbody::ReducedBody& reduced) {
          return flexbody::make_full_body(recipe, options, {}, &reduced);
        });
  }

  /// How far the tip goes under a dead load [m].
  Vector3 bend(const Beam& beam, const Vector3& force, int pieces,
               Fidelity level) const {
    const scene::BuiltScene built = build(beam, force, pieces, level);
    const dynamics::SystemState still =
        dynamics::find_equilibrium(built.model, built.initial).state;
    const std::vector<double> u =
        scene::evaluate_all(built.probes, built.model, still);
    return {u[0], u[1], u[2]};
  }

  /// Error of the tip in two pieces, relative to its way at level `full` [-].
  double find_error(const Beam& beam, const Vector3& force) const {
    const Vector3 exact = bend(beam, force, 1, Fidelity::full);
    const Vector3 found = bend(beam, force, 2, Fidelity::nonlinear);
    const double error = (found - exact).norm() / exact.norm();
    RecordProperty("percent", fmt::format("{:.4f}", 100.0 * error));
    fmt::print("u = ({:.5f}, {:.5f}, {:.5f}) m, error {:.3f} %\n", exact.x(),
               exact.y(), exact.z(), 100.0 * error);
    return error;
  }

  results::test::TemporaryFolder folder_;
};

TEST_F(Pieces, AreAsStiffAsTheWhole) {
  for (const Beam* beam : {&kBar, &kArc, &kStrip}) {
    const Vector3 force(0.0, 0.01, 0.02);
    const Vector3 whole = bend(*beam, force, 1, Fidelity::coupled);
    const auto frequencies = [&](int pieces) {
      const scene::BuiltScene built =
          build(*beam, Vector3::Zero(), pieces, Fidelity::coupled);
      return dynamics::find_natural_frequencies(built.model, built.initial);
    };
    const auto whole_frequencies = frequencies(1);
    for (const int pieces : {2, 3, 4}) {
      const double bound = 0.001 * (pieces - 1);  // of each cut
      const Vector3 cut = bend(*beam, force, pieces, Fidelity::coupled);
      EXPECT_LT((cut - whole).norm(), bound * whole.norm()) << pieces;
      const auto cut_frequencies = frequencies(pieces);
      for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(cut_frequencies[i], whole_frequencies[i],
                    bound * whole_frequencies[i])
            << pieces;
      }
    }
  }
}

TEST_F(Pieces, BendTo20And40And60Percent) {
  EXPECT_LT(find_error(kBar, {0.0, 0.0, 0.2065 * kUnit}), 0.001);
  EXPECT_LT(find_error(kBar, {0.0, 0.0, 0.465 * kUnit}), 0.0015);
  EXPECT_LT(find_error(kBar, {0.0, 0.0, 0.92 * kUnit}), 0.005);
}

TEST_F(Pieces, BendAsThePrincetonBeam) {
  const double part = 13.345 * std::sqrt(0.5);
  EXPECT_LT(find_error(kStrip, {0.0, part, part}), 0.0015);
  EXPECT_LT(find_error(kStrip, {0.0, 0.0, 13.345}), 0.0015);
  // The elastica of the strip's E I, by SciPy's solve_bvp at 1e-8.
  const Vector3 exact(-0.048057, 0.0, 0.196228);
  const Vector3 u = bend(kStrip, {0.0, 0.0, 13.345}, 2, Fidelity::nonlinear);
  EXPECT_LT((u - exact).norm(), 0.0015 * exact.norm());
}

TEST_F(Pieces, BuckleUnderMoreThanEulersLoad) {
  for (const double times : {1.05, 1.2}) {
    EXPECT_LT(find_error(kBar, {-times * kEuler, 0.0, 0.01 * kUnit}), 0.01)
        << times;
  }
}

TEST_F(Pieces, BendAsAnArcInItsPlaneAndOutOfIt) {
  EXPECT_LT(find_error(kArc, {0.0, 0.3 * kUnit / 4.0, 0.0}), 0.003);
  EXPECT_LT(find_error(kArc, {0.0, 0.0, 0.15 * kUnit / 4.0}), 0.003);
}

/// Tip deflection and lowest two frequencies of a bar on the joint.
struct Response {
  double tip = 0.0;     ///< [m]
  double first = 0.0;   ///< [Hz]
  double second = 0.0;  ///< [Hz]
};

class Cuts : public Pieces {
 protected:
  Response find_response(const Beam& beam, int pieces) const {
    const scene::BuiltScene built =
        build(beam, {0.0, 3.0, 1.0}, pieces, Fidelity::coupled);
    const auto found = find_equilibrium(built.model, built.initial).state;
    const std::vector<double> tip =
        scene::evaluate_all(built.probes, built.model, found);
    const VectorX frequencies =
        find_natural_frequencies(built.model, built.initial);
    return {std::hypot(tip.at(1), tip.at(2)), frequencies[0], frequencies[1]};
  }

  void expect_whole(const Beam& beam, int pieces, double allowed) const {
    SCOPED_TRACE(pieces);
    const Response whole = find_response(beam, 1);
    const Response cut = find_response(beam, pieces);
    EXPECT_NEAR(cut.tip / whole.tip, 1.0, allowed);
    EXPECT_NEAR(cut.first / whole.first, 1.0, allowed);
    EXPECT_NEAR(cut.second / whole.second, 1.0, allowed);
  }
};

// Numbers of pieces that do not divide the number of layers, too.
TEST_F(Cuts, OfSweptLayersCostLittleWhateverTheirNumber) {
  const Beam bar{section(0.008, 0.02, 2) + sweep("{0.2, 0, 0}", 6),
                 3e9,
                 0.3,
                 1500.0,
                 1e11,
                 1e8};
  for (const int pieces : {3, 5}) expect_whole(bar, pieces, 0.01);
}

TEST_F(Cuts, OfTetrahedraCostLittleAlthoughTheyAreRagged) {
  const Beam bar{
      "SetFactory(\"OpenCASCADE\"); Box(1)={0,-0.01,-0.01,0.2,0.02,0.02};\n"
      "Physical Volume(\"body\")={1};\n"
      "e()=Surface In BoundingBox{-1e-6,-1,-1,1e-6,1,1};\n"
      "Physical Surface(\"root\")={e()};\n"
      "f()=Surface In BoundingBox{0.2-1e-6,-1,-1,0.2+1e-6,1,1};\n"
      "Physical Surface(\"tip\")={f()};\n"
      "Mesh.ElementOrder=2; Mesh.MeshSizeMax=0.02; Mesh.MeshSizeMin=0.02;\n",
      3e9,
      0.3,
      1500.0,
      1e11,
      1e8};
  for (const int pieces : {2, 3, 4}) expect_whole(bar, pieces, 0.014);
}

}  // namespace
}  // namespace limber::pieces_slow
