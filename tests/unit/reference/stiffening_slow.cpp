// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "limber/reference/stiffening.hpp"
#include "limber/reference/verification.hpp"
#include "places.hpp"
#include "unit/reference/scene_folder.hpp"

/// As stiffness grows, joints converge to Simbody's mobilizers at first order.
namespace limber::reference::stiffening_slow {
namespace {

using test::make_joint;
using test::make_link;
using test::RigidScene;

const std::vector<double> kFactors = {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7};

struct Kind {
  const char* mobilizer;  ///< Simbody's name
  const char* type;       ///< URDF's
  const char* coupler;    ///< attributes of <coupler>
  const char* start;      ///< of the first joint
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.mobilizer; }

/// A link that tumbles freely with two more in a row on joints of a kind.
/// Vibration of the joints is gone by the first output.
std::string make_robot(const Kind& kind) {
  std::string text = "<robot name=\"chain\">" + make_link("base", 3.0) +
                     make_link("a", 1.0) + make_link("b", 1.0);
  text += make_joint("ja", kind.type, "base", "a", "0.3 1 0.2");
  text += make_joint("jb", kind.type, "a", "b", "1 0.2 -0.4");
  for (const char* joint : {"ja", "jb"}) {
    text += fmt::format(
        R"(<coupler joint="{}" {} translational_stiffness="1e5"
           rotational_stiffness="1e4" translational_damping="600"
           rotational_damping="50"/>)",
        joint, kind.coupler);
  }
  return text + "</robot>";
}

std::string make_scenario(const Kind& kind) {
  return fmt::format(
      "[time]\nduration = 0.3\nstep = 2e-5\noutput_interval = 0.1\n"
      "[gravity]\nacceleration = [0.0, 0.0, -9.81]\n"
      "[initial.base]\nvelocity = [0.2, -0.1, 0.3]\n"
      "angular_velocity = [1.0, -2.0, 1.5]\n"
      "[initial.joints]\nja = {}\n",
      kind.start);
}

StiffnessTrend find_trend_of(const std::vector<double>& differences) {
  const auto count = static_cast<std::ptrdiff_t>(differences.size());
  return find_trend({kFactors.begin(), kFactors.begin() + count}, differences);
}

void expect_first_order(const std::vector<Verification>& results) {
  for (const auto quantity :
       {&Magnitudes::position, &Magnitudes::rotation, &Magnitudes::velocity,
        &Magnitudes::angular_velocity}) {
    std::vector<double> differences;
    for (const Verification& result : results) {
      differences.push_back(result.runs.back().largest.*quantity);
    }
    const StiffnessTrend trend = find_trend_of(differences);
    // Past the first, whose strain is not small, and before round-off.
    EXPECT_NEAR(trend.orders[1], 1.0, 0.05);
    EXPECT_NEAR(trend.orders[2], 1.0, 0.05);
    EXPECT_TRUE(trend.floor);
  }
}

/// The difference at which the decrease stops, reported by the test.
void expect_floor(const std::vector<Verification>& results) {
  std::vector<double> differences;
  for (const Verification& result : results) {
    differences.push_back(
        find_relative(result.runs.back().largest, result.motion));
  }
  const StiffnessTrend trend = find_trend_of(differences);
  ASSERT_TRUE(trend.floor);
  const double floor = differences[*trend.floor];
  ::testing::Test::RecordProperty(
      "floor", fmt::format("{:.2g} at {:g} times the stiffness", floor,
                           kFactors[*trend.floor]));
  EXPECT_LT(floor, 2e-7);
  // Round-off of stiffness about a free axis would grow with it.
  for (std::size_t i = *trend.floor + 1; i < differences.size(); ++i) {
    EXPECT_LT(differences[i], 1.5 * floor) << kFactors[i];
  }
}

class StiffenedChain : public ::testing::TestWithParam<Kind> {};

TEST_P(StiffenedChain, ConvergesToTheMobilizerAtFirstOrderDownToAFloor) {
  const RigidScene scene(make_robot(GetParam()), make_scenario(GetParam()));
  const StiffenedVerification study = verify_stiffened(
      scene.scene, scene.built, kFactors, {{JointModel::ideal, 1e-12}, 0});
  expect_first_order(study.results);
  expect_floor(study.results);
}

INSTANTIATE_TEST_SUITE_P(
    All, StiffenedChain,
    ::testing::Values(
        Kind{"Pin", "continuous", "", "{ position = 0.5, velocity = 3.0 }"},
        Kind{"Slider", "prismatic", "", "{ position = 0.1, velocity = 0.8 }"},
        Kind{"Universal", "floating",
             R"(kind="universal" axis="2 -1 2" second_axis="1 4 1")",
             "{ position = [0.5, -0.7], velocity = [2.0, -3.0] }"},
        Kind{"Ball", "floating", R"(kind="ball")",
             "{ position = [0.5, -0.7, 0.3], velocity = [2.0, 1.0, -3.0] }"}),
    [](const auto& kind) { return std::string(kind.param.mobilizer); });

TEST(JointChain, OfAllFourKindsConvergesAtFirstOrderDownToAFloor) {
  const scene::Scene scene =
      scene::load_scene(LIMBER_SOURCE_DIR "/examples/joint_chain.toml");
  const StiffenedVerification study =
      verify_stiffened(scene, scene::build_system(scene, {}, ""), kFactors,
                       {{JointModel::ideal, 1e-12}, 0});
  expect_first_order(study.results);
  expect_floor(study.results);
}

}  // namespace
}  // namespace limber::reference::stiffening_slow
