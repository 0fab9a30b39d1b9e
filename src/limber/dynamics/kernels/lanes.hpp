// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/kernels/padding.hpp"

/// Four doubles side by side, for the kernels of this folder alone. A kernel is
/// written once, as a template on one of these types, and compiled for each set
/// of instructions: sums have one order, and no product is fused with a sum, so
/// that all sets give the same bits.
#if defined(__x86_64__)
#define LIMBER_HAS_AVX2 1
#else
#define LIMBER_HAS_AVX2 0
#endif

/// A function that takes the set of instructions of its caller.
#define LIMBER_KERNEL [[gnu::always_inline]] inline

namespace limber::dynamics::kernels {

using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));

/// Of any alignment.
template <typename Vector>
LIMBER_KERNEL Vector load_vector(const double* x) {
  Vector vector;
  __builtin_memcpy(&vector, x, sizeof vector);
  return vector;
}
template <typename Vector>
LIMBER_KERNEL void store_vector(Vector vector, double* x) {
  __builtin_memcpy(x, &vector, sizeof vector);
}

/// In two registers of two.
struct PairOfTwo {
  /// A kernel keeps three times as many in the processor's sixteen registers.
  static constexpr std::size_t kTriples = 2;

  Two low;
  Two high;

  LIMBER_KERNEL static PairOfTwo load(const double* x) {
    return {load_vector<Two>(x), load_vector<Two>(x + 2)};
  }
  LIMBER_KERNEL static PairOfTwo set(double a, double b, double c, double d) {
    return {Two{a, b}, Two{c, d}};
  }
  LIMBER_KERNEL void store(double* x) const {
    store_vector(low, x);
    store_vector(high, x + 2);
  }
  LIMBER_KERNEL friend PairOfTwo operator+(PairOfTwo a, PairOfTwo b) {
    return {a.low + b.low, a.high + b.high};
  }
  LIMBER_KERNEL friend PairOfTwo operator*(PairOfTwo a, PairOfTwo b) {
    return {a.low * b.low, a.high * b.high};
  }
  LIMBER_KERNEL double sum() const {
    return (low[0] + low[1]) + (high[0] + high[1]);
  }
  LIMBER_KERNEL double sum_of_three() const {
    return (low[0] + low[1]) + high[0];
  }
  /// (a0 + a1, a2 + a3, b0 + b1, b2 + b3).
  LIMBER_KERNEL static PairOfTwo sum_pairs(PairOfTwo a, PairOfTwo b) {
    return {Two{a.low[0], a.high[0]} + Two{a.low[1], a.high[1]},
            Two{b.low[0], b.high[0]} + Two{b.low[1], b.high[1]}};
  }
  /// Sums of three each of the twelve numbers a, b, c in a row.
  LIMBER_KERNEL static PairOfTwo sum_triples(PairOfTwo a, PairOfTwo b,
                                             PairOfTwo c) {
    return {Two{a.low[0], a.high[1]} + Two{a.low[1], b.low[0]} +
                Two{a.high[0], b.low[1]},
            Two{b.high[0], c.low[1]} + Two{b.high[1], c.high[0]} +
                Two{c.low[0], c.high[1]}};
  }
};

/// In one register of four.
struct OneOfFour {
  static constexpr std::size_t kTriples = 3;

  Four all;

  LIMBER_KERNEL static OneOfFour load(const double* x) {
    return {load_vector<Four>(x)};
  }
  LIMBER_KERNEL static OneOfFour set(double a, double b, double c, double d) {
    return {Four{a, b, c, d}};
  }
  LIMBER_KERNEL void store(double* x) const { store_vector(all, x); }
  LIMBER_KERNEL friend OneOfFour operator+(OneOfFour a, OneOfFour b) {
    return {a.all + b.all};
  }
  LIMBER_KERNEL friend OneOfFour operator*(OneOfFour a, OneOfFour b) {
    return {a.all * b.all};
  }
  LIMBER_KERNEL double sum() const {
    return (all[0] + all[1]) + (all[2] + all[3]);
  }
  LIMBER_KERNEL double sum_of_three() const {
    return (all[0] + all[1]) + all[2];
  }
  LIMBER_KERNEL static OneOfFour sum_pairs(OneOfFour a, OneOfFour b) {
    const Four sums = __builtin_shufflevector(a.all, b.all, 0, 4, 2, 6) +
                      __builtin_shufflevector(a.all, b.all, 1, 5, 3, 7);
    return {__builtin_shufflevector(sums, sums, 0, 2, 1, 3)};
  }
  LIMBER_KERNEL static OneOfFour sum_triples(OneOfFour a, OneOfFour b,
                                             OneOfFour c) {
    const Four ab = __builtin_shufflevector(a.all, b.all, 0, 1, 6, 7);
    const Four ac = __builtin_shufflevector(a.all, c.all, 2, 3, 4, 5);
    const Four bc = __builtin_shufflevector(b.all, c.all, 0, 1, 6, 7);
    return {__builtin_shufflevector(ab, ac, 0, 5, 2, 7) +
            __builtin_shufflevector(ab, bc, 1, 4, 3, 6) +
            __builtin_shufflevector(ac, bc, 0, 5, 2, 7)};
  }
};

template <typename Lanes>
LIMBER_KERNEL Lanes spread(double x) {
  return Lanes::set(x, x, x, x);
}

/// The first one to three of four, then zeros.
template <typename Lanes>
LIMBER_KERNEL Lanes load_some(const double* x, std::size_t count) {
  return Lanes::set(x[0], count > 1 ? x[1] : 0.0, count > 2 ? x[2] : 0.0, 0.0);
}

}  // namespace limber::dynamics::kernels
