// SPDX-License-Identifier: BSD-3-Clause
#include "unit/fem/matrices/sample_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "limber/common/errors.hpp"
#include "places.hpp"
#include "support/temporary_folder.hpp"

namespace limber::fem::test {

std::filesystem::path sample_folder(const std::string& name) {
  return std::filesystem::path(LIMBER_SOURCE_DIR) / "tests/data/matrices" /
         name;
}

MatrixModel read_sample(const std::string& name) {
  return read_matrices({{sample_folder(name)}});
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::filesystem::path copy_sample(const std::string& name) {
  static int count = 0;
  const std::filesystem::path folder =
      limber::test::own_folder() / (name + "_" + std::to_string(++count));
  std::filesystem::copy(sample_folder(name), folder);
  return folder;
}

void replace_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string find_read_error(const std::filesystem::path& folder) {
  try {
    static_cast<void>(read_matrices({{folder}}));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::map<EntryKey, double> list_entries(const MatrixModel& model,
                                        const ModelMatrix& matrix) {
  std::map<EntryKey, double> entries;
  const auto tag = [&](const MatrixRow& row) {
    return row.node < 0 ? std::size_t{0}
                        : model.tags[static_cast<std::size_t>(row.node)];
  };
  for (int j = 0; j < matrix.entries.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix.entries, j); it;
         ++it) {
      if (it.value() == 0.0) continue;
      const MatrixRow& row = model.rows[static_cast<std::size_t>(it.row())];
      const MatrixRow& column = model.rows[static_cast<std::size_t>(j)];
      entries[{tag(row), row.component, tag(column), column.component}] =
          it.value();
    }
  }
  return entries;
}

double compare_entries(const std::map<EntryKey, double>& a,
                       const std::map<EntryKey, double>& b) {
  double largest = 0.0;
  double difference = 0.0;
  for (const auto* const one : {&a, &b}) {
    const auto& other = one == &a ? b : a;
    for (const auto& [key, value] : *one) {
      const auto found = other.find(key);
      const double mirror = found == other.end() ? 0.0 : found->second;
      largest = std::max(largest, std::abs(value));
      difference = std::max(difference, std::abs(value - mirror));
    }
  }
  return difference / largest;
}

MatrixX rigid_motions(const MatrixModel& model) {
  MatrixX X = MatrixX::Zero(static_cast<Eigen::Index>(model.rows.size()), 6);
  for (std::size_t i = 0; i < model.rows.size(); ++i) {
    const auto [node, component] = model.rows[i];
    if (component < 0) continue;
    const auto row = static_cast<Eigen::Index>(i);
    X(row, component) = 1.0;
    if (component > 2) continue;
    for (int axis = 0; axis < 3; ++axis)
      X(row, 3 + axis) =
          Vector3::Unit(axis).cross(model.x.col(node))[component];
  }
  return X;
}

}  // namespace limber::fem::test
