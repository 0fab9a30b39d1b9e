// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::fem {

struct MeshOptions {
  double size = 0.0;  ///< element size [mesh units]; 0: the file's
  /// 1 to 3; 0: the file's, else 2. Of a finished mesh 2 alone: nodes in the
  /// middle of the edges, if it is of first order [-].
  int order = 0;
  double unit = 1.0;  ///< metres per mesh unit [m]
};

}  // namespace limber::fem
