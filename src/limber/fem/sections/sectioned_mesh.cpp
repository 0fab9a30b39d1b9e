// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/sections/sectioned_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_file_kind.hpp"
#include "limber/fem/mesh/mesher.hpp"
#include "limber/fem/mesh/volume_names.hpp"
#include "limber/fem/sections/element_parts.hpp"

namespace limber::fem {
namespace {

constexpr const char* kPlural[] = {"points", "curves", "surfaces", "volumes"};

/// A region of either kind, for messages.
struct RegionName {
  const char* tag;
  std::string group;

  [[nodiscard]] std::string text() const {
    return group.empty() ? fmt::format("<{}> without group", tag)
                         : fmt::format("<{}> of group '{}'", tag, group);
  }
};

/// Elements of a dimension by their tag, and the region of each.
struct Part {
  int dimension = 0;
  std::vector<RegionName> regions;
  std::map<std::size_t, std::pair<const ElementBlock*, std::size_t>> elements;
  std::map<std::size_t, int> region_of;
};

class Sectioner {
 public:
  Sectioner(const Mesh& mesh, const MeshSections& sections)
      : mesh_(mesh), sections_(sections) {}

  SectionedMesh assign() {
    structure_.source = mesh_.source;
    structure_.tags = mesh_.tags;
    structure_.x = mesh_.x;
    Part curves = find_part(1, sections_.beams, "beam");
    Part surfaces = find_part(2, sections_.shells, "shell");
    find_properties();
    check_materials();
    raise();
    add_beams(curves);
    add_shells(surfaces);
    check_all_used({&curves, &surfaces});
    check_normals();
    raise();
    for (const PhysicalGroup& group : mesh_.groups)
      if (!group.name.empty())
        structure_.sets.push_back({group.name, group.nodes});
    structure_.has_solids = !mesh_.blocks.empty();
    structure_.found.push_back(
        fmt::format("{}: {} beams, {} shells, {} solids", mesh_.source,
                    structure_.beams.size(), structure_.shells.size(),
                    mesh_.element_count()));
    StructureSolids solids = take_solids();
    return {std::move(structure_), std::move(solids), {}, false};
  }

 private:
  void add_problem(const std::string& text) {
    problems_.push_back(fmt::format("{}: {}", mesh_.source, text));
  }

  void raise() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

  template <typename Region>
  Part find_part(int dimension, const std::vector<Region>& regions,
                 const char* tag) {
    Part part;
    part.dimension = dimension;
    for (const PhysicalGroup& group : mesh_.groups) {
      if (!group.name.empty() || group.dimension != dimension) continue;
      for (const ElementBlock& block : group.blocks)
        for (std::size_t e = 0; e < block.size(); ++e)
          part.elements[block.tags[e]] = {&block, e};
    }
    for (const Region& region : regions)
      part.regions.push_back({tag, region.group});
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (!regions[r].group.empty()) claim_group(static_cast<int>(r), part);
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (regions[r].group.empty()) claim_rest(static_cast<int>(r), part);
    return part;
  }

  void claim_group(int region, Part& part) {
    const RegionName& name = part.regions[index(region)];
    std::vector<std::string> known;
    const PhysicalGroup* found = nullptr;
    const PhysicalGroup* other = nullptr;
    for (const PhysicalGroup& group : mesh_.groups) {
      if (group.dimension == part.dimension && !group.name.empty())
        known.push_back(group.name);
      if (group.name != name.group) continue;
      (group.dimension == part.dimension ? found : other) = &group;
    }
    if (found == nullptr) {
      const char* wanted = kPlural[part.dimension];
      add_problem(
          other != nullptr
              ? fmt::format("{}: it is a group of {}. Expected one of {}.",
                            name.text(), kPlural[other->dimension], wanted)
              : fmt::format(
                    "<{}>: {}. Expected a physical group of {}.", name.tag,
                    describe_unknown("group", name.group, known), wanted));
      return;
    }
    for (const ElementBlock& block : found->blocks)
      for (const std::size_t tag : block.tags) {
        const auto [at, is_new] = part.region_of.emplace(tag, region);
        if (is_new) continue;
        add_problem(fmt::format("element {} has a {} and a {}. Expected one.",
                                tag, part.regions[index(at->second)].text(),
                                name.text()));
        return;
      }
  }

  void claim_rest(int region, Part& part) {
    const bool is_alone =
        mesh_.blocks.empty() &&
        (part.dimension == 2 ||
         std::ranges::none_of(mesh_.groups, [](const PhysicalGroup& group) {
           return group.dimension == 2;
         }));
    const std::string name = part.regions[index(region)].text();
    if (!is_alone) {
      add_problem(fmt::format(
          "{}: its {} are also sides of other elements. Expected a group.",
          name, kPlural[part.dimension]));
      return;
    }
    bool is_used = false;
    for (const auto& entry : part.elements)
      is_used |= part.region_of.emplace(entry.first, region).second;
    if (!is_used)
      add_problem(fmt::format("{}: no {} are left for it. Expected some.", name,
                              kPlural[part.dimension]));
  }

