// SPDX-License-Identifier: BSD-3-Clause
// First-order elements, which are too stiff in bending: the warning, and the
// order that mends it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::locking_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kLength = 0.2, kSide = 0.02;  ///< [m]
constexpr double kModulus = 71e9;              ///< [Pa]
const std::string kMaterial =
    " --youngs-modulus 71e9 --poisson-ratio 0.33 --density 2700 --unit 1e-3 ";

/// A bar of ten cubes of 20 mm, as a Nastran deck in millimetres.
std::string bar_deck() {
  std::string text = "SOL 103\nCEND\nBEGIN BULK\nPSOLID,1,1\n";
  for (int i = 0; i <= 10; ++i)
    for (int k = 0; k < 4; ++k)
      text += fmt::format("GRID,{},,{}.,{}.,{}.\n", 4 * i + k + 1, 20 * i,
                          k == 1 || k == 2 ? 20 : 0, k >= 2 ? 20 : 0);
  for (int i = 0; i < 10; ++i) {
    const int n = 4 * i;
    text += fmt::format("CHEXA,{},1,{},{},{},{},{},{}\n,{},{}\n", i + 1, n + 1,
                        n + 2, n + 3, n + 4, n + 5, n + 6, n + 7, n + 8);
  }
  return text + "ENDDATA\n";
}

std::string scene(const std::string& attributes) {
  return fmt::format(
      "<robot name='r'><link name='world'/><link name='bar'/>"
      "<joint name='j' type='fixed'><parent link='world'/>"
      "<child link='bar'/></joint><flexible link='bar'>"
      "<mesh file='bar.bdf' unit='mm'{}/><material youngs_modulus='{}' "
      "poisson_ratio='0.33' density='2700'/><interface name='root' "
      "plane_point='0 0 0' plane_normal='1 0 0'/>"
      "<attach joint='j' interface='root'/></flexible></robot>\n",
      attributes, kModulus);
}

class LockingBar : public ::testing::Test {
 protected:
  LockingBar() {
    place_.write("bar.bdf", bar_deck());
    place_.write("s.toml",
                 "robot = 'r.urdf'\n[time]\nduration = 1e-4\nstep = 1e-5\n"
                 "[[load]]\nname = 'f'\nlink = 'bar'\n"
                 "plane = {point = [0.2, 0, 0], normal = [1, 0, 0]}\n"
                 "force = [0, 0, 10.0]\n"
                 "[[probe]]\nname = 't'\nlink = 'bar'\n"
                 "plane = {point = [0.2, 0, 0], normal = [1, 0, 0]}\n"
                 "quantity = 'displacement'\n");
  }
  Workspace place_;
};

TEST_F(LockingBar, ModesWarnOfItWithBothFrequencies) {
  const CommandResult first = place_.limber("modes bar.bdf --json" + kMaterial);
  ASSERT_EQ(first.status, 0) << first.errors;
  EXPECT_THAT(first.errors, AllOf(HasSubstr("elements of first order"),
                                  HasSubstr("--order 2")));
  const CommandResult second =
      place_.limber("modes bar.bdf --order 2 --json" + kMaterial);
  ASSERT_EQ(second.status, 0) << second.errors;
  EXPECT_EQ(second.errors, "");
  const json locking = json::parse(first.out).at("locking");
  const double known =
      json::parse(second.out).at("frequencies_hz").at(0).get<double>();
  EXPECT_NEAR(locking.at("refined_frequency_hz").get<double>(), known,
              0.01 * known);
  EXPECT_GT(locking.at("error").get<double>(), 0.1);
}

TEST_F(LockingBar, ReduceWarnsAndTheFileKeepsIt) {
  const CommandResult r = place_.limber("reduce bar.bdf -o b.h5" + kMaterial);
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("elements of first order"));
  const CommandResult info = place_.limber("info b.h5 --json");
  EXPECT_GT(json::parse(info.out).at("locking").at("error").get<double>(), 0.1);
}

TEST_F(LockingBar, EveryRunWarnsAlsoWithABodyFromTheCache) {
  place_.write("r.urdf", scene(""));
  for (const std::string out : {"a", "b"}) {
    const CommandResult r = place_.limber("run s.toml --cache c --out " + out);
    ASSERT_EQ(r.status, 0) << r.errors;
    EXPECT_THAT(r.errors, AllOf(HasSubstr("link 'bar'"),
                                HasSubstr("elements of first order")));
  }
  place_.write("r.urdf", scene(" order='2'"));
  const CommandResult r = place_.limber("run s.toml --cache c --out c2");
  ASSERT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(r.errors, Not(HasSubstr("first order")));
}

