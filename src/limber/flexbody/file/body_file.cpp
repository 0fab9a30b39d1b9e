// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/body_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/common/records/digest.hpp"
#include "limber/flexbody/file/body_file_contact.hpp"
#include "limber/flexbody/file/body_file_manifold.hpp"
#include "limber/flexbody/file/body_file_reader.hpp"
#include "limber/flexbody/file/body_file_records.hpp"
#include "limber/flexbody/file/body_file_stress.hpp"
#include "limber/flexbody/file/body_seal.hpp"

namespace limber::flexbody {
namespace {

constexpr InputKind kReducedBody = {"reduced body", std::uint64_t{1} << 36};

std::string make_seal(int version, const std::string& digest) {
  std::string seal = fmt::format("{}\nlayout {}\nxxh128 {}\n",
                                 kReducedBodyFormat, version, digest);
  seal.resize(kBodySealSize, '\n');
  return seal;
}

// Digest of all remaining bytes of `read(block, size)`.
template <typename Read>
std::string calc_digest(const Read& read) {
  Digest digest;
  std::vector<char> block(std::size_t{1} << 20);
  for (std::size_t count = block.size(); count == block.size();) {
    count = read(block.data(), block.size());
    digest.add_bytes(block.data(), count);
  }
  return digest.text();
}

// The version in a seal, or nothing if it is not a seal.
std::optional<int> version_of(const std::string& seal) {
  const std::string start = fmt::format("{}\nlayout ", kReducedBodyFormat);
  if (!seal.starts_with(start)) return std::nullopt;
  int version = 0;
  const char* const end = seal.data() + seal.size();
  const auto [after, error] =
      std::from_chars(seal.data() + start.size(), end, version);
  if (error != std::errc() || after == end || *after != '\n') {
    return std::nullopt;
  }
  return version;
}

// The oldest layout that has room for the body.
int layout_of(const ReducedBody& body) {
  if (body.stress) {
    return body.stress->sections.exist() ? kSectionBodyFileVersion
                                         : kStressBodyFileVersion;
  }
  if (body.manifold) return kManifoldBodyFileVersion;
  return body.contact_surfaces.empty() ? kBodyFileVersion
                                       : kContactBodyFileVersion;
}

using Reader = BodyFileReader;

std::vector<std::int64_t> to_integers(const std::vector<std::size_t>& v) {
  return {v.begin(), v.end()};
}

MatrixX stack(const std::vector<Matrix3>& matrices) {
  MatrixX rows(static_cast<Eigen::Index>(matrices.size()), 9);
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = matrices[i].reshaped();
  }
  return rows;
}

std::vector<Matrix3> unstack(const MatrixX& rows) {
  std::vector<Matrix3> matrices(static_cast<std::size_t>(rows.rows()));
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    matrices[i].reshaped() = rows.row(static_cast<Eigen::Index>(i));
  }
  return matrices;
}

void write_rows(Hdf5File& out, const ReducedBody& body) {
  out.write("rows/tags", to_integers(body.rows.tags), "1", "Gmsh node tags");
  out.write("rows/x_B", body.rows.x_B, "m",
            "undeformed positions from the centre of mass, 3 x n");
  out.write("rows/Phi_B", body.rows.Phi_B, "kg^-1/2", "mode shapes, 3n x m");
  std::vector<std::int64_t> corners;
  for (const auto& t : body.triangles) {
    for (const std::size_t i : t) {
      corners.push_back(static_cast<std::int64_t>(i));
    }
  }
  out.write("rows/triangles", corners, "1",
            "surface triangles as row indices, three each, outward");
}

void write_groups(Hdf5File& out, const ReducedBody& body) {
  for (std::size_t i = 0; i < body.groups.size(); ++i) {
    const NodeGroup& group = body.groups[i];
    const std::string at = fmt::format("groups/{:04}/", i);
    out.write(at + "name", group.name, "physical group");
    out.write(at + "dimension", std::vector<std::int64_t>{group.dimension}, "1",
              "0 point, 1 curve, 2 surface, 3 volume");
    out.write(at + "tags", to_integers(group.tags), "1", "Gmsh node tags");
    out.write(at + "weights", MatrixX(group.weights), "1",
              "fraction of a uniform load, sum 1");
  }
}

