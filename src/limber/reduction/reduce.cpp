// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/reduce.hpp"

#include <memory>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/file_stamp.hpp"
#include "limber/common/records/digest.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/material.hpp"
#include "limber/flexbody/modal/decision_boundary.hpp"
#include "limber/flexbody/model/shape_integrals.hpp"
#include "limber/reduction/contact_surface.hpp"
#include "limber/reduction/manifold.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/modal/selection.hpp"
#include "limber/reduction/modal/static_modes.hpp"
#include "limber/reduction/pieces.hpp"
#include "limber/reduction/rows.hpp"
#include "limber/reduction/structure_contact.hpp"

namespace limber::flexbody {
namespace {

void add_tables(const std::vector<Interface>& interfaces,
                const StaticModes& modes, const MatrixX& Phi,
                ReducedBody& body) {
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const InterfaceMotion& motion = interfaces[i].motion;
    const Matrix6X table = motion.apply(Phi);
    body.interfaces.push_back(
        {interfaces[i].name, motion.mean_point() - body.p_MoBcm_M,
         table.topRows<3>(), table.bottomRows<3>(), motion.rotation_axes(),
         interfaces[i].selection.nodes.size(), modes.flexibility[i]});
  }
}

// Columns of the modes, then of their products (mode_products.hpp).
MatrixX join(const MatrixX& Phi, const MatrixX& Theta) {
  MatrixX joined(Phi.rows(), Phi.cols() + Theta.cols());
  joined << Phi, Theta;
  return joined;
}

// @returns theta at all nodes, 3N x pairs
MatrixX add_manifold(const MeshedBody& meshed, const Recipe& recipe,
                     const MatrixX& Phi, const Progress& progress,
                     ReducedBody& body) {
  const fem::Mesh& mesh = meshed.mesh;
  ManifoldFields made =
      make_manifold(meshed, recipe, Phi, body.lambda, body.p_MoBcm_M, progress);
  made.tables.Theta_B =
      take_rows(made.Theta, choose_rows(mesh, recipe, meshed.interfaces));
  for (std::size_t i = 0; i < meshed.interfaces.size(); ++i) {
    add_second_order(mesh, meshed.interfaces[i], made.tables.paired, Phi,
                     made.Theta, body.interfaces[i]);
  }
  if (body.clamped) {
    body.integrals.P =
        join(body.integrals.P, integrate(meshed.M_s, made.Theta));
  }
  body.manifold = std::move(made.tables);
  return std::move(made.Theta);
}

ReducedBody reduce(const MeshedBody& meshed, const Recipe& recipe,
                   const Progress& progress) {
  const fem::Mesh& mesh = meshed.mesh;
  check_initial_fields(meshed, recipe);
  const ChosenModes chosen = choose_eigenmodes(meshed, recipe, progress);
  report(progress, "static-deformation modes", 0.0);
  const StaticModes modes =
      recipe.is_estimate ? estimate_static_modes(meshed)
                         : find_static_modes(meshed, recipe, chosen.eigenmodes);
  const ReducedBasis basis =
      join_basis(meshed, chosen.eigenmodes, modes, recipe.basis.drop_tolerance);
  const MatrixX Phi =
      put_rows(basis.Phi, meshed.support.free_nodes, mesh.x.cols());

  const fem::MassProperties inertia =
      fem::calc_mass_properties(meshed.M_s, mesh.x);
  ReducedBody body;
  body.name = recipe.name;
  body.clamped = meshed.support.is_clamped;
  body.mass = inertia.mass;
  body.p_MoBcm_M = inertia.center;
  body.size = mesh.size();
  body.integrals =
      calc_shape_integrals(meshed.M_s, mesh.x.colwise() - inertia.center, Phi);
  body.lambda = basis.lambda;
  body.locking = find_locking(meshed, recipe, basis.lambda, basis.Phi);
  body.selection = finish_record(chosen, basis);
  body.load_modes = modes.loads;
  body.initial = project_initial_fields(meshed, recipe, basis);
  if (!body.clamped) {
    body.levers = calc_inertial_levers(
        meshed.M_s, mesh.x.colwise() - inertia.center, Phi, basis.lambda);
  }
  body.mesh_nodes = mesh.node_count();
  body.mesh_elements = mesh.element_count();
  body.mesh_boundary_nodes = mesh.boundary_nodes.size();
  keep_rows(mesh, recipe, meshed.interfaces, Phi, body);
  add_tables(meshed.interfaces, modes, Phi, body);
  fem::PairedFields second{{}, MatrixX(Phi.rows(), 0), {}};
  if (recipe.manifold) {
    second.Theta = add_manifold(meshed, recipe, Phi, progress, body);
    second.paired = body.manifold->paired;
    second.law = find_elasticity(recipe.law);
  }
  if (recipe.stress) {
    report(progress, "stress modes", 0.0);
    body.stress =
        make_stress_modes(mesh, recipe, meshed.interfaces, Phi, second);
  }
  body.contact_surfaces = make_contact_surfaces(
      meshed, recipe, basis, join(Phi, second.Theta), inertia.center, progress);
  report(progress, "reduced", 1.0);
  return body;
}

ReducedBody reduce_piece(Pieces& pieces, const Piece& piece,
                         const Recipe& recipe, const Progress& progress) {
  PieceOfMesh taken = pieces.take(recipe, piece);
  // Interfaces of a piece are found on the whole mesh.
  Recipe bare = taken.recipe;
  bare.interfaces.clear();
  bare.load_patterns.clear();
  MeshedBody meshed(bare, taken.mesh, progress);
  meshed.interfaces = std::move(taken.interfaces);
  return reduce(meshed, taken.recipe, progress);
}

/// Every file and folder that is given, and the files of a folder.
std::vector<FileStamp> stamp_files(
    const std::vector<std::filesystem::path>& paths) {
  namespace fs = std::filesystem;
  std::set<fs::path> files;
  for (const fs::path& path : paths) {
    files.insert(fs::absolute(path));
    if (!fs::is_directory(path)) continue;
    for (const auto& entry : fs::directory_iterator(path))
      files.insert(fs::absolute(entry.path()));
  }
  std::vector<FileStamp> stamps;
  for (const fs::path& file : files) stamps.push_back(stamp_version(file));
  return stamps;
}

MeshAtHand at_hand(const std::shared_ptr<const fem::TracedMesh>& made,
                   const Progress& progress) {
  const auto pieces = std::make_shared<Pieces>(made);
  MeshAtHand mesh;
  mesh.record = {fem::find_mesh_content(made->mesh), made->notices,
                 fem::describe_file_materials(made->mesh, {}), made->files,
                 made->is_repeatable};
  mesh.reduce = [made, progress](const Recipe& recipe) {
    return flexbody::reduce(recipe, made, progress);
  };
  mesh.take_piece = [pieces, record = mesh.record,
                     progress](const Piece& piece) {
    MeshAtHand part;
    part.record = record;
    part.record.content = find_piece_content(record.content, piece);
    part.reduce = [pieces, piece, progress](const Recipe& recipe) {
      return reduce_piece(*pieces, piece, recipe, progress);
    };
    return part;
  };
  mesh.advise_pieces = [pieces] { return pieces->advise(); };
  return mesh;
}

void add_surface(const fem::ModelSurface& mesh_surface, Digest& digest) {
  for (const fem::ElementBlock& block : mesh_surface.mesh.blocks) {
    digest.add(block.element->gmsh_type);
    for (const int node : block.nodes) digest.add(node);
    for (const int region : block.regions) digest.add(region);
  }
  for (const SolidMaterial& material : mesh_surface.materials) {
    digest.add(material.youngs_modulus);
    digest.add(material.poisson_ratio);
  }
  for (const int base : mesh_surface.bases) digest.add(base);
  for (const fem::ModelSurface::Side side : mesh_surface.sides)
    digest.add(static_cast<int>(side));
}

/// Digest of what the tables depend on, apart from the recipe.
std::string find_content(const MatrixPart& part) {
  const MatrixSystem& system = part.system;
  Digest digest;
  digest.add(std::string("matrices"));
  digest.add(MatrixX(system.x));
  for (const std::size_t tag : system.tags) digest.add(tag);
  for (const fem::MatrixRow& row : system.rows) {
    digest.add(row.node);
    digest.add(row.component);
  }
  for (const fem::SparseMatrix* A : {&system.K, &system.M, &system.lift})
    for (Eigen::Index j = 0; j < A->outerSize(); ++j) {
      digest.add(j);
      for (fem::SparseMatrix::InnerIterator it(*A, j); it; ++it) {
        digest.add(it.row());
        digest.add(it.value());
      }
    }
  for (const fem::MatrixNodeSet& set : system.sets) {
    digest.add(set.name);
    for (const int node : set.nodes) digest.add(node);
  }
  for (const fem::SparseMatrix& moment : system.moments)
    for (Eigen::Index j = 0; j < moment.outerSize(); ++j)
      for (fem::SparseMatrix::InnerIterator it(moment, j); it; ++it)
        digest.add(it.value());
  digest.add(system.has_recovery);
  digest.add(system.drawn);
  digest.add(system.triangles.size());
  for (const auto& nodes : system.triangles)
    for (const int node : nodes) digest.add(node);
  add_surface(system.mesh_surface, digest);
  return digest.text();
}

ReducedBody reduce_part(const Recipe& recipe,
                        const std::shared_ptr<const MatrixPart>& part,
                        const Progress& progress) {
  return reduce_matrices(recipe, part, progress,
                         make_structure_surfaces(part, recipe, progress));
}

MeshAtHand at_hand(const std::shared_ptr<const MatrixPart>& part,
                   std::vector<FileStamp> files, const Progress& progress) {
  MeshAtHand mesh;
  mesh.record = {find_content(*part), part->system.notices, part->system.found,
                 std::move(files), true};
  mesh.reduce = [part, progress](const Recipe& recipe) {
    return reduce_part(recipe, part, progress);
  };
  mesh.take_piece = [part](const Piece&) -> MeshAtHand {
    throw InputError(
        part->system.source +
        ": matrices cannot be cut into pieces, which needs a mesh");
  };
  mesh.advise_pieces = [] {
    return PieceAdvice{1, "matrices cannot be cut into pieces"};
  };
  return mesh;
}

}  // namespace

