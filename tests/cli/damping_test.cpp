// SPDX-License-Identifier: BSD-3-Clause
// Damping of a link's material is that of every mode of the arm, however the
// link is held. The right value is the ratio that is asked for: a material of
// complex modulus E (1 + i eta) has the damping ratio eta / 2 in every mode.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/types.hpp"
#include "places.hpp"

namespace limber::test::damping_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr int kBadInput = 2;
constexpr double kLinkMass = 0.2 * 0.02 * 0.008 * 1500.0;  // [kg]

struct Arm {
  std::string holds = "fixed";  ///< "clamp", "fixed", or "pieces"
  double tip_mass = 0.0;        ///< by the link's [-]
  std::string damping = "ratio='0.02'";
  std::string turned = "";  ///< attributes of the root's <origin>
  double duration = 0.6;    ///< [s]
};

const char* const kBar =
    "swept[] = {};\n"
    "Point(1) = {0, -0.01, -0.004}; Point(2) = {0, 0.01, -0.004};\n"
    "Point(3) = {0, 0.01, 0.004}; Point(4) = {0, -0.01, 0.004};\n"
    "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
    "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
    "Transfinite Curve {1, 3} = 3; Transfinite Curve {2, 4} = 2;\n"
    "Transfinite Surface {1}; Recombine Surface {1};\n"
    "swept[] = Extrude {0.2, 0, 0} { Surface{1}; Layers{4}; Recombine; };\n"
    "Physical Surface(\"root\") = {1}; Physical Surface(\"tip\") = "
    "{swept[0]};\n"
    "Physical Volume(\"body\") = {swept[1]};\n"
    "Mesh.ElementOrder = 2;\n";

/// A plastic bar of 200 x 20 x 8 mm, struck across at its tip.
void write_arm(const Workspace& place, const Arm& arm) {
  const bool is_clamped = arm.holds == "clamp";
  std::string tip;
  if (arm.tip_mass > 0.0) {
    const double mass = arm.tip_mass * kLinkMass;
    const double inertia = 1e-6 * mass;
    tip = fmt::format(
        "<link name='load'><inertial><mass value='{0}'/><inertia ixx='{1}' "
        "iyy='{1}' izz='{1}' ixy='0' ixz='0' iyz='0'/></inertial></link>"
        "<joint name='tip' type='fixed'><parent link='bar'/><child "
        "link='load'/><origin xyz='0.2 0 0'/></joint>"
        "<coupler joint='tip' translational_stiffness='1e10' "
        "rotational_stiffness='1e8' translational_damping='0' "
        "rotational_damping='0'/>",
        mass, inertia);
  }
  place.write("bar.geo", kBar);
  place.write(
      "r.urdf",
      fmt::format(
          "<robot name='r'><link name='world'/><link name='bar'/>{}"
          "<joint name='root' type='fixed'><parent link='world'/><child "
          "link='bar'/><origin xyz='0 0 0' {}/></joint>"
          "<flexible link='bar' pieces='{}'><mesh file='bar.geo'/><material "
          "youngs_modulus='3e9' poisson_ratio='0.3' density='1500'/>"
          "<damping {}/><basis eigenmodes='6'/>{}"
          "<interface name='tip' group='tip'/></flexible>{}</robot>\n",
          tip, arm.turned, arm.holds == "pieces" ? 2 : 1, arm.damping,
          is_clamped ? "<clamp group='root'/>"
                     : "<interface name='root' group='root'/>",
          is_clamped ? ""
                     : "<coupler joint='root' translational_stiffness='1e10' "
                       "rotational_stiffness='1e8' translational_damping='0' "
                       "rotational_damping='0'/>"));
  place.write(
      "s.toml",
      fmt::format(
          "robot = 'r.urdf'\n[time]\nduration = {}\nstep = 5e-4\nrho_inf = "
          "1.0\noutput_interval = 5e-4\n[[load]]\nname = 'l'\nlink = 'bar'\n"
          "interface = 'tip'\nforce = [0.0, 0.0, 0.1]\nframe = 'body'\n"
          "time = {{ kind = 'pulse', shape = 'half-sine', start = 0.0, "
          "duration = 0.02 }}\n[[probe]]\nname = 't'\nlink = 'bar'\n"
          "interface = 'tip'\n[output]\npictures = false\n",
          arm.duration));
}

