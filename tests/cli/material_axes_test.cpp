// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli/command.hpp"
#include "cli/stress_answers.hpp"
#include "limber/common/types.hpp"

/// Stress in material axes: a bar along x, 1 m x 0.1 m x 0.05 m, held at x = 0
/// and pulled by 1000 N.
namespace limber::test::material_axes_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kPull = 1000.0 / (0.1 * 0.05);  // [Pa]
constexpr const char* kFibres =
    "youngs_modulus='140e9 10e9 10e9' poisson_ratio='0.3 0.3 0.4' "
    "shear_modulus='5e9 5e9 3.5e9' density='1600' ";

void write_bar(const Workspace& place, const std::string& material,
               const std::string& axes, const std::string& origin = "") {
  place.write("bar.geo",
              "Point(1) = {0, 0, 0};\n"
              "l[] = Extrude {0, 0.1, 0} { Point{1}; Layers{2}; };\n"
              "s[] = Extrude {0, 0, 0.05} { Line{l[1]}; Layers{1}; "
              "Recombine; };\n"
              "v[] = Extrude {1, 0, 0} { Surface{s[1]}; Layers{20}; "
              "Recombine; };\n"
              "Physical Surface(\"root\") = {s[1]};\n"
              "Physical Surface(\"tip\") = {v[0]};\n"
              "Physical Volume(\"bar\") = {v[1]};\n");
  place.write("bar.urdf",
              fmt::format("<robot name='bar'><link name='bar'/>"
                          "<flexible link='bar'><mesh file='bar.geo' "
                          "order='2'/>{}<material {}/><clamp group='root'/>"
                          "<basis eigenmodes='6' rows='boundary'/></flexible>"
                          "</robot>\n",
                          origin, material));
  const std::string where = "nearest = [0.5, 0.05, 0.05]\n";
  place.write(
      "s.toml",
      "robot = 'bar.urdf'\n[time]\nduration = 0.01\nstep = 1e-4\n[output]\n"
      "pictures = false\n[[load]]\nname = 'tip'\nlink = 'bar'\ngroup = 'tip'\n"
      "force = [1000.0, 0.0, 0.0]\nframe = 'body'\ntime = { kind = "
      "'constant' }\n" +
          probe_text("link", "stress", where) +
          probe_text("own", "stress", where + "axes = '" + axes + "'"));
}

Matrix3 read_tensor(const json& summary, const std::string& probe,
                    const std::string& axes) {
  Matrix3 tensor;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const std::string column =
          fmt::format("{}.s{}{}", probe, axes.at(static_cast<std::size_t>(i)),
                      axes.at(static_cast<std::size_t>(j)));
      tensor(i, j) = tensor(j, i) = value(summary, column);
    }
  return tensor;
}

// Far from its ends the bar has the uniform stress F / A, whatever its material
// (Saint-Venant): along fibres at 30 degrees it has cos^2, sin^2, -sin cos of
// it. Its bending by the coupling of extension and shear is free.
TEST(MaterialAxes, OfFibresAtAnAngleHaveTheTurnedStressOfABar) {
  const double c = std::cos(M_PI / 6.0);
  const double s = std::sin(M_PI / 6.0);
  const Workspace place;
  write_bar(place,
            kFibres + fmt::format("axis_1='{} {} 0' axis_2='0 1 0'", c, s),
            "material");
  const json summary = answer(place, "static s.toml");
  Matrix3 right;
  right << c * c, -s * c, 0.0, -s * c, s * s, 0.0, 0.0, 0.0, 0.0;
  const Matrix3 own = read_tensor(summary, "own", "123");
  EXPECT_LT((own / kPull - right).cwiseAbs().maxCoeff(), 0.02) << own / kPull;
}

