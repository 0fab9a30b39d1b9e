// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::fem {

struct MeshOptions {
  double size = 0.0;  ///< element size [mesh units]; 0: the file's
  int order = 0;      ///< 1 to 3; 0: the file's, else 2 [-]
  double unit = 1.0;  ///< metres per mesh unit [m]
};

}  // namespace limber::fem
