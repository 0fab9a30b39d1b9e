// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/body_file_stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/material/section_place.hpp"

namespace limber::flexbody {
namespace {

template <typename Number>
std::vector<std::int64_t> to_int64(const std::vector<Number>& values) {
  return {values.begin(), values.end()};
}

std::string name_stress_rows(std::size_t interface) {
  return fmt::format("stress/interfaces/{:04}/rows", interface);
}

// Files of isotropic solids have none.
std::string name_axes(bool has_sections) {
  return has_sections ? "stress/sections/axes" : "stress/axes";
}

// Rows of the body, below `count`.
std::vector<std::size_t> read_rows(const BodyFileReader& reader,
                                   const std::string& name, std::size_t count) {
  std::vector<std::size_t> rows = reader.sizes(name, -1);
  for (const std::size_t row : rows) {
    if (row >= count) {
      reader.fail(
          fmt::format("'{}' holds {}, not one of {} rows", name, row, count));
    }
  }
  return rows;
}

// Every row of the body once at least, in order.
std::vector<std::size_t> read_points(const BodyFileReader& reader,
                                     std::size_t count) {
  std::vector<std::size_t> rows = reader.sizes("stress/rows", -1);
  std::size_t next = 0;
  for (const std::size_t row : rows) {
    if (row != next && row + 1 != next) {
      reader.fail(
          fmt::format("'stress/rows' holds {} in place of {}", row, next));
    }
    next = row + 1;
  }
  if (next != count) {
    reader.fail(fmt::format("'stress/rows' ends before row {}", count));
  }
  return rows;
}

// Rows of the body, in order.
std::vector<std::size_t> read_places(const BodyFileReader& reader,
                                     std::size_t count) {
  std::vector<std::size_t> rows = read_rows(reader, "stress/rows", count);
  if (!std::is_sorted(rows.begin(), rows.end())) {
    reader.fail("'stress/rows' is not in order");
  }
  return rows;
}

// `count` numbers below `limit`.
std::vector<int> read_choices(const BodyFileReader& reader,
                              const std::string& name, std::size_t count,
                              Eigen::Index limit) {
  std::vector<int> choices;
  for (const std::size_t value :
       reader.sizes(name, static_cast<std::int64_t>(count))) {
    if (static_cast<Eigen::Index>(value) >= limit) {
      reader.fail(fmt::format("'{}' has the value {}; expected below {}", name,
                              value, limit));
    }
    choices.push_back(static_cast<int>(value));
  }
  return choices;
}

void write_sections(Hdf5File& out, const SectionModes& sections) {
  const std::string at = "stress/sections/";
  out.write(at + "nodes", to_int64(sections.nodes), "1",
            "row of the node of each point");
  out.write(at + "faces", to_int64(sections.faces), "1",
            "0 bottom, 1 bottom of an inner ply, 2 middle, 3 top of an inner "
            "ply, 4 top of a shell; 5 outline of a beam; 6 of a solid; 7 "
            "inside of a beam's outline");
  out.write(at + "plies", to_int64(sections.plies), "1",
            "ply from the bottom, 0 of one alone; point on a beam's outline");
  out.write(at + "strengths", sections.strengths, "Pa, Pa^-2",
            "Xt, Xc, Yt, Yc, S, F12, 6 x p; zeros: not known");
  out.write(at + "counts",
            to_int64(std::vector<std::size_t>{sections.left_out,
                                              sections.bare_beams}),
            "1", "points whose node is not kept, beams without points");
  out.write(at + "elements", to_int64(sections.elements), "1",
            "number of the beam of each end");
  out.write(at + "ends", to_int64(sections.ends), "1",
            "row of the node of each end");
  out.write(at + "Force", sections.Force, "kg^1/2 s^-2, kg^1/2 m s^-2",
            "section forces per modal coordinate, 6 rows an end: N, Vy, Vz, T, "
            "My, Mz");
}

SectionModes read_sections(const BodyFileReader& reader, std::size_t points,
                           const ReducedBody& body) {
  const std::string at = "stress/sections/";
  const std::size_t rows = body.rows.tags.size();
  const auto p = static_cast<Eigen::Index>(points);
  SectionModes sections;
  sections.nodes = read_rows(reader, at + "nodes", rows);
  if (sections.nodes.size() != points) {
    reader.fail(fmt::format("'{}nodes' has {} entries; expected {}", at,
                            sections.nodes.size(), points));
  }
  sections.faces = read_choices(reader, at + "faces", points, kSectionFaces);
  sections.plies = read_choices(reader, at + "plies", points,
                                std::numeric_limits<int>::max());
  sections.strengths = reader.matrix(at + "strengths", 6, p);
  const auto counts = reader.sizes(at + "counts", 2);
  sections.left_out = counts[0];
  sections.bare_beams = counts[1];
  sections.ends = read_rows(reader, at + "ends", rows);
  const auto ends = std::ssize(sections.ends);
  sections.elements = reader.sizes(at + "elements", ends);
  sections.Force = reader.matrix(at + "Force", 6 * ends, body.lambda.size());
  return sections;
}

}  // namespace

void write_stress_modes(Hdf5File& out, const ReducedBody& body) {
  if (!body.stress) return;
  const StressModes& modes = *body.stress;
  out.write("stress/other_tables",
            std::vector<std::int64_t>{body.contact_surfaces.empty() ? 0 : 1,
                                      body.manifold ? 1 : 0},
            "1", "1 if there are contact surfaces, second-order kinematics");
  out.write("stress/rows", to_int64(modes.rows), "1",
            "row of each point; a node has one for each of its materials");
  out.write("stress/materials", to_int64(modes.materials), "1",
            "column of 'constants' of each point");
  out.write("stress/on_surface", to_int64(modes.on_surface), "1",
            "1 for points on the body's boundary");
  out.write("stress/Sigma_B", modes.Sigma_B, "kg^1/2 m^-2 s^-2",
            "stress per modal coordinate, then per product of paired ones, "
            "6 rows a point: xx, yy, zz, xy, yz, xz");
  if (modes.axes.cols() > 0) {
    out.write(name_axes(modes.sections.exist()), modes.axes, "1",
              "axes 1, 2, 3 of each point in B, 9 x p");
  }
  if (modes.sections.exist()) {
    write_sections(out, modes.sections);
  } else {
    out.write("stress/averaging", modes.averaging, "rad^2/s^2",
              "compliance of (averaged - element's stress), m x m");
  }
  out.write("stress/constants", modes.constants, "Pa, 1",
            "Young's modulus, Poisson's ratio of each material");
  for (std::size_t i = 0; i < modes.interface_rows.size(); ++i) {
    out.write(name_stress_rows(i), to_int64(modes.interface_rows[i]), "1",
              "rows of the interface's nodes");
  }
}

OtherTables read_other_tables(const BodyFileReader& reader) {
  const auto flags = reader.sizes("stress/other_tables", 2);
  return {flags[0] != 0, flags[1] != 0};
}

void read_stress_modes(const BodyFileReader& reader, Eigen::Index products,
                       bool has_sections, ReducedBody& body) {
  const Eigen::Index m = body.lambda.size();
  StressModes modes;
  modes.rows = has_sections ? read_places(reader, body.rows.tags.size())
                            : read_points(reader, body.rows.tags.size());
  const std::size_t points = modes.rows.size();
  modes.constants =
      reader.matrix("stress/constants", 2,
                    reader.in().read_matrix("stress/constants").cols());
  modes.materials =
      read_choices(reader, "stress/materials", points, modes.constants.cols());
  modes.on_surface = read_choices(reader, "stress/on_surface", points, 2);
  const Eigen::Index columns = reader.in().read_matrix("stress/Sigma_B").cols();
  if (columns != m && columns != m + products) {
    reader.fail(fmt::format("'stress/Sigma_B' has {} columns; expected {}",
                            columns, m + products));
  }
  modes.Sigma_B =
      reader.matrix("stress/Sigma_B", 6 * std::ssize(modes.rows), columns);
  if (has_sections || reader.in().has(name_axes(false))) {
    modes.axes =
        reader.matrix(name_axes(has_sections), 9, std::ssize(modes.rows));
  }
  if (has_sections) {
    modes.sections = read_sections(reader, points, body);
  } else {
    modes.averaging = reader.matrix("stress/averaging", m, m);
  }
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    modes.interface_rows.push_back(
        read_rows(reader, name_stress_rows(i), body.rows.tags.size()));
  }
  body.stress = std::move(modes);
}

}  // namespace limber::flexbody
