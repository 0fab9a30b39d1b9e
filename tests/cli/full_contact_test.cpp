// SPDX-License-Identifier: BSD-3-Clause
// A ball strikes a bar: the whole mesh against its modes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/impact_run.hpp"
#include "places.hpp"

namespace limber::test::full_contact_test {
namespace {

using nlohmann::json;

/// The ball of examples/ball_on_link.toml on elements of 10 mm, in steps of a
/// twenty-fifth of the impact.
json strike(const std::string& level) {
  const Workspace place;
  place.write("ball.toml",
              "robot = '" LIMBER_SOURCE_DIR
              "/models/struck_bar.urdf'\n[output]\npictures = false\n"
              "[[projectile]]\nname = 'ball'\nradius = 0.01\n"
              "density = 7850\nposition = [0.0, 0.0, 0.01501]\n"
              "velocity = [0.0, 0.0, -1.0]\n"
              "[[contact]]\nbetween = ['bar', 'ball']\n"
              "[time]\nduration = 7e-5\nstep = 2e-6\n"
              "output_interval = 1e-5\n[basis]\neigenmodes = 40\n"
              "[fidelity]\ndefault = '" +
                  level + "'\n");
  return run_for_summary(place,
                         "ball.toml --set 'robot.flexible.bar.mesh.size=0.01'");
}

TEST(FullContactRun, OfABallOnABarIsThatOfItsModes) {
  const json coupled = strike("coupled");
  const json full = strike("full");
  expect_same_impact(full, coupled, 0.01, 0.01);
  EXPECT_LE(full["energy"]["peaks"]["stored"]["value"].get<double>(),
            1.005 * full["energy"]["initial"].get<double>());
}

/// The ball meets a corner of four faces, two of which are nearest once they
/// are pressed inwards.
TEST(FullContactRun, OfABallOnACornerOfFacesTakesFewIterations) {
  const json full = strike("full");
  EXPECT_LE(full["newton_iterations"].get<long>(),
            5 * full["steps"].get<long>());
  EXPECT_EQ(full["steps_halved"].get<long>(), 0);
}

}  // namespace
}  // namespace limber::test::full_contact_test
