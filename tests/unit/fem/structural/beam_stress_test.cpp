// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/common/rotation.hpp"
#include "unit/fem/structural/shell_grid.hpp"

/// Section forces of beams and stress in their sections.
namespace limber::fem::structural_test {
namespace {

const Matrix3 kBeamAxes = exp_rotation(Vector3(0.4, -0.7, 0.3));

/// One beam along an oblique axis, held at its first end, off its nodes.
struct LoadedBeam {
  Structure structure;
  Matrix3 axes;
  Vector6 first;  ///< N, Vy, Vz, T, My, Mz
  Vector6 second;
  VectorX stress;  ///< at the points of the outline
};

/// @param force, moment on the second end, in the beam's axes
LoadedBeam load_beam(const BeamSection& section, const Vector3& force,
                     const Vector3& moment) {
  LoadedBeam beam;
  Structure& s = beam.structure;
  s.tags = {1, 2};
  const Vector3 offset(0.02, -0.03, 0.05);
  const Vector3 x = kBeamAxes.col(0);
  s.x.resize(3, 2);
  s.x << Vector3(0.3, 0.1, -0.2), Vector3(0.3, 0.1, -0.2) + 2.0 * x;
  s.beam_properties = {{section, {2e11, 8e10, 7800.0}}};
  s.beams = {{{0, 1}, 0, kBeamAxes.col(1), {offset, offset}, "here", 7}};
  beam.axes = kBeamAxes;
  Matrix6X f = Matrix6X::Zero(6, 2);
  const Vector3 F = kBeamAxes * force;
  f.col(1) << F,
      kBeamAxes * moment + offset.cross(F);  // at the end of the axis
  const Vector3 held = s.x.col(0);
  const Matrix6X u = solve_static(
      s, f, [&](const Vector3& at, int) { return (at - held).norm() < 1e-9; });
  const SectionStress stress = recover(s, u);
  beam.first = stress.forces.col(0).head<6>();
  beam.second = stress.forces.col(0).tail<6>();
  beam.stress = stress.stress.col(0);
  EXPECT_EQ(stress.ends[1].element, 7U);
  return beam;
}

TEST(SectionForces, AreThoseOfACantilever) {
  const BeamSection section = make_rectangle(0.1, 0.04, 0.25);
  const Vector3 F(1000.0, 200.0, -300.0);
  const Vector3 M(40.0, 50.0, 60.0);
  const LoadedBeam beam = load_beam(section, F, M);
  Vector6 second;
  second << F, M;
  EXPECT_LT((beam.second - second).norm(), 1e-6 * second.norm());
  // The arm of 2 m along x: My + 2 x (-Fz)..., r x F = (0, -2 Fz, 2 Fy).
  Vector6 first = second;
  first[4] -= 2.0 * F[2];
  first[5] += 2.0 * F[1];
  EXPECT_LT((beam.first - first).norm(), 1e-6 * first.norm());
}

/// At the corners of a rectangle N / A + M c / I, with the largest shear stress
/// of torsion, T / (0.267 a b^2) of a / b = 3 (Timoshenko and Goodier).
TEST(SectionForces, GiveTheStressAtCorners) {
  const double a = 0.12;
  const double b = 0.04;
  const LoadedBeam beam =
      load_beam(make_rectangle(a, b, 0.25), Vector3(1000.0, 200.0, -300.0),
                Vector3(40.0, 50.0, 60.0));
  const double My = beam.first[4];
  const double Mz = beam.first[5];
  const auto normal = [&](double y, double z) {
    return 1000.0 / (a * b) + My * z / (a * b * b * b / 12.0) -
           Mz * y / (b * a * a * a / 12.0);
  };
  const double torsion = 40.0 / (0.267 * a * b * b);
  // Corners (-,-), (+,-), (+,+), (-,+) of the first end.
  const double y[] = {-0.06, 0.06, 0.06, -0.06};
  const double z[] = {-0.02, -0.02, 0.02, 0.02};
  for (int k = 0; k < 4; ++k) {
    const Vector6 s = beam.stress.segment<6>(6 * k);
    Matrix3 t;
    t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const Matrix3 local = beam.axes.transpose() * t * beam.axes;
    EXPECT_NEAR(local(0, 0), normal(y[k], z[k]),
                1e-6 * std::abs(normal(0.06, 0.02)));
    EXPECT_NEAR(std::hypot(local(0, 1), local(0, 2)), torsion, 2e-3 * torsion);
    EXPECT_NEAR(local(1, 1), 0.0, 1e-3);
  }
}

TEST(SectionForces, GiveTheShearStressOfAShaft) {
  const LoadedBeam beam = load_beam(make_tube(0.03, 0.02, 0.3), Vector3::Zero(),
                                    Vector3(500, 0, 0));
  const double J = 0.5 * M_PI * (std::pow(0.03, 4) - std::pow(0.02, 4));
  for (int k = 0; k < 24; ++k) {
    const Vector6 s = beam.stress.segment<6>(6 * k);
    const double mises =
        std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) +
                         std::pow(s[2] - s[0], 2)) +
                  3.0 * s.tail<3>().squaredNorm());
    EXPECT_NEAR(mises, std::sqrt(3.0) * 500.0 * 0.03 / J,
                1e-8 * 500.0 * 0.03 / J);
  }
}