void write_interfaces(Hdf5File& out, const ReducedBody& body) {
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    const InterfaceTable& table = body.interfaces[i];
    const std::string at = fmt::format("interfaces/{:04}/", i);
    out.write(at + "name", table.name, "interface");
    out.write(at + "p_B", MatrixX(table.p_B), "m", "undeformed mean point");
    out.write(at + "Phi_B", MatrixX(table.Phi_B), "kg^-1/2",
              "translation per modal coordinate, 3 x m");
    out.write(at + "Psi_B", MatrixX(table.Psi_B), "rad kg^-1/2 m^-1",
              "rotation per modal coordinate, 3 x m");
    out.write(
        at + "rotation_axes", MatrixX(table.rotation_axes), "1",
        "axes about which the node set defines a rotation, 3 x 0, 2 or 3");
    out.write(at + "node_count", to_integers({table.node_count}), "1",
              "nodes of the set");
    out.write(at + "flexibility", MatrixX(table.flexibility), "m/N, rad/(N m)",
              "inertia-relieved flexibility, 6 x 6");
  }
}

void write_content(Hdf5File& out, const ReducedBody& body) {
  out.write("format", std::string(kReducedBodyFormat), "what this file is");
  out.write("version", std::vector<std::int64_t>{layout_of(body)}, "1",
            "layout of this file");
  out.write("name", body.name, "body");
  out.write("content_key", body.content_key, "hash of all that went in");
  out.write("clamped", std::vector<std::int64_t>{body.clamped ? 1 : 0}, "1",
            "1 if B is fixed in the world");
  out.write("mass", MatrixX::Constant(1, 1, body.mass), "kg", "mass");
  out.write("p_MoBcm_M", MatrixX(body.p_MoBcm_M), "m",
            "centre of mass in the mesh frame");
  out.write("size", MatrixX(body.size), "m", "edges of the bounding box");
  out.write("mesh_counts",
            to_integers({body.mesh_nodes, body.mesh_elements,
                         body.mesh_boundary_nodes}),
            "1", "nodes, elements, boundary nodes of the mesh");
  out.write("integrals/S0", MatrixX(body.integrals.S0), "kg m^2",
            "int x x' dm");
  out.write("integrals/S1", stack(body.integrals.S1), "kg^1/2 m",
            "int x phi_k' dm, column-major 3 x 3 a row");
  out.write("integrals/S2", stack(body.integrals.S2), "1",
            "int phi_k phi_l' dm, row k m + l, column-major 3 x 3 a row");
  out.write("integrals/P", MatrixX(body.integrals.P), "kg^1/2",
            "int phi_k dm, 3 x m");
  out.write("levers",
            MatrixX(Vector3(body.levers.lumped, body.levers.consistent,
                            body.levers.displacement)),
            "kg m, kg m, m s^2",
            "largest m |b| of row sums, |M b|, (Phi Lambda^-1 Phi' m|b|)_i");
  out.write("lambda", MatrixX(body.lambda), "rad^2/s^2", "eigenvalues");
  out.write("counts", to_integers({body.groups.size(), body.interfaces.size()}),
            "1", "groups, interfaces");
  write_rows(out, body);
  write_groups(out, body);
  write_interfaces(out, body);
  write_inertia_record(out, body.inertia_record);
  write_locking(out, body.locking);
  write_selection(out, body.selection);
  write_load_modes(out, body.load_modes);
  write_field(out, "initial/displacement/", body.initial.displacement,
              "kg^1/2 m");
  write_field(out, "initial/velocity/", body.initial.velocity, "kg^1/2 m/s");
  write_contact_surfaces(out, body.contact_surfaces);
  write_manifold(out, body);
  write_stress_modes(out, body);
}

