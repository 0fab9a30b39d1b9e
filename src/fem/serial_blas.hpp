// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::fem {

/// While one lives, in whatever thread, BLAS and OpenMP use one thread each,
/// where they can be told to: sums are then taken in one order, so that
/// factors and solutions are the same to the bit on any number of cores. On
/// the small blocks of a triangular solution waking threads also costs several
/// times what they win. Works with OpenBLAS and GNU OpenMP; elsewhere it does
/// nothing. Those settings belong to the whole process; the last to go restores
/// what the first has found.
class SerialBlas {
 public:
  SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;
  ~SerialBlas();
};

}  // namespace limber::fem
