// SPDX-License-Identifier: BSD-3-Clause
#include "fem/serial_blas.hpp"

#include <dlfcn.h>

namespace limber::fem {
namespace {

// Looked up by name: which BLAS is loaded is the system's choice.
template <typename Function>
Function find_function(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

using Set = void (*)(int);
using Get = int (*)();

struct Switches {
  Set set_blas = find_function<Set>("openblas_set_num_threads");
  Get get_blas = find_function<Get>("openblas_get_num_threads");
  Set set_omp = find_function<Set>("omp_set_max_active_levels");
  Get get_omp = find_function<Get>("omp_get_max_active_levels");
};

const Switches& switches() {
  static const Switches found;
  return found;
}

}  // namespace

SerialBlas::SerialBlas(bool is_on) {
  if (!is_on) return;
  const Switches& s = switches();
  if (s.set_blas != nullptr && s.get_blas != nullptr) {
    blas_threads_ = s.get_blas();
    s.set_blas(1);
  }
  if (s.set_omp != nullptr && s.get_omp != nullptr) {
    omp_levels_ = s.get_omp();
    s.set_omp(0);
  }
}

SerialBlas::~SerialBlas() {
  if (blas_threads_ > 0) switches().set_blas(blas_threads_);
  if (omp_levels_ > 0) switches().set_omp(omp_levels_);
}

}  // namespace limber::fem
