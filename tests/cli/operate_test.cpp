// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

/// `limber operate`: the report's beam, 40 000 kg, 5 m along z, nu = 0.
namespace limber::test::operate_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kModulus = 200e9;
constexpr double kDensity = 8000.0;
constexpr double kLength = 5.0;

CommandResult operate(const Workspace& place, const std::string& more) {
  return place.limber("operate " LIMBER_SOURCE_DIR
                      "/meshes/beam579.msh --youngs-modulus 200e9 "
                      "--poisson-ratio 0 --density 8000 --json " +
                      more);
}

json answer(const std::string& more) {
  const Workspace place;
  const CommandResult r = operate(place, more);
  EXPECT_EQ(r.status, 0) << r.errors;
  return json::parse(r.out);
}

// f at one end of a free rod: N falls linearly along it, so u'' = f / (E A L)
// and the ends move by f L / (3 E A) and f L / (6 E A) against the c.m.
TEST(Operate, PushedRodShortensByTheClosedForm) {
  const json state = answer("--load tip 0 0 1e6");
  EXPECT_NEAR(state.at("deformation").get<double>(),
              1e6 * kLength / (3.0 * kModulus), 1e-9 * 1e-5);
  EXPECT_NEAR(state.at("motion").at("acceleration")[2].get<double>(),
              1e6 / 40000.0, 1e-9);
  // int N^2 / (2 E A) = f^2 L / (6 E A)
  EXPECT_NEAR(state.at("strain_energy").get<double>(),
              1e12 * kLength / (6.0 * kModulus), 1e-9 * 4.2);
  EXPECT_TRUE(state.at("linear").at("holds").get<bool>());
}

// Stretch of a spun rod, slow against its axial waves: rho W^2 L^3 / 24 E at
// its ends.
TEST(Operate, SpunRodStretchesByTheClosedForm) {
  const json state =
      answer("--state spinning --axis 0 2 0 --through 0.5 0.5 2.5 --speed 3");
  const double end = kDensity * 9.0 * std::pow(kLength, 3) / (24.0 * kModulus);
  EXPECT_NEAR(state.at("deformation").get<double>(), end, 1e-3 * end);
  EXPECT_GT(state.at("motion").at("critical_speed").get<double>(), 3.0);
}

// Drag rate alpha alone: alpha m v = f.
TEST(Operate, DriftHasTheSpeedAtWhichFrictionBalances) {
  const json state =
      answer("--state drifting --load tip 0 0 8e4 --drag-rate 2");
  EXPECT_NEAR(state.at("motion").at("velocity")[2].get<double>(), 1.0, 1e-9);
}

// From rest: v = f / (alpha m) (1 - exp(-alpha t)), a = f / m exp(-alpha t).
TEST(Operate, DriftFromRestApproachesThatSpeedExponentially) {
  const json motion =
      answer("--state drifting --load tip 0 0 8e4 --drag-rate 2 --after 0.3")
          .at("motion");
  EXPECT_NEAR(motion.at("velocity")[2].get<double>(), 1.0 - std::exp(-0.6),
              1e-9);
  EXPECT_NEAR(motion.at("acceleration")[2].get<double>(), 2.0 * std::exp(-0.6),
              1e-9);
}

TEST(Operate, LeavesFieldsFiguresAndAPicture) {
  const Workspace place;
  const CommandResult r =
      operate(place, "--clamp root --load tip 500 0 0 --out o");
  ASSERT_EQ(r.status, 0) << r.errors;
  for (const char* file : {"state.h5", "summary.json", "state.png"}) {
    EXPECT_TRUE(std::filesystem::exists(place.folder() / "o" / file)) << file;
  }
}

TEST(Operate, RefusesWhatDoesNotGoTogetherByOneLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "no load: the operating state is trivial"},
      {"--state spinning --axis 0 0 0 --speed 3", "needs --axis"},
      {"--state spinning --axis 0 1 0 --speed 1e4",
       "is not below the critical speed"},
      {"--state drifting --load tip 0 0 1", "friction without damping"},
      {"--state gliding", "unknown state 'gliding'"},
      {"--load tipp 0 0 1", "'tip'"},
      {"--load tip 0 0 1 --speed 3", "--speed goes with spinning"}};
  for (const auto& [more, text] : cases) {
    const Workspace place;
    const CommandResult r = operate(place, more);
    EXPECT_EQ(r.status, 2) << more;
    EXPECT_THAT(r.errors, HasSubstr(text)) << more;
    EXPECT_EQ(std::count(r.errors.begin(), r.errors.end(), '\n'), 1) << more;
  }
}

}  // namespace
}  // namespace limber::test::operate_test