/// Shear stress [xy, xz] in the beam's axes at a point of its first end.
Eigen::Vector2d find_shear(const LoadedBeam& beam, Eigen::Index point) {
  const Vector6 s = beam.stress.segment<6>(6 * point);
  Matrix3 t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return (beam.axes.transpose() * t * beam.axes).row(0).tail<2>().transpose();
}

const Vector3 kShearForce(0.0, 200.0, -300.0);

/// 3/2 V / A in the middle of the sides and in the middle, none at corners.
TEST(SectionForces, GiveTheShearStressOfARectangle) {
  const double a = 0.12;
  const double b = 0.04;
  const LoadedBeam beam =
      load_beam(make_rectangle(a, b, 0.25), kShearForce, Vector3::Zero());
  ASSERT_EQ(beam.stress.size(), 2 * 6 * 9);
  const double y = 1.5 * 200.0 / (a * b);
  const double z = -1.5 * 300.0 / (a * b);
  const double small = 1e-6 * y;
  for (const int corner : {0, 1, 2, 3})
    EXPECT_LT(find_shear(beam, corner).norm(), small);
  for (const auto& [point, expected] : {std::pair{4, Eigen::Vector2d(y, 0)},
                                        {5, Eigen::Vector2d(0, z)},
                                        {6, Eigen::Vector2d(y, 0)},
                                        {7, Eigen::Vector2d(0, z)},
                                        {8, Eigen::Vector2d(y, z)}})
    EXPECT_LT((find_shear(beam, point) - expected).norm(), small) << point;
}

/// Thin: 2 V / A at the neutral axis; solid: 4/3 V / A; the sum over a thin
/// ring is the force.
TEST(SectionForces, GiveTheShearStressOfTubes) {
  const LoadedBeam thin =
      load_beam(make_tube(0.05, 0.0499, 0.3), kShearForce, Vector3::Zero());
  const double area = M_PI * (0.05 * 0.05 - 0.0499 * 0.0499);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int k = 0; k < 12; ++k) sum += area / 12.0 * find_shear(thin, k);
  EXPECT_LT((sum - kShearForce.tail<2>()).norm(), 0.004 * 200.0);
  EXPECT_NEAR(find_shear(thin, 3)[0], 2.0 * 200.0 / area, 1e-4 * 400.0 / area);
  EXPECT_NEAR(find_shear(thin, 0)[1], 2.0 * -300.0 / area, 1e-4 * 600.0 / area);
  const LoadedBeam solid =
      load_beam(make_tube(0.05, 0.0, 0.3), kShearForce, Vector3::Zero());
  const double y = 4.0 / 3.0 * 200.0 / (M_PI * 0.05 * 0.05);
  EXPECT_NEAR(find_shear(solid, 3)[0], y, 1e-6 * y);
  EXPECT_NEAR(find_shear(solid, 0)[0], 0.0, 1e-6 * y);
}

