// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh_file_kind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

constexpr std::size_t kHead = 1 << 16;

std::string list_extensions() {
  return fmt::format("{}", fmt::join(kMeshFileExtensions, ", "));
}

/// The first bytes of a regular file.
std::string read_head(const std::filesystem::path& file) {
  try {
    InputFile in(file, kMeshInput);
    std::string head(kHead, '\0');
    head.resize(in.read(head.data(), head.size()));
    return head;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}. Expected a mesh or geometry ({}).",
                                 error.what(), list_extensions()));
  }
}

bool has(std::string_view head, std::string_view text) {
  return head.find(text) != std::string_view::npos;
}

std::string_view first_line(std::string_view head) {
  return head.substr(0, head.find_first_of("\r\n"));
}

bool is_msh(std::string_view head) {
  return head.starts_with("$MeshFormat") || head.starts_with("$NOD") ||
         head.starts_with("$Comments");
}

bool is_step(std::string_view head) {
  return has(head.substr(0, 1000), "ISO-10303-21");
}

bool is_brep(std::string_view head) {
  return has(head.substr(0, 1000), "DBRep_DrawableShape") ||
         has(head.substr(0, 1000), "CASCADE Topology");
}

// Column 73 of a line names its section; Start comes first.
bool is_iges(std::string_view head) {
  const std::string_view line = first_line(head);
  return line.size() >= 73 && (line[72] == 'S' || line[72] == 'C');
}

bool is_nastran(std::string_view head) {
  if (has(head, std::string_view("\0", 1))) return false;
  const std::string text = to_upper(std::string(head));
  return has(text, "GRID") || has(text, "BEGIN BULK") || has(text, "INCLUDE ");
}

// Its first line that is no comment is a keyword.
bool is_input_deck(std::string_view head) {
  if (has(head, std::string_view("\0", 1))) return false;
  while (!head.empty()) {
    const std::string_view line = first_line(head);
    const std::size_t start = line.find_first_not_of(" \t");
    if (start != std::string_view::npos &&
        !line.substr(start).starts_with("**")) {
      return line[start] == '*';
    }
    head.remove_prefix(std::min(line.size() + 1, head.size()));
  }
  return false;
}

bool is_unv(std::string_view head) {
  const std::size_t start = head.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return false;
  return first_line(head.substr(start)).starts_with("-1");
}

bool is_med(std::string_view head) { return head.starts_with("\x89HDF\r\n"); }

bool is_vtk(std::string_view head) {
  return head.starts_with("# vtk DataFile");
}

// A geometry program has no signature: any other text.
bool is_geo(std::string_view head) {
  if (head.find('\0') != std::string_view::npos) return false;
  return !head.starts_with("$") && !is_input_deck(head) && !is_step(head) &&
         !is_brep(head) && !is_med(head) && !is_vtk(head);
}

/// A file format, with its part of kMeshFileExtensions.
struct Format {
  std::vector<std::string_view> extensions;
  std::string_view name;
  MeshFileKind kind;
  bool (*is_it)(std::string_view head);
};

const std::vector<Format>& formats() {
  using enum MeshFileKind;
  static const std::vector<Format> known = {
      {{".msh"}, "Gmsh mesh", mesh, is_msh},
      {{".step", ".stp"}, "STEP geometry", geometry, is_step},
      {{".brep"}, "OpenCASCADE geometry", geometry, is_brep},
      {{".iges", ".igs"}, "IGES geometry", geometry, is_iges},
      {{".bdf", ".nas", ".dat"}, "Nastran mesh", bulk_data, is_nastran},
      {{".inp"}, "input file of Abaqus or CalculiX", input_deck, is_input_deck},
      {{".unv"}, "I-deas mesh", universal, is_unv},
      {{".med"}, "MED mesh", mesh, is_med},
      {{".vtk"}, "VTK mesh", mesh, is_vtk},
      {{".geo"}, "Gmsh geometry", geometry, is_geo}};
  return known;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return text;
}

const Format& find_format(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const std::string small = lower(extension);
  for (const Format& format : formats()) {
    if (std::count(format.extensions.begin(), format.extensions.end(), small) ==
        0) {
      continue;
    }
    if (extension == small || extension == to_upper(extension)) return format;
    throw InputError(fmt::format(
        "{}: Gmsh does not recognise files ending in '{}'; rename it to '{}'.",
        file.string(), extension, small));
  }
  throw InputError(fmt::format("{}: unknown kind of file '{}'. Expected {}.",
                               file.string(), extension, list_extensions()));
}

}  // namespace

MeshFileKind find_mesh_file_kind(const std::filesystem::path& file) {
  const Format& format = find_format(file);
  const std::string head = read_head(file);
  if (format.is_it(head)) return format.kind;
  std::string_view other;
  for (const Format& candidate : formats()) {
    if (&candidate != &format && candidate.is_it(head)) {
      other = candidate.name;
      break;
    }
  }
  throw InputError(
      fmt::format("{}: its name indicates {}, but its content does not{}.",
                  file.string(), format.name,
                  other.empty() || head.empty()
                      ? std::string(head.empty() ? ": it is empty" : "")
                      : fmt::format("; it may be a {}", other)));
}

double find_stated_unit(const std::filesystem::path& file) {
  constexpr double kMillimetre = 1e-3;
  const Format& format = find_format(file);
  const bool is_converted = format.is_it == is_step || format.is_it == is_iges;
  return is_converted ? kMillimetre : 0.0;
}

void check_mesh_options(const std::filesystem::path& file, MeshFileKind kind,
                        const MeshOptions& options) {
  const std::string name = file.string();
  std::vector<std::string> problems;
  if (!(options.unit >= 0.0) || !std::isfinite(options.unit))
    problems.push_back(
        fmt::format("{}: length unit {} m; expected a positive number, or 0 "
                    "for the file's own.",
                    name, options.unit));
  if (!(options.size >= 0.0) || !std::isfinite(options.size))
    problems.push_back(fmt::format(
        "{}: mesh size {}; expected a positive number, or 0 for the file's "
        "own.",
        name, options.size));
  if (options.order < 0 || options.order > 3)
    problems.push_back(
        fmt::format("{}: element order {}; expected 1, 2 or 3, or 0 for the "
                    "file's own.",
                    name, options.order));
  const bool asks =
      options.size > 0.0 || (options.order > 0 && options.order != 2);
  if (kind != MeshFileKind::geometry && asks)
    problems.push_back(fmt::format(
        "{}: a mesh size or order was given, but the file is a finished mesh. "
        "Expected none, or order 2, which a mesh of first order can be given; "
        "or its geometry (.geo, .step).",
        name));
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace limber::fem