  void find_properties() {
    const auto guarded = [&](const RegionName& name, const auto& find) {
      try {
        find();
      } catch (const InputError& error) {
        add_problem(fmt::format("{} {}", name.text(), error.what()));
      }
    };
    for (const BeamRegion& region : sections_.beams)
      guarded({"beam", region.group}, [&] {
        structure_.beam_properties.push_back(find_property(region, sections_));
        if (!region.y_axis &&
            !structure_.beam_properties.back().section.is_round)
          throw InputError(
              "needs a y_axis, the direction of its section's height. Expected "
              "x y z.");
      });
    for (const ShellRegion& region : sections_.shells)
      guarded({"shell", region.group}, [&] {
        structure_.laminates.push_back(find_laminate(region, sections_));
        axes_.push_back(find_laminate_axis(region, sections_));
      });
  }

  void check_materials() {
    std::set<std::string> used = find_volume_names(mesh_);
    for (const BeamRegion& region : sections_.beams) used.insert(region.group);
    for (const ShellRegion& region : sections_.shells) {
      if (region.materials.empty()) used.insert(region.group);
      used.insert(region.materials.begin(), region.materials.end());
    }
    std::set<std::string> known;
    for (const MaterialAssignment& one : sections_.materials) {
      if (!known.insert(one.group).second)
        add_problem(fmt::format("group '{}' has two materials. Expected one.",
                                one.group));
      if (!one.group.empty() && !used.contains(one.group))
        add_problem(fmt::format(
            "the material of group '{}' belongs to nothing. Expected a group "
            "of volumes, of a <shell> or a <beam>, or the name of a ply's "
            "material.",
            one.group));
    }
  }

  std::string name_element(const RegionName& name, std::size_t tag) const {
    return fmt::format("{}: {}, element {}", mesh_.source, name.text(), tag);
  }

  /// `use` of each element of first order with a region.
  template <typename Use>
  void visit(const Part& part, const Use& use) {
    for (const auto& [tag, region] : part.region_of) {
      const auto& [block, e] = part.elements.at(tag);
      const std::string place = name_element(part.regions[index(region)], tag);
      const int* nodes = block->element_nodes(e);
      for (const std::vector<int>& corners :
           list_element_parts(*block->element, place)) {
        std::vector<int> own;
        for (const int corner : corners) own.push_back(nodes[corner]);
        for (const int node : own) used_.insert(node);
        use(tag, region, place, own);
      }
    }
  }

  void add_beams(const Part& part) {
    visit(part, [&](std::size_t tag, int region, const std::string& place,
                    const std::vector<int>& nodes) {
      const BeamRegion& own = sections_.beams[index(region)];
      StructureBeam beam;
      beam.nodes = {nodes[0], nodes[1]};
      beam.property = region;
      const Vector3 along = mesh_.x.col(nodes[1]) - mesh_.x.col(nodes[0]);
      Eigen::Index least = 0;
      along.cwiseAbs().minCoeff(&least);
      beam.up = own.y_axis.value_or(Vector3::Unit(least));
      beam.offsets = {own.offset, own.offset};
      beam.place = place;
      beam.tag = tag;
      structure_.beams.push_back(beam);
    });
  }

  void add_shells(const Part& part) {
    visit(part, [&](std::size_t, int region, const std::string& place,
                    const std::vector<int>& nodes) {
      StructureShell shell;
      shell.nodes = nodes;
      shell.laminate = region;
      shell.axis =
          axes_[index(region)].at(mesh_.x(Eigen::all, nodes).rowwise().mean());
      shell.place = place;
      structure_.shells.push_back(std::move(shell));
    });
  }

  /// What is neither a side of other elements nor has a section would be lost.
  void check_all_used(const std::vector<const Part*>& parts) {
    for (const ElementBlock& block : mesh_.blocks)
      used_.insert(block.nodes.begin(), block.nodes.end());
    for (const Part* part : parts) {
      std::vector<std::size_t> lost;
      for (const auto& [tag, at] : part->elements) {
        const int* nodes = at.first->element_nodes(at.second);
        if (!std::all_of(nodes, nodes + at.first->element->node_count,
                         [&](int node) { return used_.contains(node); }))
          lost.push_back(tag);
      }
      if (lost.empty()) continue;
      const bool is_curve = part->dimension == 1;
      add_problem(fmt::format(
          "{} elements of {}{} have no {} and are no side of others; the first "
          "is {}. Expected a <{}> for their group.",
          lost.size(), kPlural[part->dimension],
          list_groups(part->dimension, lost.front()),
          is_curve ? "section" : "thickness", lost.front(),
          is_curve ? "beam" : "shell"));
    }
  }

  /// " in group 'NAME'" of an element; empty: in none.
  [[nodiscard]] std::string list_groups(int dimension, std::size_t tag) const {
    for (const PhysicalGroup& group : mesh_.groups)
      if (group.dimension == dimension && !group.name.empty())
        for (const ElementBlock& block : group.blocks)
          if (std::ranges::find(block.tags, tag) != block.tags.end())
            return fmt::format(" in group '{}'", group.name);
    return "";
  }

