// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/contact_patches.hpp"
#include "limber/reduction/contact_residual.hpp"
#include "limber/reduction/reduce.hpp"
#include "places.hpp"
#include "unit/reduction/bar.hpp"

/// Contact surfaces of a bar of 200 x 20 x 10 mm.
namespace limber::flexbody::contact_surface_test {
namespace {

using ::testing::AllOf;
using testing::Bar;
using ::testing::HasSubstr;
using testing::make_recipe;

const fem::ElasticMaterial kSteel{210e9, 0.3, 7850.0};

Bar make_bar(int order, bool is_clamped) {
  return {
      .size = {0.1, 0.04, 0.03},
      .cells = 10,
      .order = order,
      .material = {kSteel.youngs_modulus, kSteel.poisson_ratio, kSteel.density},
      .is_clamped = is_clamped};
}

Recipe make_contact_recipe(int order, bool is_clamped = false) {
  Recipe recipe = make_recipe(make_bar(order, is_clamped));
  recipe.basis.eigenmodes = 6;
  recipe.basis.interface_modes = false;
  recipe.contact_groups = {"tip", "skin"};
  return recipe;
}

const ReducedBody& free_bar() {
  static const ReducedBody body = reduce(make_contact_recipe(2));
  return body;
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

TEST(ContactSurface, HasThePlacesAndTagsOfTheMeshsNodes) {
  ASSERT_EQ(free_bar().contact_surfaces.size(), 2U);
  const NodeRows& rows = free_bar().rows;  // of the whole boundary
  const ContactSurface& tip = free_bar().contact_surfaces[0];
  const ContactSurface& mesh_surface = free_bar().contact_surfaces[1];
  EXPECT_EQ(tip.name, "tip");
  EXPECT_EQ(mesh_surface.name, "skin");
  EXPECT_EQ(tip.tags.size(), 9U);
  EXPECT_EQ(tip.faces.size(), 2U);
  EXPECT_EQ(mesh_surface.tags.size(), rows.tags.size());
  EXPECT_EQ(
      std::set<std::size_t>(mesh_surface.tags.begin(), mesh_surface.tags.end())
          .size(),
      mesh_surface.tags.size());
  for (const ContactSurface& surface : free_bar().contact_surfaces) {
    for (std::size_t i = 0; i < surface.tags.size(); ++i) {
      const auto row =
          static_cast<Eigen::Index>(find_row(free_bar(), surface.tags[i]));
      EXPECT_EQ(Vector3(surface.x_B.col(static_cast<Eigen::Index>(i))),
                Vector3(rows.x_B.col(row)));
    }
    EXPECT_EQ(surface.youngs_modulus, kSteel.youngs_modulus);
    EXPECT_EQ(surface.poisson_ratio, kSteel.poisson_ratio);
  }
}

TEST(ContactSurface, BetweenCornersHasTheirMeanResidual) {
  EXPECT_GT(free_bar().contact_surfaces[1].residual.maxCoeff(), 0.0);
  for (const ContactSurface& surface : free_bar().contact_surfaces) {
    EXPECT_GT(surface.patch_radius.minCoeff(), 0.0);
    for (const auto& face : surface.faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(surface.residual[face[3 + k]],
                  0.5 * (surface.residual[face[k]] +
                         surface.residual[face[(k + 1) % 3]]));
      }
    }
  }
}

/// Mirror images of the bar are the bar; its mesh, too.
TEST(ContactSurface, IsAsSymmetricAsTheBody) {
  const ContactSurface& mesh_surface = free_bar().contact_surfaces[1];
  const auto find = [&](const Vector3& x) {
    Eigen::Index nearest = 0;
    (mesh_surface.x_B.colwise() - x).colwise().norm().minCoeff(&nearest);
    EXPECT_LT((mesh_surface.x_B.col(nearest) - x).norm(), 1e-9);
    return nearest;
  };
  const auto is_corner = [&](Eigen::Index i) {
    return std::any_of(mesh_surface.faces.begin(), mesh_surface.faces.end(),
                       [&](const auto& face) {
                         return std::find(face.begin(), face.begin() + 3, i) !=
                                face.begin() + 3;
                       });
  };
  for (Eigen::Index i = 0; i < mesh_surface.residual.size(); ++i) {
    if (!is_corner(i)) continue;  // the diagonals are not symmetric
    for (int axis = 0; axis < 3; ++axis) {
      Vector3 mirrored = mesh_surface.x_B.col(i);
      mirrored[axis] *= -1.0;
      EXPECT_NEAR(
          mesh_surface.residual[find(mirrored)], mesh_surface.residual[i],
          1e-6 * calc_hertz_fraction(kSteel, mesh_surface.patch_radius[i]));
    }
  }
}

/// Against the converged inverse. One shifted solution errs by the square of
/// the shift's fraction in the first eigenvalue, about 1 %.
TEST(ContactSurface, OfABodyWithoutModesHasAllFlexibilityButHertzsShare) {
  const Recipe recipe = make_contact_recipe(2);
  const MeshedBody body(recipe, {});
  const MatrixX nothing(body.support.matrices.dof_count(), 0);
  const ContactSurface mesh_surface = make_contact_surfaces(
      body, recipe, {VectorX(0), nothing}, nothing, Vector3::Zero(), {})[1];
  EXPECT_EQ(mesh_surface.Phi_B.cols(), 0);
  const fem::Surface surface =
      fem::make_surface(body.mesh, body.mesh.boundary_faces);
  const std::vector<ContactPatch> patches =
      find_patches(body.mesh, surface, find_normals(body.mesh, surface),
                   mesh_surface.patch_radius);
  for (std::size_t p = 0; p < 20; p += 3) {
    ASSERT_TRUE(surface.points[p].is_corner());
    VectorX f = VectorX::Zero(body.support.matrices.dof_count());
    for (std::size_t i = 0; i < patches[p].nodes.size(); ++i) {
      f.segment<3>(3 * patches[p].nodes[i]) =
          patches[p].weights[static_cast<Eigen::Index>(i)] * patches[p].normal;
    }
    const double whole = f.dot(body.inverse.solve(f).col(0));
    const auto n = static_cast<Eigen::Index>(p);
    const double rest =
        whole - calc_hertz_fraction(kSteel, mesh_surface.patch_radius[n]);
    EXPECT_NEAR(mesh_surface.residual[n], rest, 2e-4 * whole);
  }
}

TEST(ContactSurface, ChangesNothingElseOfTheBody) {
  Recipe recipe = make_contact_recipe(2);
  recipe.contact_groups.clear();
  const ReducedBody plain = reduce(recipe);
  EXPECT_TRUE(plain.contact_surfaces.empty());
  EXPECT_EQ(plain.lambda, free_bar().lambda);
  EXPECT_EQ(plain.rows.Phi_B, free_bar().rows.Phi_B);
  EXPECT_EQ(plain.mass, free_bar().mass);
}

TEST(ContactSurface, OnAClampIsRigid) {
  Recipe recipe = make_contact_recipe(2, true);
  recipe.contact_groups = {"root"};
  const ReducedBody body = reduce(recipe);
  const ContactSurface& root = body.contact_surfaces[0];
  EXPECT_EQ(root.Phi_B.norm(), 0.0);
  // What Hertz's law would supply is taken away.
  for (Eigen::Index i = 0; i < root.residual.size(); ++i) {
    EXPECT_NEAR(root.residual[i],
                -calc_hertz_fraction(kSteel, root.patch_radius[i]),
                1e-12 * std::abs(root.residual[i]));
  }
}

class ContactSurfaceOfOrder : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Orders, ContactSurfaceOfOrder,
                         ::testing::Values(1, 3));

/// First-order faces are straight; third-order ones have points without nodes.
TEST_P(ContactSurfaceOfOrder, HasMiddlesFromSecondOrderOn) {
  const ReducedBody body = reduce(make_contact_recipe(GetParam()));
  for (const ContactSurface& surface : body.contact_surfaces) {
    const auto n = static_cast<Eigen::Index>(surface.tags.size());
    ASSERT_EQ(surface.x_B.cols(), n);
    ASSERT_EQ(surface.Phi_B.rows(), 3 * n);
    ASSERT_EQ(surface.residual.size(), n);
    ASSERT_EQ(surface.patch_radius.size(), n);
    for (const auto& face : surface.faces) {
      const bool is_straight = GetParam() == 1;
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NE(surface.tags[at(face[k])], 0U);
        if (is_straight) {
          EXPECT_EQ(face[3 + k], -1);
        } else {
          EXPECT_EQ(surface.tags[at(face[3 + k])], 0U);
          EXPECT_LT((surface.x_B.col(face[3 + k]) -
                     0.5 * (surface.x_B.col(face[k]) +
                            surface.x_B.col(face[(k + 1) % 3])))
                        .norm(),
                    1e-12);
        }
      }
    }
  }
}