// Euler and Bernoulli's free bar, 22.3733 sqrt(E I / (rho A)) / (2 pi L^2): a
// bound from above, 4 % below which shear and rotary inertia lead here.
TEST_F(LockingBar, WithOrderTwoHasABeamsFrequency) {
  const double radius = kSide / std::sqrt(12.0);
  const double euler = 22.3733 / (2.0 * std::numbers::pi * kLength * kLength) *
                       radius * std::sqrt(kModulus / 2700.0);
  const auto frequency = [&](const std::string& more) {
    const CommandResult r =
        place_.limber("modes bar.bdf --json" + more + kMaterial);
    EXPECT_EQ(r.status, 0) << r.errors;
    return json::parse(r.out).at("frequencies_hz").at(0).get<double>();
  };
  EXPECT_LT(frequency(" --order 2"), euler);
  EXPECT_GT(frequency(" --order 2"), 0.94 * euler);
  EXPECT_GT(frequency(""), 1.15 * euler);
}

// tests/data/first_order_bar/README.md.
class FirstOrderBar : public ::testing::Test {
 protected:
  FirstOrderBar() {
    for (const char* name : {"bar.bdf", "bar.urdf", "bar.toml"}) {
      place_.write(name, read_text(kData / name));
    }
  }

  void promote() const {
    std::string robot = read_text(kData / "bar.urdf");
    const std::string unit = "unit=\"mm\"";
    robot.insert(robot.find(unit) + unit.size(), " order=\"2\"");
    place_.write("bar.urdf", robot);
  }

  /// Displacement of the tip in the direction of 10 N along an axis [m].
  [[nodiscard]] double pull(int axis) const {
    std::string force = "[0, 0, 0]";
    force.replace(static_cast<std::size_t>(1 + 3 * axis), 1, "10");
    const CommandResult r = place_.limber(
        "static bar.toml --json --out o --set load.force.force='" + force +
        "'");
    EXPECT_EQ(r.status, 0) << r.errors;
    const std::string column = fmt::format("tip.u{}", "xyz"[axis]);
    return json::parse(r.out).at("probes").at(column).at("value").get<double>();
  }

  const std::filesystem::path kData =
      std::filesystem::path(LIMBER_SOURCE_DIR) / "tests/data/first_order_bar";
  Workspace place_;

  static constexpr double kForce = 10.0, kPoisson = 0.33;
  static constexpr double kArea = kSide * kSide;
  static double find_timoshenko() {
    const double kappa = 10.0 * (1.0 + kPoisson) / (12.0 + 11.0 * kPoisson);
    const double shear = kModulus / (2.0 * (1.0 + kPoisson));
    const double bending =
        4.0 * std::pow(kLength, 3) / (kModulus * std::pow(kSide, 4));
    return kForce * (bending + kLength / (kappa * shear * kArea));
  }
};

// Within 1 %: the default joint and the root's face, held by its mean motion
// alone, add up to half of that each.
TEST_F(FirstOrderBar, WithOrderTwoBendsAsTimoshenkosCantilever) {
  promote();
  EXPECT_NEAR(pull(1) / find_timoshenko(), 1.0, 0.01);
  EXPECT_NEAR(pull(2) / find_timoshenko(), 1.0, 0.01);
}

// What locks is bending alone. Within 2 %: faces whose mean is held and pulled
// warp, as far in as their width, a tenth of the length.
TEST_F(FirstOrderBar, StretchesAsARodWithEitherOrder) {
  const double stretch = kForce * kLength / (kModulus * kArea);
  EXPECT_NEAR(pull(0) / stretch, 1.0, 0.02);
  promote();
  EXPECT_NEAR(pull(0) / stretch, 1.0, 0.02);
}

// The warning's error is of a frequency, the root of a stiffness.
TEST_F(FirstOrderBar, LocksAsMuchAsItsWarningSays) {
  const CommandResult modes = place_.limber("modes bar.bdf --json" + kMaterial);
  const double told =
      json::parse(modes.out).at("locking").at("error").get<double>();
  const double stiffer = find_timoshenko() / pull(2);
  EXPECT_GT(stiffer, 1.5);
  EXPECT_NEAR(std::sqrt(stiffer) - 1.0, told, 0.1 * told);
}

}  // namespace
}  // namespace limber::test::locking_test
