// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::fem {

/// While any instance exists, in any thread, BLAS and OpenMP use one thread
/// each, so that factors and solutions are bitwise the same on any number of
/// cores. On the small blocks of a triangular solve, starting threads also
/// costs several times what they save. Works with OpenBLAS and GNU OpenMP,
/// otherwise has no effect. The settings are process-wide; the last instance
/// restores what the first one found.
class SerialBlas {
 public:
  SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;
  ~SerialBlas();
};

}  // namespace limber::fem
