// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/body_file_stress.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace limber::flexbody {
namespace {

template <typename Number>
std::vector<std::int64_t> to_int64(const std::vector<Number>& values) {
  return {values.begin(), values.end()};
}

std::string name_stress_rows(std::size_t interface) {
  return fmt::format("stress/interfaces/{:04}/rows", interface);
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

// `count` numbers below `limit`.
std::vector<int> read_choices(const BodyFileReader& reader,
                              const std::string& name, std::size_t count,
                              Eigen::Index limit) {
  std::vector<int> choices;
  for (const std::size_t value :
       reader.sizes(name, static_cast<std::int64_t>(count))) {
    if (static_cast<Eigen::Index>(value) >= limit) {
      reader.fail(
          fmt::format("'{}' holds {}; expected below {}", name, value, limit));
    }
    choices.push_back(static_cast<int>(value));
  }
  return choices;
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
  out.write("stress/averaging", modes.averaging, "rad^2/s^2",
            "compliance of (averaged - element's stress), m x m");
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
                       ReducedBody& body) {
  const Eigen::Index m = body.lambda.size();
  StressModes modes;
  modes.rows = read_points(reader, body.rows.tags.size());
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
  modes.averaging = reader.matrix("stress/averaging", m, m);
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    modes.interface_rows.push_back(
        read_rows(reader, name_stress_rows(i), body.rows.tags.size()));
  }
  body.stress = std::move(modes);
}

}  // namespace limber::flexbody
