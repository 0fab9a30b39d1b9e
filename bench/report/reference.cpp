// SPDX-License-Identifier: BSD-3-Clause
#include "reference.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "limber/common/errors.hpp"

namespace limber::bench {

Reference read_reference(const std::string& name) {
  const auto path = find_source_file("tests/data/beam/" + name);
  std::ifstream file(path);
  Reference reference;
  std::vector<double> values;
  std::string line;
  std::getline(file, line);  // how it was made
  std::getline(file, line);  // names of columns
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    reference.times.push_back(std::stod(cell));
    while (std::getline(cells, cell, ',')) values.push_back(std::stod(cell));
  }
  const auto count = std::ssize(reference.times);
  if (count == 0 || std::ssize(values) != 9 * count) {
    throw InputError(fmt::format(
        "'{}' does not hold times and nine displacements", path.string()));
  }
  reference.u = Eigen::Map<const MatrixX>(values.data(), 9, count);
  return reference;
}

MatrixX follow_corners(const dynamics::SystemModel& model, const Run& run) {
  const flexbody::ReducedBody& body = *model.bodies[0].reduced;
  MatrixX u(9, std::ssize(run.states));
  const std::vector<Vector3> corners = {Vector3::Zero(),
                                        Vector3(0.0, 0.0, kLength),
                                        Vector3(kSide, kSide, kLength)};
  for (std::size_t c = 0; c < corners.size(); ++c) {
    u.middleRows<3>(3 * static_cast<Eigen::Index>(c)) = follow_row(
        model, run.states, flexbody::find_nearest_row(body, corners[c]));
  }
  return u;
}

Difference compare(const MatrixX& u, const Reference& reference) {
  const MatrixX d = u - reference.u;
  Difference difference;
  for (Eigen::Index j = 0; j < d.cols(); ++j) {
    const double size = reference.u.col(j).norm();
    difference.percent.push_back(size > 0.0 ? 100.0 * d.col(j).norm() / size
                                            : 0.0);
  }
  difference.overall = 100.0 * d.norm() / reference.u.norm();
  return difference;
}

}  // namespace limber::bench