// At (x, y, z) = (0.5, 0.05, 0.05) of a cylinder about z through (0.5, -0.05):
// the first axis is y, the second -x.
TEST(MaterialAxes, OfACylinderAreThoseOfThePlace) {
  const Workspace place;
  write_bar(place,
            std::string(kFibres) +
                "cylinder_axis='0 0 1' cylinder_point='0.5 -0.05 0'",
            "material");
  const json summary = answer(place, "static s.toml");
  const Matrix3 link = read_tensor(summary, "link", "xyz");
  const Matrix3 own = read_tensor(summary, "own", "123");
  Matrix3 R;  // columns: axes 1, 2, 3 in the link
  R << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  EXPECT_GT(link(0, 0), 0.5 * kPull);
  EXPECT_LT((own - R.transpose() * link * R).norm(), 1e-6 * link.norm());
}

TEST(MaterialAxes, AreTheSameInASavedBody) {
  const Workspace place;
  write_bar(place, kFibres + std::string("axis_1='1 1 0' axis_2='0 1 0'"),
            "material");
  const json made = answer(place, "static s.toml");
  const json cached = answer(place, "static s.toml");
  for (const char* column : {"own.s11", "own.s22", "own.s12"})
    EXPECT_EQ(value(made, column), value(cached, column)) << column;
}

/// The half of the bar at x < 0.5 is of steel.
TEST(MaterialAxes, AreRefusedAtIsotropicNodesAndNotAtABorder) {
  const Workspace place;
  write_bar(place,
            std::string(kFibres) +
                "group='bar' axis_1='1 0 0' "
                "axis_2='0 1 0'/><material "
                "group='root_half' "
                "youngs_modulus='200e9' "
                "poisson_ratio='0.3' density='8000'",
            "material");
  std::string geometry = read_text(place.folder() / "bar.geo");
  const std::string whole =
      "v[] = Extrude {1, 0, 0} { Surface{s[1]}; Layers{20}";
  geometry.replace(geometry.find(whole), whole.size(),
                   "w[] = Extrude {0.5, 0, 0} { Surface{s[1]}; Layers{10}; "
                   "Recombine; };\nPhysical Volume(\"root_half\") = {w[1]};\n"
                   "v[] = Extrude {0.5, 0, 0} { Surface{w[0]}; Layers{10}");
  place.write("bar.geo", geometry);
  const auto at = [&](double x) {
    const std::string text = read_text(place.folder() / "s.toml");
    place.write("at.toml",
                std::regex_replace(text, std::regex("nearest = .0.5"),
                                   fmt::format("nearest = [{}", x)));
    return place.limber("static at.toml --cache c --out o");
  };
  const CommandResult refused = at(0.25);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("is isotropic and has no axes"));
  for (const double x : {0.5, 0.75}) {
    const CommandResult result = at(x);
    EXPECT_EQ(result.status, 0) << result.errors;
  }
  // Uniform tension, half the bar away from its ends.
  const json summary =
      json::parse(read_text(place.folder() / "o/summary.json"));
  EXPECT_NEAR(value(summary, "own.s11"), kPull, 0.03 * kPull);
}

TEST(MaterialAxes, AreRefusedWhereThereAreNone) {
  const std::string isotropic =
      "youngs_modulus='200e9' poisson_ratio='0.3' density='8000'";
  const auto expect = [](const Workspace& place, const std::string& arguments,
                         const std::string& what) {
    const CommandResult r =
        place.limber("static s.toml --cache c --out o " + arguments);
    EXPECT_EQ(r.status, 2);
    EXPECT_THAT(r.errors, HasSubstr(what));
    EXPECT_THAT(r.errors, HasSubstr("own"));
  };
  const Workspace steel;
  write_bar(steel, isotropic, "material");
  expect(steel, "", "depends on direction");
  const Workspace layered;
  write_bar(layered, kFibres + std::string("axis_1='1 0 0' axis_2='0 1 0'"),
            "layer");
  expect(layered, "", "axes = 'layer'");
  expect(layered, "--set probe.own.axes=material --fidelity full",
         "not available at level full");
  expect(layered, "--set probe.own.axes=mesh", "axes");
}

}  // namespace
}  // namespace limber::test::material_axes_test