ReducedBody reduce(const Recipe& recipe, const Progress& progress) {
  if (is_node_model(recipe.mesh))
    return reduce_part(recipe, read_matrix_part(recipe.mesh, progress),
                       progress);
  return reduce(MeshedBody(recipe, progress), recipe, progress);
}

ReducedBody reduce(const Recipe& recipe,
                   std::shared_ptr<const fem::TracedMesh> mesh,
                   const Progress& progress) {
  return reduce(MeshedBody(recipe, std::move(mesh), progress), recipe,
                progress);
}

Reducer make_reducer(const Progress& progress) {
  const auto make_mesh = [progress](const MeshSource& source) {
    if (!source.is_matrices() && is_node_model(source)) {
      PartOrigin origin;
      const auto part = read_matrix_part(source, progress, &origin);
      if (source.sections.empty()) origin.stamps = stamp_files(origin.paths);
      MeshAtHand made = at_hand(part, std::move(origin.stamps), progress);
      made.record.is_repeatable = origin.is_repeatable;
      return made;
    }
    if (source.is_matrices()) {
      // Before they are read, so that a change meanwhile is noticed.
      std::vector<std::filesystem::path> paths = source.matrices.paths;
      paths.insert(paths.end(), source.matrices.recovery.begin(),
                   source.matrices.recovery.end());
      std::vector<FileStamp> files = stamp_files(paths);
      return at_hand(read_matrix_part(source, progress), std::move(files),
                     progress);
    }
    return at_hand(
        std::make_shared<const fem::TracedMesh>(read_source(source, progress)),
        progress);
  };
  return {fem::identify_mesher(), make_mesh};
}

}  // namespace limber::flexbody