json find_modes(const Workspace& place, const std::string& more = "") {
  const CommandResult r =
      place.limber("frequencies s.toml --count 8 --json " + more);
  EXPECT_EQ(r.status, 0) << r.errors;
  return json::parse(r.out).at("modes");
}

double ratio_of(const json& mode) {
  return mode.at("damping_ratio").get<double>();
}
double frequency_of(const json& mode) {
  return mode.at("frequency").get<double>();
}

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

/// Frequency response of a linear model's output to its load.
std::complex<double> find_response(const json& model, const std::string& output,
                                   double omega) {
  const auto read = [&](const char* name) {
    const json& rows = model.at(name);
    MatrixX values(std::ssize(rows), std::ssize(rows.at(0)));
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      for (Eigen::Index j = 0; j < values.cols(); ++j) {
        values(i, j) = rows[std::size_t(i)][std::size_t(j)].get<double>();
      }
    }
    return values;
  };
  const std::vector<std::string> names = model.at("output_names");
  const auto row = std::find(names.begin(), names.end(), output);
  EXPECT_NE(row, names.end()) << output;
  const MatrixX A = read("A");
  Eigen::MatrixXcd pencil = -A.cast<std::complex<double>>();
  pencil.diagonal().array() += std::complex<double>(0.0, omega);
  const Eigen::VectorXcd x = pencil.partialPivLu().solve(
      read("B").col(0).cast<std::complex<double>>());
  return (read("C").row(row - names.begin()).cast<std::complex<double>>() * x)
      .value();
}

// Of a statically determinate link stress does not depend on stiffness; near
// the first mode it leads the deflection by the loss angle.
TEST(Damping, StressOfALinearModelIsThatOfTheRelaxedMaterial) {
  const Workspace place;
  const auto linearize = [&](const std::string& damping) {
    write_arm(place, {.holds = "clamp", .damping = damping});
    place.write("s.toml", read_text(place.folder() / "s.toml") +
                              "[[probe]]\nname = 's'\nlink = 'bar'\n"
                              "nearest = [0.1, 0.01, 0.004]\n"
                              "quantity = 'stress'\n");
    const CommandResult r = place.limber("linearize s.toml -o lin.json");
    EXPECT_EQ(r.status, 0) << r.errors;
    return json::parse(read_text(place.folder() / "lin.json"));
  };
  const json elastic = linearize("ratio='1e-6'");
  const json damped = linearize("ratio='0.1'");
  const double still = find_response(elastic, "s.sxx", 0.0).real();
  EXPECT_NEAR(find_response(damped, "s.sxx", 0.0).real() / still, 1.0, 1e-5);
  const double first =
      2.0 * std::numbers::pi * frequency_of(find_modes(place).at(0));
  const std::complex<double> angle =
      find_response(damped, "s.sxx", 0.9 * first) /
      find_response(damped, "t.uz", 0.9 * first);
  EXPECT_NEAR(std::abs(angle.imag() / angle.real()), 0.2, 0.02);
}

TEST(Damping, StressOfExportedResultsIsThatOfTheRun) {
  const Workspace place;
  write_arm(place, {.damping = "ratio='0.1'", .duration = 0.03});
  place.write("s.toml", read_text(place.folder() / "s.toml") +
                            "stress = true\n[[probe]]\nname = 's'\n"
                            "link = 'bar'\nquantity = 'von_mises'\n");
  ASSERT_EQ(place.limber("run s.toml --out o --xdmf").status, 0);
  ASSERT_EQ(place.limber("export o -o m.xdmf").status, 0);
  const Hdf5File run = Hdf5File::open(place.folder() / "o" / "motion.h5");
  const Hdf5File exported = Hdf5File::open(place.folder() / "m.h5");
  for (const char* step : {"000010", "000030", "000050"}) {
    const std::string at = std::string("steps/") + step + "/von_mises";
    const double most = run.read_matrix(at).maxCoeff();
    EXPECT_GT(most, 1.0);
    EXPECT_NEAR(exported.read_matrix(at).maxCoeff() / most, 1.0, 1e-4) << step;
  }
}

}  // namespace
}  // namespace limber::test::damping_test
