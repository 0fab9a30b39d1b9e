// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/serial_blas.hpp"

#include <dlfcn.h>

#include <mutex>

#include "limber/fem/linalg/cholmod_library.hpp"

namespace limber::fem {
namespace {

// Looked up by name, since the system chooses which BLAS is loaded.
template <typename Function>
Function find_function(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

// A process-wide thread count of a library.
class Setting {
 public:
  Setting(const char* set, const char* get)
      : set_(find_function<void (*)(int)>(set)),
        get_(find_function<int (*)()>(get)) {}

  void change(int value) {
    if (set_ == nullptr || get_ == nullptr) return;
    before_ = get_();
    set_(value);
  }
  void restore() {
    if (set_ != nullptr && get_ != nullptr) set_(before_);
  }

 private:
  void (*set_)(int);
  int (*get_)();
  int before_ = 1;
};

// Counts the live instances.
class Switch {
 public:
  void enter() {
    const std::lock_guard lock(mutex_);
    if (count_++ > 0) return;
    blas_.change(1);
    omp_.change(0);
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    if (--count_ > 0) return;
    blas_.restore();
    omp_.restore();
  }

 private:
  std::mutex mutex_;
  int count_ = 0;
  Setting blas_{"openblas_set_num_threads", "openblas_get_num_threads"};
  Setting omp_{"omp_set_max_active_levels", "omp_get_max_active_levels"};
};

Switch& process_switch() {
  static_cast<void>(cholmod());  // its BLAS must be loaded to be found
  static Switch only;
  return only;
}

}  // namespace

SerialBlas::SerialBlas() { process_switch().enter(); }
SerialBlas::~SerialBlas() { process_switch().leave(); }

}  // namespace limber::fem