std::string error_of(const std::vector<std::string>& names) {
  static const fem::Mesh mesh =
      fem::read_mesh(LIMBER_SOURCE_DIR "/tests/data/beam/beam579_v41.msh");
  try {
    (void)find_contact_groups(mesh, names, {mesh.volume_groups.size(), kSteel});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ContactGroups, ThatDoNotFitAreNamed) {
  EXPECT_EQ(error_of({"tip", "skin"}), "");
  EXPECT_THAT(error_of({"tipp"}),
              AllOf(HasSubstr("beam579_v41.msh"), HasSubstr("'tipp'"),
                    HasSubstr("did you mean 'tip'")));
  EXPECT_THAT(error_of({"tip", "tip"}), HasSubstr("'tip' is named twice"));
}

TEST(ContactGroups, WithoutFacesOnTheSurfaceAreRefusedBeforeLongWork) {
  Recipe recipe = make_contact_recipe(1);
  recipe.contact_groups = {"bar"};  // the volume
  try {
    const MeshedBody body(recipe, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("contact group 'bar' (dimension 3) has no "
                                "faces on the body's surface"),
                      HasSubstr("'root', 'tip', 'top', or 'skin'")));
  }
}

TEST(ContactGroups, OfSeveralMaterialsAreRefused) {
  const MeshedBody body(make_contact_recipe(1), {});
  fem::Mesh mesh = body.mesh;
  mesh.volume_groups.push_back(mesh.volume_groups[0]);
  std::fill(mesh.blocks[0].regions.begin() + 1, mesh.blocks[0].regions.end(),
            1);
  fem::ElasticMaterial other = kSteel;
  other.density *= 2.0;
  EXPECT_NO_THROW((void)find_contact_groups(mesh, {"skin"}, {kSteel, other}));
  other.poisson_ratio = 0.2;
  EXPECT_THROW((void)find_contact_groups(mesh, {"skin"}, {kSteel, other}),
               InputError);
  EXPECT_NO_THROW((void)find_contact_groups(mesh, {"tip"}, {kSteel, other}));
}

TEST(ContactGroups, CalledSkinMustBeTheWhole) {
  const MeshedBody body(make_contact_recipe(1), {});
  fem::Mesh mesh = body.mesh;
  mesh.groups[fem::find_group(mesh, "tip")].name = "skin";
  EXPECT_THROW((void)find_contact_groups(mesh, {"skin"}, {kSteel}), InputError);
  EXPECT_NO_THROW((void)find_contact_groups(body.mesh, {"skin"}, {kSteel}));
}

}  // namespace
}  // namespace limber::flexbody::contact_surface_test
