// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/read_matrices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/matrices/file_set.hpp"
#include "limber/fem/matrices/recovery.hpp"
#include "limber/fem/matrices/row_labels.hpp"
#include "limber/fem/matrices/second_moments.hpp"

namespace limber::fem {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

class ModelMaker {
 public:
  explicit ModelMaker(const MatrixFiles& files)
      : set_(read_file_set(files.paths, files.recovery)) {}

  MatrixModel make() {
    choose();
    check_axes();
    label_matrices();
    unite_rows();
    check_recovery(set_, labels_.size());
    make_nodes();
    make_rows();
    tell_roles_apart();
    take_second_moments(set_, model_);
    note_matrices();
    add_sets();
    if (set_.is_calculix && set_.deck)
      add_constraints(*set_.deck, labels_, model_);
    add_recovery(set_, labels_, places_, model_);
    if (set_.nodes) add_pictures(set_.nodes->elements, model_);
    return std::move(model_);
  }

 private:
  void choose() {
    K_ = find_role(set_, MatrixRole::stiffness, "stiffness");
    M_ = find_role(set_, MatrixRole::mass, "mass");
    std::vector<SourceMatrix*> unknown;
    for (SourceMatrix& source : set_.matrices)
      if (source.role == MatrixRole::unknown) unknown.push_back(&source);
    if (K_ == nullptr && M_ == nullptr && unknown.size() == 2) {
      K_ = unknown[0];
      M_ = unknown[1];
      is_guess_ = true;
    } else if (unknown.size() == 1 && (K_ == nullptr) != (M_ == nullptr)) {
      (K_ == nullptr ? K_ : M_) = unknown[0];
    }
    if (K_ != nullptr && M_ != nullptr) return;
    throw InputError(fmt::format(
        "{}: no {} matrix. Found: {}. Expected a stiffness and a mass matrix "
        "and, where they only number their rows, which node and component "
        "each row is.",
        set_.source,
        K_ != nullptr   ? "mass"
        : M_ != nullptr ? "stiffness"
                        : "stiffness and no mass",
        list_found(set_)));
  }

  /// Abaqus writes rows in the axes of *TRANSFORM, CalculiX in the global ones.
  void check_axes() const {
    if (!set_.is_calculix && set_.deck && set_.deck->has_transform)
      throw InputError(
          fmt::format("{}: *TRANSFORM rotates the axes of rows. Expected none: "
                      "remove it before the matrices are written.",
                      set_.deck->model.file.string()));
  }

  void label_matrices() {
    // Files without a head do not state rows beyond their last entry.
    const Eigen::Index most =
        std::max(K_->matrix.entries.rows(), M_->matrix.entries.rows());
    for (SourceMatrix* source : {K_, M_}) {
      if (!source->labels.empty()) continue;
      const bool has_size = source->format != "coordinates";
      label_rows(set_, has_size ? source->matrix.entries.rows() : most,
                 *source);
    }
  }

  /// Common rows of both matrices, in the order of the one that is numbered.
  void unite_rows() {
    if (K_->labels == M_->labels && is_sorted_or_numbered()) {
      labels_ = K_->labels;
    } else {
      labels_ = K_->labels;
      labels_.insert(labels_.end(), M_->labels.begin(), M_->labels.end());
      std::sort(labels_.begin(), labels_.end());
      labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
      for (SourceMatrix* source : {K_, M_}) reorder(*source);
    }
    model_.stiffness = std::move(K_->matrix);
    model_.mass = std::move(M_->matrix);
  }

  [[nodiscard]] bool is_sorted_or_numbered() const {
    return K_->format != "DMIG" && K_->format != "Abaqus matrix input";
  }

