// SPDX-License-Identifier: BSD-3-Clause
#include "fem/pivot_count.hpp"

#include <algorithm>
#include <cmath>

#include "fem/cholmod_view.hpp"

// BLAS, by its Fortran names: CHOLMOD's own library.
extern "C" {
void dgemm_(const char* transpose_a, const char* transpose_b, const int* m,
            const int* n, const int* k, const double* alpha, const double* a,
            const int* lda, const double* b, const int* ldb, const double* beta,
            double* c, const int* ldc);
void dtrsm_(const char* side, const char* uplo, const char* transpose,
            const char* diagonal, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b,
            const int* ldb);
}

namespace limber::fem {
namespace {

/// C += alpha A B^T, column-major with leading dimensions.
void add_product(int m, int n, int k, double alpha, const double* A, int lda,
                 const double* B, int ldb, double* C, int ldc) {
  const double one = 1.0;
  if (m > 0 && n > 0 && k > 0)
    dgemm_("N", "T", &m, &n, &k, &alpha, A, &lda, B, &ldb, &one, C, &ldc);
}

/// CHOLMOD's symbolic supernodal factor.
class Symbolic {
 public:
  Symbolic(const SparseMatrix& lower, const std::vector<int>& order) {
    common_.get()->supernodal = CHOLMOD_SUPERNODAL;
    factor_ = analyze(lower, order, common_);
  }
  ~Symbolic() { cholmod_free_factor(&factor_, common_.get()); }
  Symbolic(const Symbolic&) = delete;
  Symbolic& operator=(const Symbolic&) = delete;

  [[nodiscard]] int size() const { return static_cast<int>(factor_->n); }
  [[nodiscard]] int supernodes() const {
    return static_cast<int>(factor_->nsuper);
  }
  [[nodiscard]] int first_column(int s) const {
    return ints(factor_->super)[s];
  }
  [[nodiscard]] int columns(int s) const {
    return first_column(s + 1) - first_column(s);
  }
  /// Row indices of a supernode, its own columns first.
  [[nodiscard]] const int* rows(int s) const {
    return ints(factor_->s) + ints(factor_->pi)[s];
  }
  [[nodiscard]] int row_count(int s) const {
    return ints(factor_->pi)[s + 1] - ints(factor_->pi)[s];
  }
  [[nodiscard]] std::size_t offset(int s) const {
    return static_cast<std::size_t>(ints(factor_->px)[s]);
  }
  [[nodiscard]] std::size_t entries() const { return factor_->xsize; }
  [[nodiscard]] const int* permutation() const { return ints(factor_->Perm); }

 private:
  static const int* ints(const void* pointer) {
    return static_cast<const int*>(pointer);
  }
  CholmodCommon common_;
  cholmod_factor* factor_ = nullptr;
};

/// P A P^T, lower triangle.
SparseMatrix permute(const SparseMatrix& lower, const Symbolic& symbolic) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> place(
      symbolic.size());
  for (int k = 0; k < symbolic.size(); ++k)
    place.indices()[symbolic.permutation()[k]] = k;
  SparseMatrix permuted(lower.rows(), lower.cols());
  permuted.selfadjointView<Eigen::Lower>() =
      lower.selfadjointView<Eigen::Lower>().twistedBy(place);
  return permuted;
}

/// L D L^T without pivoting, left-looking by supernodes: the scheme of
/// CHOLMOD's supernodal Cholesky (Chen, Davis, Hager, Rajamanickam, ACM TOMS
/// 35, 2008, sec. 3) with signed pivots.
class SignedFactorisation {
 public:
  SignedFactorisation(const Symbolic& symbolic, const SparseMatrix& A)
      : symbolic_(symbolic),
        A_(A),
        values_(symbolic.entries(), 0.0),
        pivots_(static_cast<std::size_t>(symbolic.size())),
        map_(static_cast<std::size_t>(symbolic.size())),
        owner_(static_cast<std::size_t>(symbolic.size())),
        head_(static_cast<std::size_t>(symbolic.supernodes()), -1),
        next_(head_),
        done_rows_(head_.size(), 0),
        diagonal_(find_diagonal(A)) {
    for (int s = 0; s < symbolic_.supernodes(); ++s)
      for (int c = 0; c < symbolic_.columns(s); ++c)
        owner_[index(symbolic_.first_column(s) + c)] = s;
    for (int s = 0; s < symbolic_.supernodes(); ++s) process(s);
  }

