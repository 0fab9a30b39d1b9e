// SPDX-License-Identifier: BSD-3-Clause
// Contacts of links in pieces.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::pieces_slow {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

json read_summary(const Workspace& place) {
  return json::parse(read_text(place.folder() / "o/summary.json"));
}

// The ball of examples/ball_on_link.toml beside mid-span, and on it, where two
// pieces are cut.
TEST(LinkInPieces, IsStruckAsTheWholeAndSaysSoWhereItIsCut) {
  const Workspace place;
  place.write("s.toml",
              "robot = '" LIMBER_SOURCE_DIR
              "/models/struck_bar.urdf'\n[output]\npictures = false\n"
              "[time]\nduration = 1e-4\nstep = 2e-7\noutput_interval = 1e-5\n"
              "[basis]\neigenmodes = 30\n"
              "[[projectile]]\nname = 'ball'\nradius = 0.01\ndensity = 7850\n"
              "position = [0.02, 0.0, 0.01501]\nvelocity = [0.0, 0.0, -1.0]\n"
              "[[contact]]\nbetween = ['bar', 'ball']\n");
  const auto strike = [&](const std::string& options) {
    const CommandResult r =
        place.limber("run s.toml --out o --cache c " + options);
    EXPECT_EQ(r.status, 0) << r.errors;
    return r;
  };
  strike("");
  const json whole = read_summary(place)["contacts"];
  EXPECT_THAT(strike("--set basis.pieces=2").errors,
              ::testing::Not(HasSubstr("at a cut")));
  const json cut = read_summary(place)["contacts"];
  ASSERT_EQ(whole.size(), 1U);
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_EQ(cut[0]["between"], (json{"bar.2", "ball"}));
  for (const char* figure : {"peak_force", "impulse", "duration"}) {
    const double truth = whole[0][figure].get<double>();
    EXPECT_NEAR(cut[0][figure].get<double>(), truth, 0.005 * truth) << figure;
  }
  EXPECT_THAT(
      strike("--set basis.pieces=2 --set "
             "projectile.ball.position=[0.0,0.0,0.01501]")
          .errors,
      AllOf(HasSubstr("pieces 'bar.1' and 'bar.2' of link 'bar' touch 'ball'"),
            HasSubstr("1.3 times too large")));
}

}  // namespace
}  // namespace limber::test::pieces_slow
