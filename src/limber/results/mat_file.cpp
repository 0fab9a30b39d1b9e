// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/mat_file.hpp"

#include <fmt/format.h>
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>

#include "limber/common/errors.hpp"

namespace limber::results {
namespace {

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

// The library copies the values, which it does not change.
Variable make_variable(const char* name, matio_classes kind, matio_types type,
                       std::size_t rows, std::size_t columns,
                       const void* values) {
  std::array<std::size_t, 2> size{rows, columns};
  return Variable(Mat_VarCreate(name, kind, type, 2, size.data(),
                                const_cast<void*>(values), 0));
}

Variable make_text(const char* name, const std::string& text) {
  return make_variable(name, MAT_C_CHAR, MAT_T_UTF8, text.empty() ? 0 : 1,
                       text.size(), text.data());
}

}  // namespace

struct MatFile::Handle {
  int memory = memfd_create("mat_file", MFD_CLOEXEC);
  mat_t* mat = nullptr;

  Handle() {
    if (memory >= 0) {
      mat =
          Mat_CreateVer(fmt::format("/proc/self/fd/{}", memory).c_str(),
                        "MATLAB 5.0 MAT-file, written by Limber", MAT_FT_MAT5);
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (mat != nullptr) Mat_Close(mat);
    if (memory >= 0) close(memory);
  }

  static void check(bool works) {
    if (works) return;
    throw NumericalError("no memory is left for the MAT file");
  }
  void write(const Variable& variable) const {
    check(variable != nullptr &&
          Mat_VarWrite(mat, variable.get(), MAT_COMPRESSION_NONE) == 0);
  }
};

MatFile::MatFile() : handle_(std::make_unique<Handle>()) {
  Handle::check(handle_->mat != nullptr);
}

MatFile::~MatFile() = default;

void MatFile::add(const std::string& name, const MatrixX& matrix) {
  handle_->write(make_variable(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE,
                               static_cast<std::size_t>(matrix.rows()),
                               static_cast<std::size_t>(matrix.cols()),
                               matrix.data()));
}

void MatFile::add(const std::string& name,
                  const std::vector<std::string>& texts) {
  std::vector<matvar_t*> cells;  // the cell array owns them
  for (const std::string& text : texts) {
    cells.push_back(make_text(nullptr, text).release());
  }
  handle_->write(make_variable(name.c_str(), MAT_C_CELL, MAT_T_CELL,
                               texts.size(), 1, cells.data()));
}

std::string MatFile::finish() {
  Handle& of = *handle_;
  Mat_Close(of.mat);
  of.mat = nullptr;
  const off_t size = lseek(of.memory, 0, SEEK_END);
  Handle::check(size > 0);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = pread(of.memory, bytes.data() + done,
                                bytes.size() - done, static_cast<off_t>(done));
    Handle::check(count > 0);
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

}  // namespace limber::results
