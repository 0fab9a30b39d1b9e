// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/body_file.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <atomic>
#include <charconv>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "common/errors.hpp"
#include "common/hdf5_file.hpp"

namespace limber::flexbody {
namespace {

const char* const kFormat = "limber reduced body";

// HDF5 leaves this many bytes at the start to the seal.
constexpr std::size_t kSealSize = 512;

std::string make_seal(int version, const std::string& digest) {
  std::string seal =
      fmt::format("{}\nlayout {}\nxxh128 {}\n", kFormat, version, digest);
  seal.resize(kSealSize, '\n');
  return seal;
}

// Digest of all bytes from where `in` stands.
std::string calc_digest(std::istream& in) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(
      XXH3_createState(), XXH3_freeState);
  if (!state || XXH3_128bits_reset(state.get()) != XXH_OK) {
    throw std::bad_alloc();
  }
  std::vector<char> block(std::size_t{1} << 20);
  do {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    XXH3_128bits_update(state.get(), block.data(),
                        static_cast<std::size_t>(in.gcount()));
  } while (in);
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

// The version that a seal names, or nothing if it is no seal.
std::optional<int> version_of(const std::string& seal) {
  const std::string start = fmt::format("{}\nlayout ", kFormat);
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

std::vector<std::int64_t> to_integers(const std::vector<std::size_t>& v) {
  return {v.begin(), v.end()};
}

std::vector<std::size_t> to_sizes(const std::vector<std::int64_t>& v) {
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
              "share of a uniform load, sum 1");
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
    out.write(at + "rotation_rank",
              std::vector<std::int64_t>{table.rotation_rank}, "1",
              "rotations that the node set defines");
    out.write(at + "flexibility", MatrixX(table.flexibility), "m/N, rad/(N m)",
              "inertia-relieved flexibility, 6 x 6");
  }
}

// Flat lists: a load that changes often has thousands of cases.
void write_selection(Hdf5File& out, const ReducedBody& body) {
  const SelectionRecord record = body.selection.value_or(SelectionRecord{});
  const auto count = static_cast<Eigen::Index>(record.cases.size());
  std::string names;
  MatrixX figures(count, 3);
  std::vector<std::int64_t> asked_counts;
  std::vector<std::int64_t> asked;
  for (Eigen::Index i = 0; i < count; ++i) {
    const SelectedCase& item = record.cases[static_cast<std::size_t>(i)];
    names += item.name + '\n';
    figures.row(i) << item.reached, item.eigenmode_error, item.basis_error;
    asked_counts.push_back(static_cast<std::int64_t>(item.modes.size()));
    asked.insert(asked.end(), item.modes.begin(), item.modes.end());
  }
  out.write("selection/is_automatic",
            std::vector<std::int64_t>{body.selection ? 1 : 0}, "1",
            "1 if eigenmodes were chosen by load cases");
  out.write("selection/measure", std::string(to_string(record.measure)),
            "what shares are of");
  out.write("selection/threshold", MatrixX::Constant(1, 1, record.threshold),
            "1", "share to reach");
  out.write("selection/candidates",
            std::vector<std::int64_t>{record.candidates}, "1",
            "eigenmodes to choose from");
  out.write("selection/modes",
            std::vector<std::int64_t>(record.modes.begin(), record.modes.end()),
            "1", "eigenmodes kept, from 0");
  out.write("selection/case_names", names, "load cases, one a line");
  out.write(
      "selection/case_figures", figures, "1",
      "a case a row: share reached, static error by eigenmodes, by basis");
  out.write("selection/case_mode_counts", asked_counts, "1",
            "eigenmodes that each case asks for");
  out.write("selection/case_modes", asked, "1", "these, case by case, from 0");
}

void write_content(Hdf5File& out, const ReducedBody& body) {
  out.write("format", kFormat, "what this file is");
  out.write("version", std::vector<std::int64_t>{kBodyFileVersion}, "1",
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
  out.write("lambda", MatrixX(body.lambda), "rad^2/s^2", "eigenvalues");
  out.write("counts", to_integers({body.groups.size(), body.interfaces.size()}),
            "1", "groups, interfaces");
  write_rows(out, body);
  write_groups(out, body);
  write_interfaces(out, body);
  write_selection(out, body);
}

// Reads with sizes and finiteness checked; every doubt is an InputError.
class Reader {
 public:
  Reader(const Hdf5File& in, const std::filesystem::path& file)
      : in_(in), file_(file) {}

  [[nodiscard]] MatrixX matrix(const std::string& name, Eigen::Index rows,
                               Eigen::Index columns) const {
    MatrixX m = in_.read_matrix(name);
    if (m.rows() != rows || m.cols() != columns) {
      fail(fmt::format("'{}' is {} x {}; expected {} x {}", name, m.rows(),
                       m.cols(), rows, columns));
    }
    if (!m.allFinite()) fail(fmt::format("'{}' is not finite", name));
    return m;
  }
  [[nodiscard]] std::int64_t integer(const std::string& name) const {
    const auto values = in_.read_integers(name);
    if (values.size() != 1) fail(fmt::format("'{}' is not one number", name));
    return values[0];
  }
  // Integers that are not negative, `count` of them (any number if negative).
  [[nodiscard]] std::vector<std::size_t> sizes(const std::string& name,
                                               std::int64_t count) const {
    const auto values = in_.read_integers(name);
    for (const std::int64_t v : values) {
      if (v < 0) fail(fmt::format("'{}' holds {}", name, v));
    }
    if (count >= 0 && static_cast<std::int64_t>(values.size()) != count) {
      fail(fmt::format("'{}' has {} entries; expected {}", name, values.size(),
                       count));
    }
    return to_sizes(values);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(
        fmt::format("'{}': {}; the reduced body is damaged, make it anew",
                    file_.string(), what));
  }
  [[nodiscard]] const Hdf5File& in() const { return in_; }

 private:
  const Hdf5File& in_;
  const std::filesystem::path& file_;
};

void read_rows(const Reader& reader, ReducedBody& body) {
  const Eigen::Index m = body.lambda.size();
  body.rows.tags = reader.sizes("rows/tags", -1);
  const auto n = static_cast<Eigen::Index>(body.rows.tags.size());
  body.rows.x_B = reader.matrix("rows/x_B", 3, n);
  body.rows.Phi_B = reader.matrix("rows/Phi_B", 3 * n, m);
  const auto corners = reader.sizes("rows/triangles", -1);
  if (corners.size() % 3 != 0) reader.fail("'rows/triangles' is cut short");
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
    table.rotation_rank =
        static_cast<int>(reader.integer(at + "rotation_rank"));
    table.flexibility = reader.matrix(at + "flexibility", 6, 6);
    body.interfaces.push_back(std::move(table));
  }
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

ModeMeasure read_measure(const Reader& reader) {
  try {
    return parse_measure(reader.in().read_text("selection/measure"));
  } catch (const InputError& error) {
    reader.fail(error.what());
  }
}

void read_selection(const Reader& reader, ReducedBody& body) {
  if (reader.integer("selection/is_automatic") == 0) return;
  SelectionRecord record;
  record.measure = read_measure(reader);
  record.threshold = reader.matrix("selection/threshold", 1, 1)(0, 0);
  record.candidates = static_cast<int>(reader.integer("selection/candidates"));
  const auto modes = reader.sizes("selection/modes", -1);
  record.modes.assign(modes.begin(), modes.end());
  const std::vector<std::string> names =
      split_lines(reader.in().read_text("selection/case_names"));
  const auto count = static_cast<std::int64_t>(names.size());
  const MatrixX figures = reader.matrix("selection/case_figures", count, 3);
  const auto asked_counts = reader.sizes("selection/case_mode_counts", count);
  const auto asked = reader.sizes("selection/case_modes", -1);
  std::size_t at = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (asked_counts[i] > asked.size() - at)
      reader.fail("'selection/case_modes' is cut short");
    const auto row = static_cast<Eigen::Index>(i);
    SelectedCase item{
        names[i], {}, figures(row, 0), figures(row, 1), figures(row, 2)};
    for (const std::size_t end = at + asked_counts[i]; at < end; ++at)
      item.modes.push_back(static_cast<int>(asked[at]));
    record.cases.push_back(std::move(item));
  }
  body.selection = std::move(record);
}

// Before HDF5 sees the file: a library that parses damaged structures can
// answer with anything, a crash included.
void check_seal(const std::filesystem::path& file) {
  const auto problem = [&](const std::string& what) {
    return InputError(fmt::format("'{}' {}", file.string(), what));
  };
  std::ifstream in(file, std::ios::binary);
  if (!in) throw problem("cannot be read; does it exist?");
  std::string seal(kSealSize, '\0');
  in.read(seal.data(), kSealSize);
  const std::optional<int> version = version_of(seal);
  if (!version) {
    throw problem(
        "is not a reduced body of this program's; make one of its mesh");
  }
  if (*version != kBodyFileVersion) {
    throw problem(
        fmt::format("has layout version {}; this program reads {}. Make the "
                    "reduced body anew",
                    *version, kBodyFileVersion));
  }
  if (!in || seal != make_seal(*version, calc_digest(in))) {
    throw problem(
        "is damaged (its digest does not match its content); make the reduced "
        "body anew");
  }
}

// A name beside `file` that no other writer uses at the same time.
std::filesystem::path make_part_name(const std::filesystem::path& file) {
  static std::atomic<unsigned> count{0};
  std::filesystem::path part = file;
  part += fmt::format(".part{}-{}", getpid(), count++);
  return part;
}

}  // namespace

