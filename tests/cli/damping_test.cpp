// SPDX-License-Identifier: BSD-3-Clause
// Damping of a link's material is that of every mode of the arm, however the
// link is held. The right value is the ratio that is asked for: a material of
// complex modulus E (1 + i eta) has the damping ratio eta / 2 in every mode.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/damped_arm.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::damping_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr int kBadInput = 2;

/// The deflection across at the probe, at each output.
std::vector<double> read_deflection(const Workspace& place,
                                    const std::string& folder) {
  std::istringstream lines(read_text(place.folder() / folder / "probes.csv"));
  std::vector<double> z;
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("t.uz"));
  while (std::getline(lines, line)) {
    z.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  }
  return z;
}

/// From the logarithmic decrement of the maxima after the strike.
double find_decay_ratio(const std::vector<double>& z) {
  std::vector<double> maxima;
  for (std::size_t i = 200; i + 1 < z.size(); ++i) {
    if (z[i] > z[i - 1] && z[i] >= z[i + 1] && z[i] > 0.0) {
      maxima.push_back(z[i]);
    }
  }
  EXPECT_GE(maxima.size(), 4U);
  const double decrement = std::log(maxima.front() / maxima.back()) /
                           static_cast<double>(maxima.size() - 1);
  return decrement / std::hypot(2.0 * std::numbers::pi, decrement);
}

TEST(Damping, RatioIsThatOfEveryModeHoweverALinkIsHeld) {
  const Workspace place;
  for (const char* holds : {"clamp", "fixed", "pieces"}) {
    for (const double tip_mass : {0.0, 1.0, 10.0}) {
      for (const double ratio : {0.005, 0.02}) {
        write_arm(place, {.holds = holds,
                          .tip_mass = tip_mass,
                          .damping = fmt::format("ratio='{}'", ratio)});
        for (const json& mode : find_modes(place)) {
          EXPECT_NEAR(ratio_of(mode), ratio, 0.05 * ratio)
              << holds << ' ' << tip_mass << ' ' << mode.dump();
        }
      }
    }
  }
}

TEST(Damping, LossFactorIsTwiceTheRatio) {
  const Workspace place;
  write_arm(place, {.damping = "loss_factor='0.04'"});
  const json by_factor = find_modes(place);
  write_arm(place, {.damping = "ratio='0.02'"});
  EXPECT_EQ(by_factor, find_modes(place));
}

// The stiffness is the given one at the lowest frequency.
TEST(Damping, KeepsTheLowestFrequency) {
  const Workspace place;
  for (const double tip_mass : {0.0, 10.0}) {
    write_arm(place, {.tip_mass = tip_mass});
    const json damped = find_modes(place);
    write_arm(place, {.tip_mass = tip_mass, .damping = ""});
    const json elastic = find_modes(place);
    EXPECT_NEAR(frequency_of(damped[0]) / frequency_of(elastic[0]), 1.0, 2e-3);
    // Causality's price of a constant loss factor.
    EXPECT_GT(frequency_of(damped[3]), 1.01 * frequency_of(elastic[3]));
    EXPECT_LT(frequency_of(damped[3]), 1.08 * frequency_of(elastic[3]));
  }
}

TEST(Damping, RunDecaysByTheRatioAtEveryLevelOfModes) {
  const Workspace place;
  for (const char* holds : {"clamp", "fixed", "pieces"}) {
    write_arm(place, {.holds = holds});
    for (const std::string level :
         {"uncoupled", "one-way", "coupled", "nonlinear"}) {
      const bool is_low = level == "uncoupled" || level == "one-way";
      if (is_low && holds == std::string("pieces")) continue;  // not cut there
      const CommandResult r =
          place.limber("run s.toml --out o --fidelity " + level);
      ASSERT_EQ(r.status, 0) << r.errors;
      EXPECT_NEAR(find_decay_ratio(read_deflection(place, "o")), 0.02,
                  0.05 * 0.02)
          << holds << ' ' << level;
    }
  }
}