  /// Of a laminate that is not the same on both sides.
  void check_normals() {
    constexpr double kRoundoff = 1e-12;
    std::map<std::pair<int, int>, std::vector<const StructureShell*>> sides;
    for (const StructureShell& shell : structure_.shells) {
      const Laminate& own = structure_.laminates[index(shell.laminate)];
      const bool is_even =
          std::abs(own.top + own.bottom) < kRoundoff * (own.top - own.bottom) &&
          own.B.norm() < kRoundoff * own.A.norm() * (own.top - own.bottom);
      if (is_even) continue;
      for (std::size_t i = 0; i < shell.nodes.size(); ++i)
        sides[{shell.nodes[i], shell.nodes[(i + 1) % shell.nodes.size()]}]
            .push_back(&shell);
    }
    for (const auto& [nodes, shells] : sides) {
      const bool is_turned = shells.size() == 2 &&
                             !sides.contains({nodes.second, nodes.first}) &&
                             shells[0]->laminate == shells[1]->laminate;
      if (!is_turned) continue;
      problems_.push_back(fmt::format(
          "{}: its plies or offset differ with the normal, which turns over at "
          "the edge of nodes {} and {}. Reverse one of the surfaces, or give "
          "them groups of their own.",
          shells[0]->place, mesh_.tags[index(nodes.first)],
          mesh_.tags[index(nodes.second)]));
      return;
    }
  }

  [[nodiscard]] StructureSolids take_solids() const {
    StructureSolids solids;
    if (mesh_.blocks.empty()) return solids;
    Mesh& mesh = solids.mesh;
    mesh.source = mesh_.source;
    mesh.blocks = mesh_.blocks;
    mesh.volume_groups = mesh_.volume_groups;
    std::set<int> kept;
    for (const ElementBlock& block : mesh.blocks)
      kept.insert(block.nodes.begin(), block.nodes.end());
    const std::vector<int> nodes(kept.begin(), kept.end());
    std::vector<int> place(mesh_.tags.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      place[index(nodes[i])] = static_cast<int>(i);
      mesh.tags.push_back(mesh_.tags[index(nodes[i])]);
    }
    mesh.x = mesh_.x(Eigen::all, nodes);
    for (ElementBlock& block : mesh.blocks)
      for (int& node : block.nodes) node = place[index(node)];
    check_elements(mesh);
    find_boundary(mesh);
    check_faces(mesh);
    solids.materials = assign_materials(mesh, list_solid_materials());
    return solids;
  }

  /// Those of volumes, and the nameless one if a volume needs it.
  [[nodiscard]] std::vector<MaterialAssignment> list_solid_materials() const {
    const std::set<std::string> volumes = find_volume_names(mesh_);
    std::vector<MaterialAssignment> materials;
    std::set<std::string> named;
    for (const MaterialAssignment& one : sections_.materials)
      if (volumes.contains(one.group)) {
        materials.push_back(one);
        named.insert(one.group);
      }
    const bool is_left =
        std::ranges::any_of(mesh_.volume_groups, [&](const auto& names) {
          return std::ranges::none_of(names, [&](const std::string& name) {
            return named.contains(name);
          });
        });
    for (const MaterialAssignment& one : sections_.materials)
      if (is_left && one.group.empty()) materials.push_back(one);
    return materials;
  }

  const Mesh& mesh_;
  const MeshSections& sections_;
  Structure structure_;
  std::vector<LaminateAxis> axes_;  // of each shell region
  std::set<int> used_;              // nodes of elements
  std::vector<std::string> problems_;
};

void refuse_deck(const std::filesystem::path& file) {
  const MeshFileKind kind = find_mesh_file_kind(file);
  if (kind == MeshFileKind::mesh || kind == MeshFileKind::geometry) return;
  throw InputError(fmt::format(
      "{}: shells or beams were given by group, but a deck has sections of its "
      "own. Expected a geometry (.geo, .step, .brep, .iges) or a mesh (.msh, "
      ".med, .vtk).",
      file.string()));
}

}  // namespace

SectionedMesh assign_sections(const Mesh& mesh, const MeshSections& sections) {
  return Sectioner(mesh, sections).assign();
}

SectionedMesh read_sectioned_mesh(const std::filesystem::path& file,
                                  MeshOptions options,
                                  const MeshSections& sections,
                                  const Progress& progress) {
  refuse_deck(file);
  options.with_surfaces = true;
  check_mesh_options(file, find_mesh_file_kind(file), options);
  MeshReply reply = run_mesher(find_mesher(), file, options, progress);
  SectionedMesh made = assign_sections(reply.mesh, sections);
  made.structure.notices = std::move(reply.notices);
  made.files = std::move(reply.files);
  made.is_repeatable = reply.is_repeatable;
  return made;
}

}  // namespace limber::fem
