// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limber::fem {

struct MeshOptions {
  /// Element size; 0: the file's [mesh units, of STEP and IGES millimetres].
  double size = 0.0;
  /// 1 to 3; 0: the file's, else 2. Of a finished mesh 2 alone: nodes in the
  /// middle of the edges, if it is of first order [-].
  int order = 0;
  /// Metres per mesh unit; 0: the file's, where it states one, else 1 [m].
  double unit = 0.0;
  /// Newtons per unit of force of a deck's materials; 0: not stated [N].
  double force = 0.0;
  /// Cards of a deck (keywords, elements) that may be left out.
  std::vector<std::string> ignored = {};
  /// Elements of surfaces and curves with their nodes, too, all of a dimension
  /// as a group without name; there may be no solids.
  bool with_surfaces = false;
};

}  // namespace limber::fem
