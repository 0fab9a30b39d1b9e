// SPDX-License-Identifier: BSD-3-Clause
// A bar's whole surface in contact, at steps of many times the impact.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/collision_link.hpp"
#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::bar_contact_slow {
namespace {

using nlohmann::json;

/// A flexible bar and a body, one of which flies against the other.
CommandResult run_bar(const Workspace& place, const std::string& other,
                      const std::string& scene) {
  place.write("bar.urdf",
              "<robot name='r'><link name='bar'/><flexible link='bar'><mesh "
              "file='" LIMBER_SOURCE_DIR
              "/meshes/struck_bar.geo' size='0.01'/><material "
              "youngs_modulus='210e9' poisson_ratio='0.3' density='7850'/>"
              "<basis eigenmodes='20'/></flexible></robot>");
  place.write("other.urdf", other);
  place.write("scene.toml", scene +
                                "[output]\npictures = false\n"
                                "[fidelity]\ndefault = 'coupled'\n");
  return place.limber("run scene.toml --out o --json");
}

// In steps of the run a place of contact vanished where a corner of the box
// left the bar's edge, and appeared again 0.6 mm deep: it brought 11 % of
// energy. What the parts of a step leave is told.
TEST(BarAtLongSteps, GainsNoEnergyWhereACornerLeavesAnEdge) {
  const Workspace place;
  const CommandResult result =
      run_bar(place,
              make_link("box", "2.67838049", "0.000162140123",
                        "<box size='0.0246041923 0.0131904794 0.0122698752'/>",
                        "2.43445011e+09"),
              "[[robot]]\nname = 'a'\nfile = 'bar.urdf'\n"
              "[[robot]]\nname = 'b'\nfile = 'other.urdf'\n"
              "position = [0.117175478, -0.106984207, 0.0142401018]\n"
              "velocity = [-1.40008651, 1.27831478, -0.170149718]\n"
              "orientation_rpy = [0.416028807, 2.51001851, 2.17369367]\n"
              "angular_velocity = [-0.55647065, 0.873038283, -1.72354085]\n"
              "[[contact]]\nbetween = ['a.bar', 'b.box']\nfriction = 0\n"
              "restitution = 1\n"
              "[time]\nduration = 0.125537397\nstep = 0.00627686987\n");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json run = json::parse(result.out, nullptr, false);
  const json& energy = run["energy"];
  const double initial = energy["initial"].get<double>();
  EXPECT_LT(energy["peaks"]["stored"]["value"].get<double>(), 1.005 * initial);
  const double open = energy["open_share"].get<double>();
  EXPECT_LT(open, 0.05);
  EXPECT_EQ(result.errors.find("energy:") != std::string::npos, open > 0.01)
      << result.errors;
}

// Steps of 80 durations of the impact gained 15 % after it, while two touched.
TEST(BarAtLongSteps, GainsNoEnergyInATouchThatGoesOn) {
  const Workspace place;
  const CommandResult result =
      run_bar(place,
              make_link("capsule", "0.288730676", "1.1549227e-05",
                        "<capsule radius='0.01' length='0.00795745319'/>",
                        "2991745.99"),
              "[[robot]]\nname = 'a'\nfile = 'other.urdf'\n"
              "orientation_rpy = [-0.979337225, 1.01097235, 2.11216305]\n"
              "[[robot]]\nname = 'b'\nfile = 'bar.urdf'\n"
              "position = [0.0897101579, 0.0629085696, -0.105926198]\n"
              "velocity = [-0.000256813191, -0.000180088308, 0.000303234836]\n"
              "orientation_rpy = [-0.358388746, -1.77179837, -0.472784023]\n"
              "angular_velocity = [-0.000416378198, 0.000396300448, "
              "0.000335547979]\n"
              "[[contact]]\nbetween = ['a.capsule', 'b.bar']\nfriction = 0\n"
              "restitution = 0.402093706\n"
              "[time]\nduration = 523.981016\nstep = 26.1990508\n");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json run = json::parse(result.out, nullptr, false);
  const json& energy = run["energy"];
  EXPECT_LT(energy["peaks"]["stored"]["value"].get<double>(),
            1.005 * energy["initial"].get<double>());
}

}  // namespace
}  // namespace limber::test::bar_contact_slow