void read_mass_rows(const Reader& reader, ReducedBody& body) {
  const Eigen::Index m = body.lambda.size();
  body.rows.tags = reader.sizes("rows/tags", -1);
  const auto n = static_cast<Eigen::Index>(body.rows.tags.size());
  body.rows.x_B = reader.matrix("rows/x_B", 3, n);
  body.rows.Phi_B = reader.matrix("rows/Phi_B", 3 * n, m);
  const auto corners = reader.sizes("rows/triangles", -1);
  if (corners.size() % 3 != 0) reader.fail("'rows/triangles' is truncated");
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    body.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    for (const std::size_t c : body.triangles.back()) {
      if (c >= body.rows.tags.size()) {
        reader.fail("'rows/triangles' names a row that does not exist");
      }
    }
  }
}

void read_groups(const Reader& reader, std::size_t count, ReducedBody& body) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::string at = fmt::format("groups/{:04}/", i);
    NodeGroup group;
    group.name = reader.in().read_text(at + "name");
    group.dimension = static_cast<int>(reader.integer(at + "dimension"));
    group.tags = reader.sizes(at + "tags", -1);
    group.weights = reader.matrix(
        at + "weights", static_cast<Eigen::Index>(group.tags.size()), 1);
    body.groups.push_back(std::move(group));
  }
}

void read_interfaces(const Reader& reader, std::size_t count,
                     ReducedBody& body) {
  const Eigen::Index m = body.lambda.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string at = fmt::format("interfaces/{:04}/", i);
    InterfaceTable table;
    table.name = reader.in().read_text(at + "name");
    table.p_B = reader.matrix(at + "p_B", 3, 1);
    table.Phi_B = reader.matrix(at + "Phi_B", 3, m);
    table.Psi_B = reader.matrix(at + "Psi_B", 3, m);
    table.rotation_axes =
        reader.matrix(at + "rotation_axes", 3,
                      reader.in().read_matrix(at + "rotation_axes").cols());
    table.node_count = reader.sizes(at + "node_count", 1)[0];
    table.flexibility = reader.matrix(at + "flexibility", 6, 6);
    body.interfaces.push_back(std::move(table));
  }
}

// The optional tables, by the layout's version.
void read_tables(const Reader& reader, StressTables stress, ReducedBody& body) {
  const std::int64_t version = reader.integer("version");
  OtherTables has{version == kContactBodyFileVersion,
                  version == kManifoldBodyFileVersion};
  if (has.manifold) has.surfaces = has_surfaces(reader);
  if (version >= kStressBodyFileVersion) has = read_other_tables(reader);
  const Eigen::Index m = body.lambda.size();
  const Eigen::Index products = has.manifold ? count_products(reader, m) : 0;
  const Eigen::Index P_columns = body.integrals.P.cols();
  if (P_columns != m && P_columns != m + products) {
    reader.fail(fmt::format("'integrals/P' has {} columns; expected {}",
                            P_columns, m + products));
  }
  if (has.surfaces) {
    body.contact_surfaces = read_contact_surfaces(reader, m, products);
  }
  if (has.manifold) read_manifold(reader, body);
  if (version >= kStressBodyFileVersion && stress == StressTables::needed) {
    read_stress_modes(reader, products, version == kSectionBodyFileVersion,
                      body);
  }
}

// Before HDF5 opens the file, since it may crash on damaged structures. Another
// whole file may replace this one before that.
void check_seal(const std::filesystem::path& file) {
  const auto problem = [&](const std::string& what) {
    return InputError(fmt::format("'{}' {}", file.string(), what));
  };
  InputFile in(file, kReducedBody);
  std::string seal(kBodySealSize, '\0');
  const bool is_whole = in.read(seal.data(), kBodySealSize) == kBodySealSize;
  const std::optional<int> version = version_of(seal);
  if (!version) {
    throw problem(
        "is not a reduced body of this program's; make one of its mesh");
  }
  if (*version < kBodyFileVersion || *version > kSectionBodyFileVersion) {
    throw problem(
        fmt::format("has layout version {}; this program reads {} to {}. "
                    "Reduce the body again",
                    *version, kBodyFileVersion, kSectionBodyFileVersion));
  }
  const auto read = [&](char* out, std::size_t size) {
    return in.read(out, size);
  };
  if (!is_whole || seal != make_seal(*version, calc_digest(read))) {
    throw problem(
        "is damaged (its digest does not match its content); reduce the body "
        "again");
  }
}

