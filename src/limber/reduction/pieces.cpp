// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/pieces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/mesh/surface.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/meshed_body.hpp"

namespace limber::flexbody {
namespace {

void check_recipe(const Recipe& recipe) {
  std::vector<std::string> problems;
  const auto refuse = [&](const std::string& what) {
    problems.push_back(what +
                       ", which is of the whole mesh: leave it in one piece");
  };
  for (const NodalForces& nodal : recipe.nodal_forces) {
    refuse(fmt::format("it has a file of nodal forces, {}", nodal.name));
  }
  for (const NodalField* field :
       {&recipe.initial_displacement, &recipe.initial_velocity}) {
    if (field->values.size() == 0) continue;
    refuse(fmt::format("it has an initial field, {}", field->name));
  }
  for (const InterfaceRequest& request : recipe.interfaces) {
    if (!is_cut(request.name)) continue;
    problems.push_back(fmt::format(
        "interface '{}': names that begin with '{}' are those where pieces "
        "meet; rename it",
        request.name, kCutPrefix));
  }
  if (!problems.empty()) throw InputError(problems);
}

/// Names that no piece has would be missing in each.
void check_names(const fem::Mesh& whole, const Recipe& recipe,
                 const std::vector<Interface>& interfaces) {
  for (const auto* names : {&recipe.clamped_groups, &recipe.rows.groups}) {
    for (const std::string& name : *names) {
      static_cast<void>(fem::find_group(whole, name));
    }
  }
  static_cast<void>(find_contact_groups(whole, recipe.contact_groups,
                                        find_materials(whole, recipe)));
  for (const LoadPattern& pattern : recipe.load_patterns) {
    LIMBER_EXPECT(std::any_of(interfaces.begin(), interfaces.end(),
                              [&](const Interface& interface) {
                                return interface.name == pattern.interface;
                              }));
  }
}

/// Nodes of the piece, or nothing if it lacks one of them.
std::vector<int> find_nodes(const fem::MeshPiece& piece,
                            const std::vector<int>& nodes) {
  std::vector<int> found;
  for (const int node : nodes) {
    const int here = piece.find(node);
    if (here < 0) return {};
    found.push_back(here);
  }
  return found;
}

/// The first piece that has all of an interface's nodes.
int find_owner(const fem::CutMesh& cut, const Interface& interface) {
  const std::vector<int>& nodes = interface.selection.nodes;
  std::vector<std::size_t> touched;
  for (std::size_t p = 0; p < cut.pieces.size(); ++p) {
    const fem::MeshPiece& piece = cut.pieces[p];
    if (!find_nodes(piece, nodes).empty()) return static_cast<int>(p);
    if (std::any_of(nodes.begin(), nodes.end(),
                    [&](int node) { return piece.find(node) >= 0; })) {
      touched.push_back(p + 1);
    }
  }
  throw InputError(fmt::format(
      "interface '{}' reaches over pieces {} of {}. What acts on a link or is "
      "measured there must be on one piece: select fewer nodes, or cut it into "
      "another number of pieces",
      interface.name, fmt::join(touched, " and "), cut.pieces.size()));
}

Interface place_on(const fem::MeshPiece& piece, const std::string& name,
                   bool static_modes, const fem::WeightedNodes& selection) {
  const std::vector<int> nodes = find_nodes(piece, selection.nodes);
  const double size = piece.mesh.size().maxCoeff();
  return {name,
          static_modes,
          {nodes, selection.weights, selection.moments},
          InterfaceMotion(nodes, selection.weights, selection.moments,
                          piece.mesh.x, size)};
}

std::string name_cut(const fem::MeshCut& cut, int number) {
  std::string name =
      fmt::format("{}{}-{}", kCutPrefix, cut.first + 1, cut.second + 1);
  if (number > 1) name += fmt::format(".{}", number);
  return name;
}

std::vector<Interface> find_own(const fem::CutMesh& cut, int index_of_piece,
                                const std::vector<Interface>& all,
                                bool static_modes) {
  const fem::MeshPiece& piece = cut.pieces[index(index_of_piece)];
  std::vector<Interface> own;
  std::vector<std::string> problems;
  for (const Interface& interface : all) {
    try {
      if (find_owner(cut, interface) != index_of_piece) continue;
    } catch (const InputError& error) {
      problems.push_back(error.problems().front());
      continue;
    }
    own.push_back(place_on(piece, interface.name,
                           interface.static_modes && static_modes,
                           interface.selection));
  }
  if (!problems.empty()) throw InputError(problems);
  std::map<std::pair<int, int>, int> numbers;
  for (const fem::MeshCut& one : cut.cuts) {
    const int number = ++numbers[{one.first, one.second}];
    if (one.first != index_of_piece && one.second != index_of_piece) continue;
    own.push_back(place_on(piece, name_cut(one, number), true, one.selection));
  }
  return own;
}

bool has_faces(const fem::Mesh& mesh, const std::string& group) {
  if (group == kWholeSurface) return !mesh.boundary_faces.empty();
  for (const fem::PhysicalGroup& known : mesh.groups) {
    if (known.name == group) return !fem::find_group_faces(mesh, known).empty();
  }
  return false;
}

/// The recipe restricted to the content of its piece.
Recipe restrict_recipe(const Recipe& recipe, const fem::Mesh& mesh,
                       const std::vector<Interface>& interfaces) {
  Recipe own = recipe;
  std::set<std::string> groups;
  for (const fem::PhysicalGroup& group : mesh.groups) groups.insert(group.name);
  std::set<std::string> names;
  for (const Interface& interface : interfaces) names.insert(interface.name);
  const auto is_elsewhere = [&](const std::string& group) {
    return !groups.contains(group);
  };
  std::erase_if(own.clamped_groups, is_elsewhere);
  std::erase_if(own.rows.groups, is_elsewhere);
  std::erase_if(own.contact_groups, [&](const std::string& group) {
    return !has_faces(mesh, group);
  });
  std::erase_if(own.load_patterns, [&](const LoadPattern& pattern) {
    return !names.contains(pattern.interface);
  });
  // Those of the cuts always enter; others had it in their own flags.
  own.basis.interface_modes = true;
  return own;
}

}  // namespace

Pieces::Pieces(std::shared_ptr<const fem::TracedMesh> whole)
    : whole_(std::move(whole)) {}

const fem::CutMesh& Pieces::get_cut(int count) {
  const auto known = cuts_.find(count);
  if (known != cuts_.end()) return known->second;
  return cuts_.emplace(count, fem::cut_mesh(whole_->mesh, count)).first->second;
}

PieceAdvice Pieces::advise() const {
  const fem::PieceAdvice advice = fem::advise_pieces(whole_->mesh);
  return {advice.count, advice.reason};
}

PieceOfMesh Pieces::take(const Recipe& recipe, const Piece& piece) {
  check_recipe(recipe);
  const std::vector<Interface> all = find_interfaces(whole_->mesh, recipe);
  check_names(whole_->mesh, recipe, all);
  const fem::CutMesh& cut = get_cut(piece.count);
  PieceOfMesh taken;
  auto mesh = std::make_shared<fem::TracedMesh>();
  mesh->mesh = cut.pieces.at(index(piece.index)).mesh;
  mesh->notices = whole_->notices;
  mesh->files = whole_->files;
  mesh->is_repeatable = whole_->is_repeatable;
  taken.interfaces =
      find_own(cut, piece.index, all, recipe.basis.interface_modes);
  taken.recipe = restrict_recipe(recipe, mesh->mesh, taken.interfaces);
  taken.mesh = std::move(mesh);
  return taken;
}

}  // namespace limber::flexbody