TEST(Damping, RunDecaysByTheRatioWithEveryIntegrator) {
  const Workspace place;
  write_arm(place, {.holds = "clamp"});
  for (const std::string scheme :
       {"runge-kutta-4", "central-differences", "energy-conserving",
        "splitting", "explicit-euler"}) {
    const CommandResult r = place.limber(
        "run s.toml --out o --unset time.rho_inf --set time.integrator=" +
        scheme);
    ASSERT_EQ(r.status, 0) << r.errors;
    EXPECT_NEAR(find_decay_ratio(read_deflection(place, "o")), 0.02,
                0.05 * 0.02)
        << scheme;
  }
}

TEST(Damping, RunWithATipMassDecaysByTheRatio) {
  const Workspace place;
  write_arm(place, {.tip_mass = 10.0, .duration = 1.5});
  const CommandResult r = place.limber("run s.toml --out o");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_NEAR(find_decay_ratio(read_deflection(place, "o")), 0.02, 0.05 * 0.02);
}

TEST(Damping, IsTheSameInATurnedScene) {
  const Workspace place;
  write_arm(place, {});
  const json straight = find_modes(place);
  write_arm(place, {.turned = "rpy='0.3 -1.1 0.7'"});
  const json turned = find_modes(place);
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_NEAR(ratio_of(turned[i]), ratio_of(straight[i]), 1e-7);
    EXPECT_NEAR(frequency_of(turned[i]), frequency_of(straight[i]), 1e-3);
  }
}

TEST(Damping, StaticStiffnessIsReported) {
  const Workspace place;
  write_arm(place, {});
  const std::string constant =
      "--unset load.l.time.shape --unset load.l.time.start --unset "
      "load.l.time.duration --set load.l.time.kind=constant ";
  const auto find_deflection = [&] {
    const CommandResult r =
        place.limber("static s.toml --json --out o " + constant);
    EXPECT_EQ(r.status, 0) << r.errors;
    const json body = json::parse(r.out).at("bodies").at(0);
    return std::make_pair(body.at("deformation").get<double>(),
                          body.at("static_stiffness").get<double>());
  };
  const auto [damped, stiffness] = find_deflection();
  const CommandResult text = place.limber("static s.toml --out o " + constant);
  EXPECT_THAT(text.out, HasSubstr("bar: static stiffness 0.9"));
  write_arm(place, {.damping = ""});
  const auto [elastic, one] = find_deflection();
  EXPECT_EQ(one, 1.0);
  EXPECT_LT(stiffness, 0.995);
  EXPECT_GT(stiffness, 0.95);
  EXPECT_NEAR(damped * stiffness / elastic, 1.0, 1e-5);
}

// Of a statically determinate link stress does not depend on stiffness.
TEST(Damping, StaticStressIsThatOfTheElasticLink) {
  const Workspace place;
  const auto find_stress = [&](const std::string& damping) {
    write_arm(place, {.damping = damping});
    const std::string scenario = read_text(place.folder() / "s.toml");
    place.write("s.toml", scenario +
                              "[[probe]]\nname = 's'\nlink = 'bar'\n"
                              "quantity = 'von_mises'\n");
    const CommandResult r = place.limber(
        "static s.toml --out o --unset load.l.time.shape --unset "
        "load.l.time.start --unset load.l.time.duration --set "
        "load.l.time.kind=constant");
    EXPECT_EQ(r.status, 0) << r.errors;
    const std::string label = "s.von_mises";
    return std::stod(r.out.substr(r.out.find(label) + label.size()));
  };
  EXPECT_NEAR(find_stress("ratio='0.1'") / find_stress(""), 1.0, 1e-5);
}

TEST(Damping, PerModeIsThatOfTheFreeBody) {
  const Workspace place;
  write_arm(place, {.holds = "clamp", .damping = "per_mode='0.02'"});
  for (const json& mode : find_modes(place)) {
    EXPECT_NEAR(ratio_of(mode), 0.02, 1e-9);
  }
  write_arm(place, {.damping = "per_mode='0.02'"});
  EXPECT_LT(ratio_of(find_modes(place)[0]), 0.004);
}

TEST(Damping, RayleighsMassPartNeedsAClamp) {
  const Workspace place;
  write_arm(place, {.damping = "rayleigh_mass='50'"});
  const CommandResult r = place.limber("frequencies s.toml");
  EXPECT_EQ(r.status, kBadInput);
  EXPECT_THAT(r.errors,
              HasSubstr("it is allowed only for a link with a <clamp>"));
  write_arm(place, {.holds = "clamp", .damping = "rayleigh_mass='50'"});
  const json mode = find_modes(place)[0];
  EXPECT_NEAR(ratio_of(mode),
              50.0 / (4.0 * std::numbers::pi * frequency_of(mode)), 1e-9);
}