  [[nodiscard]] PivotCount count() const {
    return {static_cast<int>(std::count_if(pivots_.begin(), pivots_.end(),
                                           [](double d) { return d < 0.0; })),
            growth_};
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  /// By a scan: the permuted columns are not sorted.
  static VectorX find_diagonal(const SparseMatrix& A) {
    VectorX diagonal = VectorX::Zero(A.cols());
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (SparseMatrix::InnerIterator it(A, j); it; ++it)
        if (it.row() == j) diagonal[j] = it.value();
    return diagonal;
  }

  void process(int s) {
    load(s);
    for (int d = head_[index(s)]; d >= 0;) {
      const int following = next_[index(d)];
      subtract(s, d);
      d = following;
    }
    factor(s);
    measure_growth(s);
    done_rows_[index(s)] = symbolic_.columns(s);
    hand_on(s);
  }

  /// Queues d at the supernode that owns its next row.
  void hand_on(int d) {
    const int done = done_rows_[index(d)];
    if (done >= symbolic_.row_count(d)) return;
    const int target = owner_[index(symbolic_.rows(d)[done])];
    next_[index(d)] = head_[index(target)];
    head_[index(target)] = d;
  }

  void load(int s) {
    const int rows = symbolic_.row_count(s);
    for (int r = 0; r < rows; ++r) map_[index(symbolic_.rows(s)[r])] = r;
    double* block = values_.data() + symbolic_.offset(s);
    for (int c = 0; c < symbolic_.columns(s); ++c)
      for (SparseMatrix::InnerIterator it(A_, symbolic_.first_column(s) + c);
           it; ++it)
        block[index(map_[static_cast<std::size_t>(it.row())]) +
              index(c) * index(rows)] = it.value();
  }

  /// Takes descendant d's part L D L^T off the columns of s.
  void subtract(int s, int d) {
    const int begin = done_rows_[index(d)];
    const int rows = symbolic_.row_count(d);
    const int columns = symbolic_.columns(d);
    const int* row = symbolic_.rows(d);
    const int last_column = symbolic_.first_column(s + 1);
    int end = begin;
    while (end < rows && row[end] < last_column) ++end;
    const int width = end - begin;
    const int height = rows - begin;
    const double* L = values_.data() + symbolic_.offset(d);
    scaled_.resize(index(width) * index(columns));
    for (int k = 0; k < columns; ++k)
      for (int j = 0; j < width; ++j)
        scaled_[index(j) + index(k) * index(width)] =
            L[index(begin + j) + index(k) * index(rows)] *
            pivots_[index(symbolic_.first_column(d) + k)];
    update_.assign(index(height) * index(width), 0.0);
    add_product(height, width, columns, 1.0, L + begin, rows, scaled_.data(),
                width, update_.data(), height);
    double* block = values_.data() + symbolic_.offset(s);
    const int block_rows = symbolic_.row_count(s);
    for (int j = 0; j < width; ++j) {
      double* column =
          block +
          index(row[begin + j] - symbolic_.first_column(s)) * index(block_rows);
      for (int i = j; i < height; ++i)
        column[map_[index(row[begin + i])]] -=
            update_[index(i) + index(j) * index(height)];
    }
    done_rows_[index(d)] = end;
    hand_on(d);
  }

  /// Dense L D L^T of the supernode's own block, panel by panel, and L below.
  void factor(int s) {
    constexpr int kPanel = 48;
    const int columns = symbolic_.columns(s);
    for (int k = 0; k < columns; k += kPanel) {
      const int width = std::min(kPanel, columns - k);
      factor_panel(s, k, width);
      update_right_of(s, k, width, kPanel);
    }
  }

  void factor_panel(int s, int k, int width) {
    const int rows = symbolic_.row_count(s);
    double* block = values_.data() + symbolic_.offset(s);
    double* d = pivots_.data() + symbolic_.first_column(s) + k;
    double* panel = block + index(k) + index(k) * index(rows);
    for (int j = 0; j < width; ++j) {
      double* column = panel + index(j) * index(rows);
      d[j] = column[j];
      for (int i = j + 1; i < width; ++i) column[i] /= d[j];
      for (int c = j + 1; c < width; ++c)
        for (int i = c; i < width; ++i)
          panel[index(i) + index(c) * index(rows)] -=
              column[i] * d[j] * column[c];
    }
    const int below = rows - k - width;
    if (below <= 0) return;
    const double one = 1.0;
    dtrsm_("R", "L", "T", "U", &below, &width, &one, panel, &rows,
           panel + width, &rows);
    for (int j = 0; j < width; ++j)
      for (int i = width; i < rows - k; ++i)
        panel[index(i) + index(j) * index(rows)] /= d[j];
  }

  void update_right_of(int s, int k, int width, int panel_width) {
    const int rows = symbolic_.row_count(s);
    const int columns = symbolic_.columns(s);
    double* block = values_.data() + symbolic_.offset(s);
    const double* d = pivots_.data() + symbolic_.first_column(s) + k;
    const double* L = block + index(k) * index(rows);
    for (int c = k + width; c < columns; c += panel_width) {
      const int part = std::min(panel_width, columns - c);
      scaled_.resize(index(part) * index(width));
      for (int j = 0; j < width; ++j)
        for (int i = 0; i < part; ++i)
          scaled_[index(i) + index(j) * index(part)] =
              L[index(c + i) + index(j) * index(rows)] * d[j];
      add_product(rows - c, part, width, -1.0, L + c, rows, scaled_.data(),
                  part, block + index(c) + index(c) * index(rows), rows);
    }
  }

  /// max of L_ij^2 |d_j| / |a_ii|.
  void measure_growth(int s) {
    const int rows = symbolic_.row_count(s);
    const double* block = values_.data() + symbolic_.offset(s);
    for (int c = 0; c < symbolic_.columns(s); ++c) {
      const double d = std::abs(pivots_[index(symbolic_.first_column(s) + c)]);
      for (int r = c + 1; r < rows; ++r) {
        const double l = block[index(r) + index(c) * index(rows)];
        const double grown =
            l * l * d / std::abs(diagonal_[symbolic_.rows(s)[r]]);
        if (!(grown <= growth_)) growth_ = grown;  // also takes a NaN
      }
    }
  }

  const Symbolic& symbolic_;
  const SparseMatrix& A_;
  std::vector<double> values_;  // L by supernodes, column-major blocks
  std::vector<double> pivots_;
  std::vector<int> map_;    // row in the present supernode of an index
  std::vector<int> owner_;  // supernode of a column
  std::vector<int> head_;   // descendants waiting for a supernode
  std::vector<int> next_;
  std::vector<int> done_rows_;  // rows of a descendant already used
  std::vector<double> scaled_;
  std::vector<double> update_;
  VectorX diagonal_;
  double growth_ = 0.0;
};

}  // namespace

PivotCount count_negative_pivots(const SparseMatrix& lower,
                                 const std::vector<int>& order) {
  const Symbolic symbolic(lower, order);
  const SparseMatrix permuted = permute(lower, symbolic);
  return SignedFactorisation(symbolic, permuted).count();
}

}  // namespace limber::fem