void seal_body_file(const std::filesystem::path& file) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekg(kSealSize);
  if (!stream) {
    throw InputError(fmt::format("'{}' cannot be sealed; is it a reduced body?",
                                 file.string()));
  }
  const std::string seal = make_seal(kBodyFileVersion, calc_digest(stream));
  stream.clear();  // of the end of the file, to which the digest has read
  stream.seekp(0);
  stream.write(seal.data(), static_cast<std::streamsize>(seal.size()));
  stream.close();
  if (!stream) {
    throw InputError(
        fmt::format("'{}' cannot be sealed; is the disk full?", file.string()));
  }
}

void write_body(const ReducedBody& body, const std::filesystem::path& file) {
  // Whole or not at all: write beside it, then rename.
  const std::filesystem::path part = make_part_name(file);
  try {
    Hdf5File out = Hdf5File::create(part, kSealSize);
    write_content(out, body);
    out.close();
    seal_body_file(part);
    std::filesystem::rename(part, file);
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw InputError(fmt::format("the reduced body '{}' cannot be written: {}",
                                 file.string(), error.what()));
  }
}

ReducedBody read_body(const std::filesystem::path& file) {
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
  body.integrals.P = reader.matrix("integrals/P", 3, m);
  read_rows(reader, body);
  const auto counts = reader.sizes("counts", 2);
  read_groups(reader, counts[0], body);
  read_interfaces(reader, counts[1], body);
  read_selection(reader, body);
  return body;
}

}  // namespace limber::flexbody
