// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/matrices/matrix_model.hpp"

namespace limber::fem {

/// An element for pictures: its corner nodes in the order of Abaqus.
struct ModelElement {
  enum class Shape { line, triangle, quad, tetra, pyramid, wedge, hexa };
  Shape shape = Shape::line;
  std::vector<long> corners;
};

[[nodiscard]] std::size_t count_corners(ModelElement::Shape shape);

struct NamedNodes {
  std::string name;
  std::vector<long> nodes;
};

/// Nodes of a model, in the file's own numbers and length unit.
struct ModelFile {
  std::filesystem::path file;
  std::string format;
  std::vector<long> tags;
  std::vector<Vector3> x;  ///< beside tags
  /// Components of the rows of each node (123, 123456), where the file says
  /// them; beside tags, 0 where it does not.
  std::vector<long> components;
  std::vector<NamedNodes> sets;
  std::vector<ModelElement> elements;
  std::vector<std::string> notes;
};

/// Adds the lines, and the triangles of shells and outer faces of solids, of
/// elements whose nodes the model has.
void add_pictures(const std::vector<ModelElement>& elements,
                  MatrixModel& model);

}  // namespace limber::fem
