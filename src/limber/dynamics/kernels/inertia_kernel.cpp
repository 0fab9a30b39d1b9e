// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/kernels/inertia_kernel.hpp"

#include "limber/dynamics/kernels/lanes.hpp"
#include "limber/dynamics/kernels/processor.hpp"

namespace limber::dynamics::kernels {
namespace {

// Count times four rows of y = start + sum_l columns_l x_l.
template <typename Lanes, std::size_t Count>
LIMBER_KERNEL void add_columns(const double* start, const double* columns,
                               std::size_t stride, const double* x,
                               std::size_t count, double* y) {
  Lanes rows[Count];
  for (std::size_t i = 0; i < Count; ++i) {
    rows[i] =
        start == nullptr ? spread<Lanes>(0.0) : Lanes::load(start + kLanes * i);
  }
  for (std::size_t l = 0; l < count; ++l, columns += stride) {
    const Lanes factor = spread<Lanes>(x[l]);
    for (std::size_t i = 0; i < Count; ++i) {
      rows[i] = rows[i] + Lanes::load(columns + kLanes * i) * factor;
    }
  }
  for (std::size_t i = 0; i < Count; ++i) rows[i].store(y + kLanes * i);
}

// All rows; a multiple of four.
template <typename Lanes>
LIMBER_KERNEL void multiply(const double* start, const double* columns,
                            std::size_t stride, std::size_t rows,
                            const double* x, std::size_t count, double* y) {
  constexpr std::size_t kBlock = 3 * Lanes::kTriples;
  std::size_t row = 0;
  const auto from = [&] { return start == nullptr ? nullptr : start + row; };
  for (; row + kLanes * kBlock <= rows; row += kLanes * kBlock) {
    add_columns<Lanes, kBlock>(from(), columns + row, stride, x, count,
                               y + row);
  }
  for (; row + kLanes * 3 <= rows; row += kLanes * 3) {
    add_columns<Lanes, 3>(from(), columns + row, stride, x, count, y + row);
  }
  for (; row < rows; row += kLanes) {
    add_columns<Lanes, 1>(from(), columns + row, stride, x, count, y + row);
  }
}

template <typename Lanes>
struct LaneSums {
  Lanes J[6]{};
  Lanes Jdot[6]{};
  Lanes h[3]{};
};

// What four modes add to the sums. @returns their part of `bias`
template <typename Lanes>
LIMBER_KERNEL Lanes add_modes(const double* J1, const double* products,
                              std::size_t p, Lanes eta, Lanes rate,
                              const double* w, const double* half_square,
                              LaneSums<Lanes>& sums) {
  const double* const H = products + 6 * p;
  const double* const rates = products + 9 * p;
  const Lanes half_eta = spread<Lanes>(0.5) * eta;
  Lanes force = spread<Lanes>(0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    sums.h[c] = sums.h[c] + Lanes::load(H + c * p) * rate;
    force = force + spread<Lanes>(2.0 * w[c]) * Lanes::load(rates + c * p);
  }
  for (std::size_t c = 0; c < 6; ++c) {
    const Lanes dJ = Lanes::load(products + c * p);
    sums.J[c] = sums.J[c] + (Lanes::load(J1 + c * p) + dJ) * half_eta;
    sums.Jdot[c] = sums.Jdot[c] + dJ * rate;
    force = force + spread<Lanes>(-half_square[c]) * dJ;
  }
  return force;
}

template <typename Lanes>
LIMBER_KERNEL void calc(const InertiaColumns& inertia, const double* eta,
                        const double* etadot, const double* w,
                        const double* half_square, double* products,
                        double* bias, InertiaSums& result) {
  const std::size_t m = inertia.modes;
  const std::size_t p = pad(m);
  const std::size_t stride = 9 * p;
  const double* const J1 = inertia.columns;
  const double* const columns = J1 + stride;
  multiply<Lanes>(J1, columns, stride, stride, eta, m, products);
  multiply<Lanes>(nullptr, columns + 6 * p, stride, 3 * p, etadot, m,
                  products + 9 * p);

  LaneSums<Lanes> sums;
  std::size_t k = 0;
  for (; k + kLanes <= m; k += kLanes) {
    const Lanes force =
        add_modes(J1 + k, products + k, p, Lanes::load(eta + k),
                  Lanes::load(etadot + k), w, half_square, sums);
    (Lanes::load(bias + k) + force).store(bias + k);
  }
  if (k < m) {
    const Lanes force =
        add_modes(J1 + k, products + k, p, load_some<Lanes>(eta + k, m - k),
                  load_some<Lanes>(etadot + k, m - k), w, half_square, sums);
    double last[kLanes];
    force.store(last);
    for (std::size_t i = 0; k + i < m; ++i) bias[k + i] += last[i];
  }
  for (std::size_t c = 0; c < 6; ++c) {
    result.J[c] = sums.J[c].sum();
    result.Jdot[c] = sums.Jdot[c].sum();
  }
  for (std::size_t c = 0; c < 3; ++c) result.h[c] = sums.h[c].sum();
}

#if LIMBER_HAS_AVX2
[[gnu::target("avx2")]] void calc_by_avx2(const InertiaColumns& inertia,
                                          const double* eta,
                                          const double* etadot, const double* w,
                                          const double* half_square,
                                          double* products, double* bias,
                                          InertiaSums& result) {
  calc<OneOfFour>(inertia, eta, etadot, w, half_square, products, bias, result);
}
#endif

}  // namespace

InertiaSums calc_inertia(const InertiaColumns& inertia, const double* eta,
                         const double* etadot, const double* w,
                         const double* half_square, double* products,
                         double* bias) {
  InertiaSums sums;
#if LIMBER_HAS_AVX2
  if (uses_avx2()) {
    calc_by_avx2(inertia, eta, etadot, w, half_square, products, bias, sums);
    return sums;
  }
#endif
  calc<PairOfTwo>(inertia, eta, etadot, w, half_square, products, bias, sums);
  return sums;
}

}  // namespace limber::dynamics::kernels
