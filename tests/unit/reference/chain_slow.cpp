// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/reference/verification.hpp"
#include "unit/reference/scene_folder.hpp"

namespace limber::reference::chain_slow {
namespace {

using test::make_coupler;
using test::make_joint;
using test::make_link;
using test::RigidScene;

/// Three links on hinges that are not parallel, hanging from the world and
/// falling. `damping` is the hinges' over the root of their stiffness.
std::string make_chain(double stiffness, double damping) {
  std::string text = "<robot name=\"chain\"><link name=\"world\"/>" +
                     make_link("a", 1.0) + make_link("b", 1.0) +
                     make_link("c", 1.0);
  text += make_joint("ja", "continuous", "world", "a", "0 1 0");
  text += make_joint("jb", "continuous", "a", "b", "0 1 0.5");
  text += make_joint("jc", "continuous", "b", "c", "1 1 0");
  for (const char* joint : {"ja", "jb", "jc"}) {
    text += make_coupler(joint, stiffness, damping * std::sqrt(stiffness));
  }
  return text + "</robot>";
}

std::string make_fall(double duration, double step, const char* integrator) {
  return "[time]\nduration = " + std::to_string(duration) +
         "\nstep = " + std::to_string(step) +
         "\noutput_interval = 0.05\nintegrator = \"" + integrator +
         "\"\n[gravity]\nacceleration = [0.0, 0.0, -9.81]\n"
         "[initial.joints]\nja = { velocity = 1.0 }\n"
         "jc = { position = 0.5, velocity = -3.0 }\n";
}

Verification run(double stiffness, double damping, const std::string& scenario,
                 const VerificationOptions& options) {
  const RigidScene scene(make_chain(stiffness, damping), scenario);
  return verify(scene.scene, scene.built, options);
}

std::vector<double> relatives(const Verification& result) {
  std::vector<double> all;
  for (const Agreement& r : result.runs) {
    all.push_back(find_relative(r.largest, result.motion));
  }
  return all;
}

TEST(HingedChain, EqualLawsAgreeAtFourthOrderByRungeKutta) {
  const Verification result =
      run(1e5, 0.1, make_fall(0.2, 2e-4, "runge-kutta-4"),
          {{JointModel::bushings, 1e-12}, 2});
  const std::vector<double> r = relatives(result);
  EXPECT_NEAR(std::log2(r[0] / r[1]), 4.0, 0.4);
  EXPECT_NEAR(std::log2(r[1] / r[2]), 4.0, 0.4);
  EXPECT_LT(r[2], 1e-6);
}

TEST(HingedChain, EqualLawsAgreeAtSecondOrderByGeneralizedAlpha) {
  const Verification result =
      run(1e5, 0.1, make_fall(0.2, 2e-4, "generalized-alpha"),
          {{JointModel::bushings, 1e-12}, 3});
  const std::vector<double> r = relatives(result);
  EXPECT_NEAR(std::log2(r[1] / r[2]), 2.0, 0.2);
  EXPECT_NEAR(std::log2(r[2] / r[3]), 2.0, 0.2);
}

}  // namespace
}  // namespace limber::reference::chain_slow
