// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/contact_patches.hpp"
#include "limber/reduction/contact_residual.hpp"
#include "support/temporary_folder.hpp"

/// The flexibility of a patch of given size on finer and finer meshes.
namespace limber::flexbody::contact_convergence_slow {
namespace {

const fem::ElasticMaterial kSteel{210e9, 0.3, 7850.0};

/// A box of steel in second-order cubes.
class Box {
 public:
  Box(const Vector3& size, double cell, const std::string& name)
      : size_(size), body_(make_recipe(size, cell, name), {}) {}

  /// Of patches of radii `b` amid the top, without modes [m/N].
  [[nodiscard]] VectorX calc_flexibility(const std::vector<double>& b) const {
    const auto groups = find_contact_groups(
        body_.mesh, {"top"}, {body_.mesh.volume_groups.size(), kSteel});
    fem::Surface top = fem::make_surface(body_.mesh, groups[0].faces);
    const Vector3 middle(0.5 * size_[0], 0.5 * size_[1], size_[2]);
    for (const fem::SurfacePoint& point : fem::Surface(top).points) {
      if ((point.x - middle).norm() < 1e-9) top.points = {point};
    }
    EXPECT_EQ(top.points.size(), 1U);
    std::vector<ContactPatch> patches;
    for (const double radius : b) {
      patches.push_back(find_patches(body_.mesh, top, Vector3::UnitZ(),
                                     VectorX::Constant(1, radius))[0]);
    }
    const MatrixX nothing(body_.support.matrices.dof_count(), 0);
    return calc_residual_flexibility(body_, {VectorX(0), nothing}, patches);
  }

 private:
  static Recipe make_recipe(const Vector3& size, double cell,
                            const std::string& name) {
    const auto layers = [&](int axis) {
      return std::lround(size[axis] / cell);
    };
    Recipe recipe;
    recipe.mesh.file = limber::test::own_folder() / name;
    std::ofstream(recipe.mesh.file) << fmt::format(
        "Point(1) = {{0, 0, 0}};\n"
        "l[] = Extrude {{0, {1}, 0}} {{ Point{{1}}; Layers{{{4}}}; }};\n"
        "s[] = Extrude {{{0}, 0, 0}} {{ Line{{l[1]}}; Layers{{{3}}}; "
        "Recombine; }};\n"
        "v[] = Extrude {{0, 0, {2}}} {{ Surface{{s[1]}}; Layers{{{5}}}; "
        "Recombine; }};\n"
        "Physical Surface(\"top\") = {{v[0]}};\n"
        "Physical Volume(\"box\") = {{v[1]}};\n",
        size[0], size[1], size[2], layers(0), layers(1), layers(2));
    recipe.mesh.order = 2;
    recipe.materials = {
        {"", {kSteel.youngs_modulus, kSteel.poisson_ratio, kSteel.density}}};
    return recipe;
  }

  Vector3 size_;
  MeshedBody body_;
};

/// A beam of 200 x 20 x 10 mm under a patch of 5 mm. By the principle of least
/// energy finer meshes are softer.
TEST(ContactConvergence, FlexibilityOfAPatchOfGivenSizeConverges) {
  const auto calc = [](double cell, const std::string& name) {
    return Box({0.2, 0.02, 0.01}, cell, name).calc_flexibility({5e-3})[0];
  };
  const double coarse = calc(0.01, "contact_beam_10.geo");
  const double fine = calc(0.005, "contact_beam_5.geo");
  const double finest = calc(0.01 / 3.0, "contact_beam_3.geo");
  EXPECT_GT(fine, coarse);
  EXPECT_GT(finest, fine);
  EXPECT_LT(finest - fine, 0.2 * (fine - coarse));
  EXPECT_LT((finest - fine) / fine, 0.01);
}

/// Of a block much larger than the patches, two of different size differ in
/// Hertz's shares alone (Saint-Venant): its ends are too far to tell them
/// apart.
TEST(ContactConvergence, PatchesOfABlockDifferByHertzsShares) {
  const double cell = 1e-3;
  const std::vector<double> b = {1.5 * cell, 2.5 * cell};
  const VectorX R =
      Box({0.012, 0.012, 0.008}, cell, "contact_block.geo").calc_flexibility(b);
  const double expected =
      calc_hertz_fraction(kSteel, b[0]) - calc_hertz_fraction(kSteel, b[1]);
  EXPECT_NEAR((R[0] - R[1]) / expected, 1.0, 0.03);
}

}  // namespace
}  // namespace limber::flexbody::contact_convergence_slow