// Writes the seal of a layout, or renews the present one.
void write_seal(const std::filesystem::path& file, std::optional<int> version) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  std::string old(kBodySealSize, '\0');
  stream.read(old.data(), kBodySealSize);
  if (!version) version = version_of(old);
  if (!stream || !version) {
    throw InputError(fmt::format("'{}' cannot be sealed; is it a reduced body?",
                                 file.string()));
  }
  const auto read = [&](char* out, std::size_t size) {
    stream.read(out, static_cast<std::streamsize>(size));
    return static_cast<std::size_t>(stream.gcount());
  };
  const std::string seal = make_seal(*version, calc_digest(read));
  stream.clear();  // the end-of-file state after the digest
  stream.seekp(0);
  stream.write(seal.data(), static_cast<std::streamsize>(seal.size()));
  stream.close();
  if (!stream) {
    throw InputError(
        fmt::format("'{}' cannot be sealed; is the disk full?", file.string()));
  }
}

}  // namespace

bool is_body_file(const std::filesystem::path& file) {
  std::string start(kReducedBodyFormat.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return stream && start == kReducedBodyFormat;
}

void seal_body_file(const std::filesystem::path& file) {
  write_seal(file, std::nullopt);
}

void write_body(const ReducedBody& body, const std::filesystem::path& file) {
  try {
    write_whole(file, [&](const std::filesystem::path& part) {
      Hdf5File out = Hdf5File::create(part, kBodySealSize);
      write_content(out, body);
      out.close();
      write_seal(part, layout_of(body));
    });
  } catch (const std::exception& error) {
    throw InputError(fmt::format("the reduced body '{}' cannot be written: {}",
                                 file.string(), error.what()));
  }
}

ReducedBody read_body(const std::filesystem::path& file, StressTables stress) {
  check_seal(file);
  const Hdf5File in = Hdf5File::open(file);
  const Reader reader(in, file);
  ReducedBody body;
  body.name = in.read_text("name");
  body.content_key = in.read_text("content_key");
  body.clamped = reader.integer("clamped") != 0;
  body.mass = reader.matrix("mass", 1, 1)(0, 0);
  body.p_MoBcm_M = reader.matrix("p_MoBcm_M", 3, 1);
  body.size = reader.matrix("size", 3, 1);
  const auto mesh_counts = reader.sizes("mesh_counts", 3);
  body.mesh_nodes = mesh_counts[0];
  body.mesh_elements = mesh_counts[1];
  body.mesh_boundary_nodes = mesh_counts[2];

  const MatrixX lambda = in.read_matrix("lambda");
  const Eigen::Index m = lambda.rows();
  body.lambda = reader.matrix("lambda", m, 1);
  body.integrals.S0 = reader.matrix("integrals/S0", 3, 3);
  body.integrals.S1 = unstack(reader.matrix("integrals/S1", m, 9));
  body.integrals.S2 = unstack(reader.matrix("integrals/S2", m * m, 9));
  body.integrals.P =
      reader.matrix("integrals/P", 3, in.read_matrix("integrals/P").cols());
  const MatrixX levers = reader.matrix("levers", 3, 1);
  body.levers = {levers(0, 0), levers(1, 0), levers(2, 0)};
  read_mass_rows(reader, body);
  const auto counts = reader.sizes("counts", 2);
  read_groups(reader, counts[0], body);
  read_interfaces(reader, counts[1], body);
  body.inertia_record = read_inertia_record(reader);
  body.locking = read_locking(reader);
  body.selection = read_selection(reader);
  body.load_modes = read_load_modes(reader);
  body.initial.displacement = read_field(reader, "initial/displacement/", m);
  body.initial.velocity = read_field(reader, "initial/velocity/", m);
  read_tables(reader, stress, body);
  return body;
}

}  // namespace limber::flexbody