  /// Puts the rows of a matrix at their places in `labels_`.
  void reorder(SourceMatrix& source) {
    std::vector<int> place;
    for (const RowLabel& label : source.labels)
      place.push_back(static_cast<int>(
          std::lower_bound(labels_.begin(), labels_.end(), label) -
          labels_.begin()));
    const auto n = static_cast<Eigen::Index>(labels_.size());
    const SparseMatrix& from = source.matrix.entries;
    std::vector<int> columns(labels_.size(), -1);
    for (std::size_t i = 0; i < place.size(); ++i)
      columns[index(place[i])] = static_cast<int>(i);
    SparseMatrix to(n, n);
    to.reserve(from.nonZeros());
    std::vector<std::pair<int, double>> column;
    for (int j = 0; j < n; ++j) {
      to.startVec(j);
      column.clear();
      if (columns[index(j)] >= 0)
        for (SparseMatrix::InnerIterator it(from, columns[index(j)]); it; ++it)
          column.emplace_back(place[static_cast<std::size_t>(it.row())],
                              it.value());
      std::sort(column.begin(), column.end());
      for (const auto& [row, value] : column)
        to.insertBackByOuterInner(j, row) = value;
    }
    to.finalize();
    source.matrix.entries.swap(to);
  }

  /// Nodes with a row, or that a constraint of the input file moves.
  void make_nodes() {
    if (!set_.nodes)
      throw InputError(fmt::format(
          "{}: no nodes. Found: {}. Expected the positions of the nodes: a "
          "table node,x,y,z or the model's input file.",
          set_.source, list_found(set_)));
    std::vector<long> used;
    for (const RowLabel& label : labels_) used.push_back(label.node);
    if (set_.is_calculix && set_.deck) {
      for (const DeckRigid& rigid : set_.deck->rigids)
        used.insert(used.end(), rigid.nodes.begin(), rigid.nodes.end());
      for (const DeckEquation& equation : set_.deck->equations)
        used.push_back(equation.terms[0].first.node);
    }
    if (const SourceMatrix* const recovery = find_recovery(set_))
      for (const RowLabel& label : recovery->labels) used.push_back(label.node);
    std::sort(used.begin(), used.end());
    std::map<long, Vector3> nodes = list_points(set_);
    for (std::size_t i = 0; i < set_.nodes->tags.size(); ++i)
      if (std::binary_search(used.begin(), used.end(), set_.nodes->tags[i]))
        nodes[set_.nodes->tags[i]] = set_.nodes->x[i];
    if (nodes.empty())
      throw InputError(fmt::format(
          "{}: none of its nodes has a row of {}. Expected the nodes of the "
          "matrices.",
          set_.nodes->file.string(), K_->matrix.file));
    model_.x.resize(3, static_cast<Eigen::Index>(nodes.size()));
    for (const auto& [tag, x] : nodes) {
      places_[tag] = static_cast<int>(model_.tags.size());
      model_.x.col(static_cast<Eigen::Index>(model_.tags.size())) = x;
      model_.tags.push_back(static_cast<std::size_t>(tag));
    }
    const auto without =
        std::count_if(set_.nodes->tags.begin(), set_.nodes->tags.end(),
                      [&](long tag) { return !places_.contains(tag); });
    if (without > 0)
      set_.found.push_back(
          fmt::format("{} nodes have no rows (supported, "
                      "dependent or unused)",
                      without));
  }

  void make_rows() {
    long last = 0;
    for (const long tag : set_.nodes->tags) last = std::max(last, tag);
    std::size_t unknown = 0;
    for (const RowLabel& label : labels_) {
      const auto node = places_.find(label.node);
      const bool is_known = label.component >= 1 && label.component <= 6;
      // Internal nodes of the program (CalculiX: knots of expanded shells), and
      // scalar points, have no position.
      const bool may_lack =
          label.node < 0 || label.component == 0 || label.component > 6 ||
          (set_.is_calculix && (set_.is_expanded || label.node > last));
      if (node == places_.end() && !may_lack)
        throw InputError(fmt::format(
            "{}: node {} of row {} has no coordinates. Expected it among the "
            "nodes.",
            set_.nodes->file.string(), label.node, name_row(label)));
      MatrixRow row;
      if (node != places_.end()) {
        row.node = node->second;
        if (is_known) row.component = label.component - 1;
      }
      if (row.component < 0) ++unknown;
      model_.rows.push_back(row);
    }
    if (unknown > 0)
      set_.found.push_back(fmt::format("{} rows are of unknown kind", unknown));
  }

