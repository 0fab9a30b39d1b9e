// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/cholesky.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/fem/linalg/cholmod_view.hpp"
#include "limber/fem/linalg/parallel.hpp"
#include "limber/fem/linalg/serial_blas.hpp"

namespace limber::fem {

std::vector<int> order_nodes(const SparseMatrix& M_s) {
  CholmodCommon common;
  const SparseMatrix lower = M_s.triangularView<Eigen::Lower>();
  cholmod_sparse pattern = view_lower(lower);
  std::vector<int> nodes(static_cast<std::size_t>(M_s.cols()));
  if (!cholmod().metis(&pattern, nullptr, 0, 1, nodes.data(), common.get()))
    cholmod().amd(&pattern, nullptr, 0, nodes.data(), common.get());
  common.check("ordering");
  return nodes;
}

std::vector<int> order_dofs(const SparseMatrix& M_s) {
  const std::vector<int> nodes = order_nodes(M_s);
  std::vector<int> dofs;
  dofs.reserve(3 * nodes.size());
  for (const int node : nodes)
    for (int c = 0; c < 3; ++c) dofs.push_back(3 * node + c);
  return dofs;
}

namespace {

/// Linux grants more memory than there is, and then ends the process.
void check_memory(double bytes, const std::string& what) {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<double>(sysconf(_SC_PAGESIZE));
  if (memory <= 0.0 || bytes < memory) return;
  constexpr double kGigabyte = 1e9;
  throw NumericalError(
      fmt::format("{}: its factor takes {:.3g} GB, and the memory is {:.3g} GB",
                  what, bytes / kGigabyte, memory / kGigabyte));
}

/// Columns that are solved for together. Fixed, so that solutions do not depend
/// on the number of threads.
constexpr Eigen::Index kColumns = 16;

}  // namespace

/// What one thread needs to solve, reused from one solution to the next.
class CholmodSolver {
 public:
  CholmodSolver() = default;
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;
  ~CholmodSolver() {
    for (cholmod_dense** room : {&answer_, &room_Y_, &room_E_}) {
      cholmod().free_dense(room, common_.get());
    }
  }

  void solve(cholmod_factor* factor, Eigen::Ref<MatrixX> x) {
    cholmod_dense b{};
    b.nrow = static_cast<std::size_t>(x.rows());
    b.ncol = static_cast<std::size_t>(x.cols());
    b.d = static_cast<std::size_t>(x.outerStride());
    b.nzmax = b.d * b.ncol;
    b.x = x.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod().solve2(CHOLMOD_A, factor, &b, nullptr, &answer_, nullptr,
                     &room_Y_, &room_E_, common_.get());
    common_.check("solution");
    x = Eigen::Map<const MatrixX>(static_cast<const double*>(answer_->x),
                                  x.rows(), x.cols());
  }

 private:
  CholmodCommon common_;
  cholmod_dense* answer_ = nullptr;
  cholmod_dense* room_Y_ = nullptr;
  cholmod_dense* room_E_ = nullptr;
};

struct SparseCholesky::Impl {
  CholmodCommon common;
  cholmod_factor* factor = nullptr;
  std::vector<std::unique_ptr<CholmodSolver>> solvers;  // one a thread
  double flops = 0.0;
  std::string what;
  std::string causes;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { cholmod().free_factor(&factor, common.get()); }
};

SparseCholesky::SparseCholesky(const SparseMatrix& lower,
                               const std::vector<int>& order,
                               const std::string& what,
                               const std::string& causes)
    : impl_(std::make_unique<Impl>()) {
  cholmod_common* common = impl_->common.get();
  common->supernodal = CHOLMOD_SUPERNODAL;
  impl_->factor = analyze(lower, order, impl_->common);
  impl_->flops = common->fl;
  impl_->what = what;
  impl_->causes = causes;
  check_memory(sizeof(double) * static_cast<double>(impl_->factor->xsize),
               what);
  factor(lower);
}

void SparseCholesky::factor(const SparseMatrix& lower) {
  const SerialBlas serial;
  cholmod_sparse matrix = view_lower(lower);
  cholmod().factorize(&matrix, impl_->factor, impl_->common.get());
  impl_->common.check(impl_->what);
  if (impl_->factor->minor < impl_->factor->n)
    throw NumericalError(fmt::format(
        "{} is not positive definite in double precision (pivot {} of {}){}{}",
        impl_->what, impl_->factor->minor, impl_->factor->n,
        impl_->causes.empty() ? "" : ".", impl_->causes));
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

MatrixX SparseCholesky::solve(const MatrixX& right_hand_side) const {
  MatrixX copy = right_hand_side;
  solve_in_place(copy);
  return copy;
}

void SparseCholesky::solve_in_place(Eigen::Ref<MatrixX> x) const {
  const SerialBlas serial;
  const Eigen::Index blocks = (x.cols() + kColumns - 1) / kColumns;
  const Eigen::Index parts =
      blocks > 1 ? std::min<Eigen::Index>(thread_count(), blocks) : 1;
  std::vector<std::unique_ptr<CholmodSolver>>& solvers = impl_->solvers;
  while (std::ssize(solvers) < parts) {
    solvers.push_back(std::make_unique<CholmodSolver>());
  }
  const auto solve_part = [&](Eigen::Index part) {
    for (Eigen::Index block = part; block < blocks; block += parts) {
      const Eigen::Index first = kColumns * block;
      solvers[static_cast<std::size_t>(part)]->solve(
          impl_->factor,
          x.middleCols(first, std::min(kColumns, x.cols() - first)));
    }
  };
  if (parts == 1) return solve_part(0);  // without allocation or threads
  parallel_ranges(static_cast<std::size_t>(parts),
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t part = begin; part < end; ++part) {
                      solve_part(static_cast<Eigen::Index>(part));
                    }
                  });
}

double SparseCholesky::flops() const { return impl_->flops; }

}  // namespace limber::fem
