// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::fem {

/// While it lives, BLAS and OpenMP use one thread, where they can be told to:
/// on the small blocks of a triangular solution, waking threads costs several
/// times what they win. Works with OpenBLAS and GNU OpenMP; elsewhere it does
/// nothing. For the whole process: not to be held by two threads at once.
class SerialBlas {
 public:
  explicit SerialBlas(bool is_on = true);
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;
  ~SerialBlas();

 private:
  int blas_threads_ = 0;  // before; 0: left alone
  int omp_levels_ = 0;
};

}  // namespace limber::fem