TEST(Damping, RefusesRatiosOutOfRangeAndTwoOfThem) {
  const Workspace place;
  for (const auto& [damping, text] :
       std::vector<std::pair<std::string, std::string>>{
           {"ratio='0.7'", "ratio"},
           {"ratio='-0.1'", "ratio"},
           {"loss_factor='2'", "loss_factor"},
           {"ratio='0.02' loss_factor='0.04'", "keep one"},
           {"ratios='0.02'", "ratios"}}) {
    write_arm(place, {.damping = damping});
    const CommandResult r = place.limber("frequencies s.toml");
    EXPECT_EQ(r.status, kBadInput) << damping;
    EXPECT_THAT(r.errors, HasSubstr(text));
  }
}

TEST(Damping, AtLevelFullIsReportedToBePerMode) {
  const Workspace place;
  write_arm(place, {.duration = 0.002});
  const CommandResult r = place.limber("run s.toml --out o --fidelity full");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("those of the arm are damped less"));
}

TEST(Damping, ResumedRunIsTheUninterruptedOne) {
  const Workspace place;
  write_arm(place, {.duration = 20.0});
  const CommandResult cut = run_shell(
      place, "'" LIMBER_COMMAND
             "' run s.toml --out out --checkpoint-interval 0 >run.txt 2>&1 & "
             "pid=$!; while kill -0 $pid 2>/dev/null && [ ! -e "
             "out/checkpoint.bin ]; do sleep 0.01; done; kill -9 $pid");
  ASSERT_EQ(cut.status, 0) << cut.errors;
  const CommandResult resumed = place.limber("run s.toml --out out --resume");
  ASSERT_EQ(resumed.status, 0) << resumed.errors;
  ASSERT_EQ(place.limber("run s.toml --out whole").status, 0);
  EXPECT_EQ(read_text(place.folder() / "out/probes.csv"),
            read_text(place.folder() / "whole/probes.csv"));
}

// Runs of a study share the frequencies in which the loss factor holds, where
// these are the same.
TEST(Damping, InAStudyIsThatOfSingleRunsToTheBit) {
  const Workspace place;
  write_arm(place, {.tip_mass = 1.0, .duration = 0.05});
  place.write("study.toml", R"(scenario = 's.toml'
[design]
kind = 'latin-hypercube'
samples = 12
seed = 3
[[factor]]
name = 'force'
path = 'load.l.force.2'
uniform = [0.1, 1.0]
[[factor]]
name = 'youngs_modulus'
path = 'robot.flexible.bar.material.youngs_modulus'
choice = [3e9, 4e9]
[[factor]]
name = 'hold'
path = 'robot.coupler.tip.rotational_stiffness'
choice = [10.0, 1e8]
[[factor]]
name = 'ratio'
path = 'robot.flexible.bar.damping.ratio'
choice = [0.02, 0.1]
[[response]]
name = 'end'
probe = 't.uz'
measure = 'final'
)");
  ASSERT_EQ(place.limber("study study.toml --out a --csv --jobs 1").status, 0);
  std::istringstream table(read_text(place.folder() / "a/study.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_THAT(line, HasSubstr("force,youngs_modulus,hold,ratio,end"));
  for (int i = 0; i < 12; ++i) {
    std::getline(table, line);
    for (int comma = 0; comma < 5; ++comma) line.erase(0, line.find(',') + 1);
    const CommandResult r = place.limber(
        fmt::format("run --from a/study.sqlite#{} --out r --json", i));
    ASSERT_EQ(r.status, 0) << r.errors;
    EXPECT_EQ(std::stod(line), json::parse(r.out)["probes"]["t.uz"]["final"])
        << i;
  }
}

TEST(Damping, IsPartOfALinearModel) {
  const Workspace place;
  write_arm(place, {.holds = "clamp"});
  const CommandResult r = place.limber("linearize s.toml --output lin.json");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(read_text(place.folder() / "lin.json"), HasSubstr("relaxation1"));
}

}  // namespace
}  // namespace limber::test::damping_test
