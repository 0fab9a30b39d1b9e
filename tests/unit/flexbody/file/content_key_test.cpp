// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "limber/flexbody/file/cache.hpp"
#include "unit/flexbody/file/small_recipe.hpp"

namespace limber::flexbody::test::content_key_test {
namespace {

using Changes =
    std::vector<std::pair<std::string, std::function<void(Recipe&)>>>;

Changes list_mesh_and_material_changes() {
  return {
      {"region", [](Recipe& r) { r.materials[0].group = "iron"; }},
      {"E", [](Recipe& r) { r.materials[0].material.youngs_modulus = 70e9; }},
      {"nu", [](Recipe& r) { r.materials[0].material.poisson_ratio = 0.31; }},
      {"rho", [](Recipe& r) { r.materials[0].material.density = 2700.0; }},
      {"second material",
       [](Recipe& r) {
         r.materials.push_back({"", {1e9, 0.0, 1.0}});
       }},
      {"no material", [](Recipe& r) { r.materials.clear(); }},
      {"clamped", [](Recipe& r) { r.clamped_groups[0] = "bases"; }},
      {"second clamped",
       [](Recipe& r) {
         r.clamped_groups = {"ba", "se"};
       }},
      {"none clamped", [](Recipe& r) { r.clamped_groups.clear(); }},
  };
}

Changes list_interface_changes() {
  const auto select = [](const NodeSelection& nodes) {
    return [nodes](Recipe& r) { r.interfaces[0].nodes = nodes; };
  };
  const Vector3 p(1.0, 2.0, 3.0);
  const Vector3 q(1.0, 2.0, 4.0);
  return {
      {"interface", [](Recipe& r) { r.interfaces[0].name = "foot"; }},
      {"weighting",
       [](Recipe& r) { r.interfaces[0].weighting = Weighting::equal; }},
      {"static modes", [](Recipe& r) { r.interfaces[0].static_modes = false; }},
      {"group", select(GroupNodes{"other"})},
      {"tag 1", select(TaggedNode{1})},
      {"tag 2", select(TaggedNode{2})},
      {"nearest p", select(NearestNode{p})},
      {"nearest q", select(NearestNode{q})},
      {"box p q", select(BoxNodes{p, q})},
      {"box q p", select(BoxNodes{q, p})},
      {"plane", select(PlaneNodes{p, q.normalized(), 0.0})},
      {"plane elsewhere", select(PlaneNodes{q, q.normalized(), 0.0})},
      {"plane turned", select(PlaneNodes{p, p.normalized(), 0.0})},
      {"plane widened", select(PlaneNodes{p, q.normalized(), 0.1})},
      {"cylinder", select(CylinderNodes{p, q, 1.0, 0.0})},
      {"cylinder backwards", select(CylinderNodes{q, p, 1.0, 0.0})},
      {"cylinder longer", select(CylinderNodes{p, 2.0 * q, 1.0, 0.0})},
      {"cylinder widened", select(CylinderNodes{p, q, 1.5, 0.0})},
      {"tube", select(CylinderNodes{p, q, 1.0, 0.5})},
      {"second interface",
       [](Recipe& r) {
         r.interfaces.push_back({"tip", GroupNodes{"tip"}});
       }},
      {"no interface", [](Recipe& r) { r.interfaces.clear(); }},
  };
}

Changes list_load_and_basis_changes() {
  return {
      {"loaded", [](Recipe& r) { r.load_patterns[0].interface = "tip"; }},
      {"force", [](Recipe& r) { r.load_patterns[0].force[2] = 3.5; }},
      {"moment", [](Recipe& r) { r.load_patterns[0].moment[0] = 4.5; }},
      {"second load",
       [](Recipe& r) { r.load_patterns.push_back(r.load_patterns[0]); }},
      {"no load", [](Recipe& r) { r.load_patterns.clear(); }},
      {"eigenmodes", [](Recipe& r) { r.basis.eigenmodes = 11; }},
      {"interface modes", [](Recipe& r) { r.basis.interface_modes = false; }},
      {"load modes", [](Recipe& r) { r.basis.load_modes = false; }},
      {"terms", [](Recipe& r) { r.basis.terms = 2; }},
      {"tolerance", [](Recipe& r) { r.basis.drop_tolerance = 1e-9; }},
      {"all rows", [](Recipe& r) { r.rows = parse_rows({"all"}); }},
      {"few rows", [](Recipe& r) { r.rows = parse_rows({"interfaces"}); }},
      {"a group's rows", [](Recipe& r) { r.rows = parse_rows({"side"}); }},
      {"contact", [](Recipe& r) { r.contact_groups = {"side"}; }},
      {"contact of all", [](Recipe& r) { r.contact_groups = {"skin"}; }},
      {"contact twice",
       [](Recipe& r) {
         r.contact_groups = {"si", "de"};
       }},
  };
}

Changes list_automatic_changes() {
  const auto choose = [](const AutomaticModes& automatic) {
    return [automatic](Recipe& r) { r.basis.automatic = automatic; };
  };
  const auto force = [](const NodalForces& forces) {
    return [forces](Recipe& r) { r.nodal_forces = {forces}; };
  };
  const MatrixX row = MatrixX::Ones(1, 2);
  return {
      {"automatic", choose({})},
      {"threshold", choose({0.8})},
      {"measure", choose({0.9, ModeMeasure::report})},
      {"candidates", choose({0.9, ModeMeasure::compliance, 61})},
      {"case alone", [](Recipe& r) { r.load_patterns[0].static_mode = false; }},
      {"forces", force({"f", {0.0, 1.0}, row})},
      {"other forces", force({"f", {0.0, 1.0}, 2.0 * row})},
      {"forces at other times", force({"f", {0.0, 2.0}, row})},
      {"forces of another name", force({"g", {0.0, 1.0}, row})},
      {"displacement",
       [](Recipe& r) { r.initial_displacement.values = VectorX::Ones(3); }},
      {"velocity",
       [](Recipe& r) { r.initial_velocity.values = VectorX::Ones(3); }},
      {"another velocity",
       [](Recipe& r) { r.initial_velocity.values = VectorX::Zero(3); }},
      {"forces of another shape", force({"f", {0.0}, row.transpose()})},
  };
}

TEST(ContentKey, DiffersForEveryFieldThatShapesTheBody) {
  std::map<std::string, std::string> change_of = {
      {content_key(make_recipe("arm.msh"), "mesh"), "nothing"},
      {content_key(make_recipe("arm.msh"), "other mesh"), "mesh"}};
  for (const Changes& changes :
       {list_mesh_and_material_changes(), list_interface_changes(),
        list_load_and_basis_changes(), list_automatic_changes()}) {
    for (const auto& [name, change] : changes) {
      Recipe recipe = make_recipe("arm.msh");
      change(recipe);
      const auto [at, is_new] =
          change_of.emplace(content_key(recipe, "mesh"), name);
      EXPECT_TRUE(is_new) << name << " and " << at->second;
    }
  }
}

TEST(ContentKey, IgnoresTheBodysNameAndHowTheMeshWasMade) {
  Recipe other = make_recipe("elsewhere.geo");
  other.name = "fore arm";
  other.mesh.size = 0.3;
  EXPECT_EQ(content_key(make_recipe("arm.msh"), "mesh"),
            content_key(other, "mesh"));
}

TEST(RecipeKey, IsOneForAskersOfOneFileInOneWay) {
  const Recipe recipe = make_recipe("arm.msh");
  Recipe same = recipe;
  same.name = "fore arm";
  EXPECT_EQ(recipe_key(recipe), recipe_key(same));
  const std::vector<std::function<void(Recipe&)>> changes = {
      [](Recipe& r) { r.mesh.file = "arm.geo"; },
      [](Recipe& r) { r.mesh.size = 0.2; }, [](Recipe& r) { r.mesh.order = 1; },
      [](Recipe& r) { r.mesh.unit = 1.0; },
      [](Recipe& r) { r.basis.eigenmodes = 11; }};
  for (const auto& change : changes) {
    Recipe other = recipe;
    change(other);
    EXPECT_NE(recipe_key(recipe), recipe_key(other));
  }
}

}  // namespace
}  // namespace limber::flexbody::test::content_key_test
