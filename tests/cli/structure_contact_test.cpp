// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/impact_run.hpp"

/// Contact on the faces of shells, by the command.
namespace limber::test::structure_contact_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kThickness = 0.02;  // [m]
constexpr int kAcross = 24;          // elements

/// A square steel plate of 1 m, its lower corner at the origin.
std::string write_plate(double thickness = kThickness) {
  std::string deck = "*NODE\n";
  for (int j = 0; j <= kAcross; ++j)
    for (int i = 0; i <= kAcross; ++i)
      deck += fmt::format("{}, {}, {}, 0\n", 1 + i + j * (kAcross + 1),
                          double(i) / kAcross, double(j) / kAcross);
  deck += "*ELEMENT, TYPE=S4, ELSET=Plate\n";
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i) {
      const int a = 1 + i + j * (kAcross + 1);
      deck += fmt::format("{}, {}, {}, {}, {}\n", a, a, a + 1, a + kAcross + 2,
                          a + kAcross + 1);
    }
  return deck +
         fmt::format(
             "*NSET, NSET=Side\n1\n*MATERIAL, NAME=S\n*ELASTIC\n2.1e11, 0.3\n"
             "*DENSITY\n7800\n*SHELL SECTION, ELSET=Plate, MATERIAL=S\n{}\n",
             thickness);
}

class StructureContact : public ::testing::Test {
 protected:
  /// A ball of 0.63 kg and 50 mm strikes the middle of the plate with 1 m/s.
  json strike(const std::string& surface, double side,
              double gap = 1e-4) const {
    place_.write("plate.inp", write_plate());
    place_.write("plate.urdf",
                 "<robot name='plate'><link name='plate'/><flexible "
                 "link='plate'><mesh file='plate.inp'/><basis "
                 "eigenmodes='80'/></flexible><contact link='plate' surface='" +
                     surface + "'/></robot>");
    place_.write(
        "s.toml",
        fmt::format(
            "robot = 'plate.urdf'\n[time]\nduration = 1.2e-3\nstep = 2e-6\n"
            "output_interval = 1e-4\n[[projectile]]\nname = 'ball'\n"
            "radius = 0.05\nmass = 0.63\nposition = [0.5, 0.5, {}]\n"
            "velocity = [0, 0, {}]\nyoungs_modulus = 3e9\n"
            "poisson_ratio = 0.3\n[[contact]]\nbetween = ['plate', 'ball']\n"
            "friction = 0.0\nrestitution = 1.0\n[output]\npictures = false\n",
            side * (0.05 + 0.5 * kThickness + gap), -side));
    return run_for_summary(place_, "s.toml");
  }

  Workspace place_;
};

struct Impact {
  double peak = 0.0;      // [N]
  double duration = 0.0;  // [s]
  double impulse = 0.0;   // [N s]
};

/// On a plate without edges, that a force moves by alpha times its integral.
///
/// Equation   s' = v - alpha F, m v' = -F, F = k s^1.5, alpha = 1 / (8 sqrt(rho
///            h D))
/// Source     [@zener1941]
Impact solve_zener(double k, double mass, double alpha) {
  constexpr double kStep = 1e-8;
  Impact impact;
  double s = 0.0;
  double v = 1.0;
  do {
    const auto force = [&](double at) {
      return k * std::pow(std::max(at, 0.0), 1.5);
    };
    const double half = s + 0.5 * kStep * (v - alpha * force(s));
    const double F = force(half);
    s += kStep * (v - 0.5 * kStep * F / mass - alpha * F);
    v -= kStep * F / mass;
    impact.peak = std::max(impact.peak, F);
    impact.impulse += kStep * F;
    impact.duration += kStep;
  } while (s > 0.0);
  return impact;
}

/// 80 modes up to 6 kHz, while the impact lasts 0.7 ms; waves need 1 ms to the
/// edges and back.
TEST_F(StructureContact, OfABallOnAPlateIsThatOfZener) {
  const double D = 2.1e11 * std::pow(kThickness, 3) / 12.0 / 0.91;
  const double alpha = 1.0 / (8.0 * std::sqrt(7800.0 * kThickness * D));
  const double modulus = 1.0 / (0.91 / 2.1e11 + 0.91 / 3e9);
  const Impact zener =
      solve_zener(4.0 / 3.0 * modulus * std::sqrt(0.05), 0.63, alpha);
  const json run = strike("Plate.top", 1.0);
  ASSERT_EQ(run["contacts"].size(), 1U);
  const json& found = run["contacts"][0];
  EXPECT_NEAR(found["time"].get<double>(), 1e-4, 2e-6);  // at the face
  EXPECT_NEAR(found["peak_force"].get<double>(), zener.peak, 0.02 * zener.peak);
  EXPECT_NEAR(found["impulse"].get<double>(), zener.impulse,
              0.02 * zener.impulse);
  EXPECT_NEAR(found["duration"].get<double>(), zener.duration,
              0.03 * zener.duration);
}

// To what the beginning of a touch is found within: 1e-4 of a step's motion.
TEST_F(StructureContact, OnTheOtherSideIsTheSame) {
  const json top = strike("Plate.top", 1.0)["contacts"][0];
  const json bottom = strike("Plate.bottom", -1.0)["contacts"][0];
  for (const char* key : {"time", "peak_force", "impulse"})
    EXPECT_NEAR(bottom[key].get<double>(), top[key].get<double>(),
                1e-5 * top[key].get<double>())
        << key;
}

TEST_F(StructureContact, RefusesASurfaceThatIsNone) {
  place_.write("plate.inp", write_plate());
  for (const auto& [surface, what] :
       {std::pair{"Plat.top", "Plate"},
        {"Side", "contact group 'Side' has no faces on the body's surface"},
        {"Plate.left", "Plate.left"}}) {
    place_.write(
        "plate.urdf",
        fmt::format("<robot name='plate'><link name='plate'/><flexible "
                    "link='plate'><mesh file='plate.inp'/><basis "
                    "eigenmodes='4'/></flexible><contact link='plate' "
                    "surface='{}'/></robot>",
                    surface));
    place_.write("s.toml",
                 "robot = 'plate.urdf'\n[time]\nduration = 1e-3\nstep = 1e-4\n"
                 "[[projectile]]\nname = 'ball'\nradius = 0.05\nmass = 0.6\n"
                 "position = [0.5, 0.5, 0.2]\n[[contact]]\n"
                 "between = ['plate', 'ball']\n");
    const CommandResult result = place_.limber("run s.toml --out o");
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors, HasSubstr(what));
  }
}

}  // namespace
}  // namespace limber::test::structure_contact_test
