// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/reduction/matrices/matrix_part.hpp"
#include "limber/reduction/modal/elastic_body.hpp"

/// Part of limber_reduction.
namespace limber::flexbody {

/// A recipe's body of a model given by matrices. Fields have six rows a node
/// (field_row).
struct MatrixBody : ElasticBody {
  /// @throws InputError for a set, node or option that the matrices do not
  /// have, and for clamps that leave a rigid motion
  MatrixBody(const Recipe& recipe, std::shared_ptr<const MatrixPart> its_part);

  std::shared_ptr<const MatrixPart> part;
  std::vector<int> rows;  ///< of the system that are free, sorted

 private:
  struct Parts;
  explicit MatrixBody(Parts parts);
};

}  // namespace limber::flexbody