/// V Q / (I t) of the web, which with the vertical stress of the flanges,
/// V (h^2 / 4 - y^2) / (2 I), carries the force.
TEST(SectionForces, GiveTheShearStressOfTheWebOfAnI) {
  const LoadedBeam beam = load_beam(make_i_section(0.2, 0.1, 0.01, 0.006, 0.3),
                                    kShearForce, Vector3::Zero());
  const double I = (0.1 * 0.2 * 0.2 * 0.2 - 0.094 * 0.18 * 0.18 * 0.18) / 12.0;
  const double Q_flange = 0.1 * 0.01 * 0.095;
  const double Q = Q_flange + 0.006 * 0.09 * 0.045;
  const double middle = find_shear(beam, 4)[0];
  const double end = find_shear(beam, 5)[0];
  EXPECT_NEAR(middle, 200.0 * Q / (I * 0.006), 1e-6 * middle);
  EXPECT_NEAR(end, 200.0 * Q_flange / (I * 0.006), 1e-6 * middle);
  const double web = 0.006 * 0.18 * (end + 2.0 / 3.0 * (middle - end));
  const double flanges =
      200.0 * 0.1 / I *
      (0.1 * 0.1 * 0.01 - (std::pow(0.1, 3) - std::pow(0.09, 3)) / 3.0);
  EXPECT_NEAR(web + flanges, 200.0, 1e-3);
  // Flanges: 3/2 of their own area, and the flow to the web, of both signs.
  const double own = -1.5 * 300.0 / 0.002;
  const double flow = 200.0 * 0.05 * 0.095 / I;
  EXPECT_NEAR(find_shear(beam, 7)[1], own - flow, 1e-6 * middle);
  EXPECT_NEAR(find_shear(beam, 8)[1], own + flow, 1e-6 * middle);
}

/// Thin walls: the flow of a wall from corner to corner carries the force.
TEST(SectionForces, GiveTheShearStressOfABox) {
  for (const auto& [top, side] : {std::array{0.002, 0.001}, {0.001, 0.002}}) {
    const LoadedBeam beam = load_beam(make_box(0.2, 0.1, top, side, 0.3),
                                      kShearForce, Vector3::Zero());
    const double thinner = std::min(top, side);
    const double h = 0.2 - top;
    const double b = 0.1 - side;
    const Eigen::Vector2d corner = thinner * find_shear(beam, 2);  // flows
    const double along_y = side * find_shear(beam, 4)[0];
    const double along_z = top * find_shear(beam, 5)[1];
    const auto sum = [](double length, double at_end, double in_middle) {
      return 2.0 * length * (at_end + 2.0 / 3.0 * (in_middle - at_end));
    };
    EXPECT_NEAR(sum(h, corner[0], along_y), 200.0, 4.0);
    EXPECT_NEAR(sum(b, corner[1], along_z), -300.0, 6.0);
  }
}

TEST(SectionStress, OfASectionWithoutDimensionsIsNone) {
  BeamSection section = make_rectangle(0.1, 0.04, 0.25);
  section.points.clear();  // as of PBAR
  const LoadedBeam beam = load_beam(section, Vector3(1, 0, 0), Vector3::Zero());
  EXPECT_EQ(beam.stress.size(), 0);
  EXPECT_EQ(recover(beam.structure, Matrix6X::Zero(6, 2)).bare_beams, 1U);
  EXPECT_NEAR(beam.second[0], 1.0, 1e-9);
}

}  // namespace
}  // namespace limber::fem::structural_test