  /// Fraction of t' A t in the sum of |entries|, over translations t. A
  /// stiffness has none where the body is free.
  [[nodiscard]] double find_fraction(const SparseMatrix& A) const {
    double sum = 0.0;
    double absolute = 0.0;
    for (int j = 0; j < A.outerSize(); ++j) {
      const int component = model_.rows[index(j)].component;
      if (component < 0 || component > 2) continue;
      for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
        if (model_.rows[static_cast<std::size_t>(it.row())].component !=
            component)
          continue;
        sum += it.value();
        absolute += std::abs(it.value());
      }
    }
    return absolute > 0.0 ? std::abs(sum) / absolute : 0.0;
  }

  void tell_roles_apart() {
    constexpr double kNone = 1e-5;  // digits of a file of single precision
    constexpr double kMuch = 1e-3;
    const double k = find_fraction(model_.stiffness.entries);
    const double m = find_fraction(model_.mass.entries);
    const bool are_swapped = k > kMuch && m < kNone;
    if (is_guess_ && are_swapped) {
      std::swap(model_.stiffness, model_.mass);
      std::swap(K_, M_);
    } else if (is_guess_ && !(k < kNone && m > kMuch)) {
      throw InputError(fmt::format(
          "{}: which matrix is the stiffness is not clear: {} or {}. Expected "
          "names that begin with K and M, or 'stiff' and 'mass' in them.",
          set_.source, describe_matrix(*K_), describe_matrix(*M_)));
    } else if (are_swapped) {
      throw InputError(fmt::format(
          "{}: named a stiffness, it has a mass's sum of entries, and {} has "
          "that of a stiffness. Expected them the other way round.",
          model_.stiffness.file, model_.mass.file));
    }
  }

  void note_matrices() {
    std::vector<std::string> found;
    for (const auto& [source, matrix, role] :
         {std::tuple(K_, &model_.stiffness, "stiffness"),
          std::tuple(M_, &model_.mass, "mass")})
      found.push_back(fmt::format(
          "{}: {}, {}{}{}, {} rows, {}, {} digits",
          std::filesystem::path(matrix->file).filename().string(), role,
          source->format, source->name.empty() ? "" : " ", source->name,
          source->labels.size(), source->triangles, matrix->digits));
    for (const SourceMatrix& source : set_.matrices)
      if (source.role == MatrixRole::recovery)
        found.push_back(fmt::format(
            "{}: recovery, {}, {} rows, {} digits",
            std::filesystem::path(source.matrix.file).filename().string(),
            source.format, source.labels.size(), source.matrix.digits));
      else if (source.role == MatrixRole::moment)
        found.push_back(fmt::format(
            "{}: second moment of the mass",
            std::filesystem::path(source.matrix.file).filename().string()));
      else if (&source != K_ && &source != M_)
        found.push_back(fmt::format(
            "{}{}{}: not used",
            std::filesystem::path(source.matrix.file).filename().string(),
            source.name.empty() ? "" : " ", source.name));
    found.insert(found.end(), set_.found.begin(), set_.found.end());
    model_.found = std::move(found);
    model_.source = set_.source;
  }

  void add_sets() {
    for (const NamedNodes& set : set_.nodes->sets) {
      MatrixNodeSet nodes{set.name, {}};
      for (const long tag : set.nodes) {
        const auto found = places_.find(tag);
        if (found != places_.end()) nodes.nodes.push_back(found->second);
      }
      std::sort(nodes.nodes.begin(), nodes.nodes.end());
      nodes.nodes.erase(std::unique(nodes.nodes.begin(), nodes.nodes.end()),
                        nodes.nodes.end());
      if (!nodes.nodes.empty()) model_.sets.push_back(std::move(nodes));
    }
  }

  FileSet set_;
  SourceMatrix* K_ = nullptr;
  SourceMatrix* M_ = nullptr;
  bool is_guess_ = false;
  std::vector<RowLabel> labels_;  // of the common rows
  std::unordered_map<long, int> places_;
  MatrixModel model_;
};

}  // namespace

MatrixModel read_matrices(const MatrixFiles& files) {
  return ModelMaker(files).make();
}

}  // namespace limber::fem
