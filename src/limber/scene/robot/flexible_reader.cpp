// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/flexible_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "limber/common/deck_name.hpp"
#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/length_unit.hpp"
#include "limber/common/material/stated_material.hpp"
#include "limber/common/names.hpp"
#include "limber/scene/robot/akantu_material.hpp"
#include "limber/scene/robot/place_reader.hpp"
#include "limber/scene/text/section_reader.hpp"

namespace limber::scene {
namespace {

using flexbody::InterfaceRequest;
using Numbers = std::vector<double>;

void read_unit(XmlElement& element, double& unit) {
  const std::optional<std::string> text = element.text("unit");
  if (!text) return;
  const std::optional<double> metres = parse_length_unit(*text);
  if (!metres) {
    element.fail(
        fmt::format("has unit=\"{}\"; expected {}", echo(*text), kLengthUnits));
  }
  unit = metres.value_or(unit);
}

void read_mesh(XmlElement& element, const std::filesystem::path& folder,
               flexbody::MeshSource& mesh) {
  mesh.file = (folder / element.required_text("file")).lexically_normal();
  mesh.size = element.number("size", kNonNegative).value_or(0.0);
  mesh.order = element.integer("order", 1, 3).value_or(0);
  read_unit(element, mesh.unit);
  if (const auto text = element.text("force_unit")) {
    const std::optional<double> newtons = parse_force_unit(*text);
    if (!newtons)
      element.fail(fmt::format("has force_unit=\"{}\"; expected {}",
                               echo(*text), kForceUnits));
    mesh.force = newtons.value_or(0.0);
  }
  std::istringstream cards(element.text("ignore").value_or(""));
  for (std::string card; std::getline(cards, card, ',');)
    mesh.ignored.push_back(card);
}

/// <matrices path="..." mass="..."/>: a folder, or files.
void read_matrices(XmlElement& element, const std::filesystem::path& folder,
                   flexbody::MeshSource& source) {
  const auto add = [&](const std::string& path) {
    source.matrices.paths.push_back((folder / path).lexically_normal());
  };
  add(element.required_text("path"));
  for (const char* name :
       {"stiffness_file", "mass_file", "nodes_file", "rows_file"}) {
    if (const auto path = element.text(name)) add(*path);
  }
  for (const char* name :
       {"recovery_file", "points_file", "recovery_rows_file"}) {
    if (const auto path = element.text(name))
      source.matrices.recovery.push_back((folder / *path).lexically_normal());
  }
  source.file = source.matrices.paths.front();
  if (!source.file.has_filename()) source.file = source.file.parent_path();
  source.matrices.mass = element.required_number("mass", kPositive);
  read_unit(element, source.unit);
}

/// <material file="..."/>: an Akantu material file.
std::vector<flexbody::MaterialRegion> read_material_file(
    XmlElement& element, const std::filesystem::path& file) {
  try {
    return read_akantu_materials(file);
  } catch (const InputError& error) {
    element.fail(error.what());
    return {{}};
  }
}

/// Three of each constant, or 21, and axes.
void read_anisotropic(XmlElement& element, flexbody::Material& material) {
  StatedMaterial stated;
  stated.youngs_modulus =
      element.numbers("youngs_modulus", kPositive).value_or(Numbers());
  stated.poisson_ratio = element.numbers("poisson_ratio").value_or(Numbers());
  stated.shear_modulus =
      element.numbers("shear_modulus", kPositive).value_or(Numbers());
  stated.stiffness = element.numbers("stiffness").value_or(Numbers());
  stated.density = element.required_number("density", kPositive);
  stated.axis_1 = element.vector("axis_1");
  stated.axis_2 = element.vector("axis_2");
  stated.cylinder_axis = element.vector("cylinder_axis");
  stated.cylinder_point = element.vector("cylinder_point");
  try {
    material = make_material(stated);
  } catch (const InputError& error) {
    for (const std::string& problem : error.problems()) element.fail(problem);
  }
}

}  // namespace

std::vector<flexbody::MaterialRegion> read_material(
    XmlElement& element, const std::filesystem::path& folder) {
  if (const auto file = element.text("file")) {
    return read_material_file(element, (folder / *file).lexically_normal());
  }
  flexbody::MaterialRegion region;
  region.group = element.text("group").value_or("");
  if (element.has("shear_modulus") || element.has("stiffness") ||
      element.has("axis_1") || element.has("cylinder_axis")) {
    read_anisotropic(element, region.material);
    return {region};
  }
  region.material.youngs_modulus =
      element.required_number("youngs_modulus", kPositive);
  region.material.poisson_ratio =
      element.required_number("poisson_ratio", {-1.0, 0.5, true, true});
  region.material.density = element.required_number("density", kPositive);
  return {region};
}

namespace {

/// As a loss factor, of which a damping ratio is half.
double read_loss_factor(XmlElement& element) {
  const auto ratio = element.number("ratio", {0.0, 0.5, false, false});
  const auto loss_factor =
      element.number("loss_factor", {0.0, 1.0, false, false});
  if (ratio && loss_factor) {
    element.fail(
        "has both 'ratio' and 'loss_factor', twice the ratio; keep one");
  }
  return loss_factor.value_or(2.0 * ratio.value_or(0.0));
}

dynamics::ModalDamping read_damping(XmlElement& element) {
  dynamics::ModalDamping damping;
  damping.rayleigh_mass =
      element.number("rayleigh_mass", kNonNegative).value_or(0.0);
  damping.rayleigh_stiffness =
      element.number("rayleigh_stiffness", kNonNegative).value_or(0.0);
  const auto ratios = element.numbers("per_mode", kNonNegative);
  if (ratios) damping.ratios = *ratios;
  return damping;
}

flexbody::KeptRows read_rows(XmlElement& element) {
  std::istringstream text(element.text("rows").value_or("boundary"));
  return flexbody::parse_rows({std::istream_iterator<std::string>(text), {}});
}

/// eigenmodes="auto" and its options.
flexbody::AutomaticModes read_automatic(XmlElement& element) {
  flexbody::AutomaticModes automatic;
  automatic.threshold = element.number("threshold", {0.0, 1.0, false, false})
                            .value_or(automatic.threshold);
  automatic.candidates =
      element.integer("candidates", 1, 100000).value_or(automatic.candidates);
  try {
    if (const auto measure = element.text("measure"))
      automatic.measure = flexbody::parse_measure(*measure);
  } catch (const InputError& error) {
    element.fail(error.problems().front());
  }
  return automatic;
}

void read_eigenmodes(XmlElement& element, flexbody::BasisOptions& basis) {
  if (element.text("eigenmodes") == "auto") {
    basis.automatic = read_automatic(element);
    return;
  }
  basis.eigenmodes = element.integer("eigenmodes", 0, 100000).value_or(10);
  for (const char* name : {"threshold", "measure", "candidates"}) {
    if (element.text(name))
      element.fail(fmt::format("'{}' goes with eigenmodes=\"auto\"", name));
  }
}

void read_basis(XmlElement& element, FlexibleLink& link) {
  read_eigenmodes(element, link.basis);
  link.basis.interface_modes =
      element.boolean("interface_modes").value_or(true);
  link.basis.load_modes = element.boolean("load_modes").value_or(true);
  link.basis.terms = element.integer("terms", 1, 100).value_or(1);
  if (link.basis.terms > 1 && !link.basis.interface_modes &&
      !link.basis.load_modes) {
    element.fail(
        "'terms' counts those of static-deformation modes; leave "
        "interface_modes or load_modes on");
  }
  link.rows = read_rows(element);
}

InterfaceRequest read_interface(XmlElement& element) {
  InterfaceRequest request;
  request.name = element.required_text("name");
  request.nodes = read_nodes(element);
  request.weighting = read_weighting(element);
  request.static_modes = element.boolean("static_modes").value_or(true);
  return request;
}

void add_interface(XmlElement& element, FlexibleLink& link) {
  const InterfaceRequest request = read_interface(element);
  const bool twice = std::any_of(link.interfaces.begin(), link.interfaces.end(),
                                 [&](const InterfaceRequest& other) {
                                   return other.name == request.name;
                                 });
  if (twice) element.fail(fmt::format("'{}' is given twice", request.name));
  link.interfaces.push_back(request);
}

/// How a number of pieces is left open.
constexpr const char* kAutomatic = "auto";
constexpr int kMostPieces = 1000;

void read_pieces(XmlElement& element, FlexibleLink& link) {
  if (!element.has("pieces")) return;
  if (element.text("pieces") == kAutomatic) {
    link.pieces = 0;
  } else {
    link.pieces = element.integer("pieces", 1, kMostPieces).value_or(1);
  }
  if (link.mesh.is_matrices() && link.pieces != 1) {
    element.fail("'pieces' cuts a <mesh>; matrices stay whole");
  }
  if (!link.mesh.sections.empty() && link.pieces != 1) {
    element.fail("'pieces' cuts solids; shells and beams stay whole");
  }
  if (link.reduced_file.empty() || link.pieces == 1) return;
  element.fail(
      "'pieces' cuts a <mesh>; a saved body is one body and stays whole");
}

/// Number of occurrences of each tag that may be given once.
using Counts = std::map<std::string, int>;

void check_counts(const XmlElement& element, const Counts& counts) {
  for (const auto& [tag, count] : counts) {
    if (count > 1) element.fail(fmt::format("has more than one <{}>", tag));
  }
}

/// A saved body already has all of these.
void check_saved(const XmlElement& element, const FlexibleLink& link,
                 const Counts& counts) {
  const auto refuse = [&](const char* tag) {
    element.fail(fmt::format(
        "has a <{}>, which goes with <mesh>; a saved body has its own", tag));
  };
  if (!link.materials.empty()) refuse("material");
  if (!link.mesh.sections.shells.empty()) refuse("shell");
  if (!link.mesh.sections.beams.empty()) refuse("beam");
  if (!link.interfaces.empty()) refuse("interface");
  if (counts.contains("basis")) refuse("basis");
}

void check_whole(const XmlElement& element, const FlexibleLink& link,
                 const Counts& counts) {
  const auto count = [&](const char* tag) { return counts.contains(tag); };
  if (count("mesh") + count("matrices") + count("reduced") != 1) {
    element.fail(
        "needs exactly one of <mesh file=.../>, <matrices path=.../> and "
        "<reduced file=.../>");
  }
  if (count("matrices") && !link.materials.empty()) {
    element.fail(
        "has a <material>, which goes with <mesh>; matrices have their own");
  }
  if (!count("mesh") && count("matrices") && !link.mesh.sections.empty()) {
    element.fail(
        "has a <shell> or <beam>, which goes with <mesh>; matrices have "
        "theirs");
  }
  if (count("mesh") && link.materials.empty() &&
      !has_deck_name(link.mesh.file)) {
    element.fail(
        "needs a <material youngs_modulus=... poisson_ratio=... "
        "density=.../> for its mesh");
  }
}

}  // namespace

FlexibleLink read_flexible(XmlElement& element,
                           const std::filesystem::path& folder) {
  FlexibleLink link;
  Counts counts;
  std::map<std::string, XmlElement::Reader> readers = {
      {"mesh", [&](XmlElement& e) { read_mesh(e, folder, link.mesh); }},
      {"matrices", [&](XmlElement& e) { read_matrices(e, folder, link.mesh); }},
      {"reduced",
       [&](XmlElement& e) {
         link.reduced_file =
             (folder / e.required_text("file")).lexically_normal();
       }},
      {"origin", [&](XmlElement& e) { link.X_LM = e.pose(); }},
      {"material",
       [&](XmlElement& e) {
         for (const auto& region : read_material(e, folder)) {
           link.materials.push_back(region);
         }
       }},
      {"shell",
       [&](XmlElement& e) {
         link.mesh.sections.shells.push_back(read_shell(e));
       }},
      {"beam",
       [&](XmlElement& e) {
         link.mesh.sections.beams.push_back(read_beam(e));
       }},
      {"damping",
       [&](XmlElement& e) {
         link.loss_factor = read_loss_factor(e);
         link.damping = read_damping(e);
       }},
      {"basis", [&](XmlElement& e) { read_basis(e, link); }},
      {"clamp",
       [&](XmlElement& e) {
         link.clamped_groups.push_back(e.required_text("group"));
       }},
      {"interface", [&](XmlElement& e) { add_interface(e, link); }},
      {"attach", [&](XmlElement& e) {
         const std::string joint = e.required_text("joint");
         const std::string interface = e.required_text("interface");
         if (link.interface_of_joint.emplace(joint, interface).second) return;
         e.fail(fmt::format("for joint '{}' is given twice", joint));
       }}};
  for (const char* tag :
       {"mesh", "matrices", "reduced", "origin", "damping", "basis"}) {
    readers[tag] = [&counts, tag, read = readers[tag]](XmlElement& e) {
      ++counts[tag];
      read(e);
    };
  }
  element.read_children(readers);
  if (!link.mesh.sections.empty())
    link.mesh.sections.materials = link.materials;
  check_counts(element, counts);
  check_whole(element, link, counts);
  read_pieces(element, link);
  if (!link.reduced_file.empty()) check_saved(element, link, counts);
  return link;
}

}  // namespace limber::scene
