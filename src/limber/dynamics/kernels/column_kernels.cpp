// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/kernels/column_kernels.hpp"

#include "limber/dynamics/kernels/lanes.hpp"
#include "limber/dynamics/kernels/processor.hpp"

namespace limber::dynamics::kernels {
namespace {

constexpr std::size_t kRows = 3;

// Column k of 3 x count. The last is not read beyond its end; of others the
// fourth lane is not used.
template <typename Lanes>
LIMBER_KERNEL Lanes load_column(const double* columns, std::size_t k,
                                std::size_t count) {
  const double* const column = columns + kRows * k;
  return k + 1 < count ? Lanes::load(column) : load_some<Lanes>(column, kRows);
}

template <typename Lanes>
LIMBER_KERNEL void store_rows(Lanes lanes, double* rows) {
  double all[kLanes];
  lanes.store(all);
  for (std::size_t i = 0; i < kRows; ++i) rows[i] = all[i];
}

template <typename Lanes>
LIMBER_KERNEL void move(const InterfaceColumns& interface, const double* eta,
                        const double* etadot, InterfaceMotion& motion) {
  Lanes u = spread<Lanes>(0.0);
  Lanes psi = u;
  Lanes udot = u;
  Lanes psidot = u;
  for (std::size_t k = 0; k < interface.modes; ++k) {
    const auto Phi = load_column<Lanes>(interface.Phi, k, interface.modes);
    const auto Psi = load_column<Lanes>(interface.Psi, k, interface.modes);
    const auto position = spread<Lanes>(eta[k]);
    const auto rate = spread<Lanes>(etadot[k]);
    u = u + Phi * position;
    psi = psi + Psi * position;
    udot = udot + Phi * rate;
    psidot = psidot + Psi * rate;
  }
  store_rows(u, motion.u.data());
  store_rows(psi, motion.psi.data());
  store_rows(udot, motion.udot.data());
  store_rows(psidot, motion.psidot.data());
}

template <typename Lanes>
LIMBER_KERNEL void push(const InterfaceColumns& interface, const double* force,
                        const double* moment, double* modal_force) {
  const auto f = load_some<Lanes>(force, kRows);
  const auto t = load_some<Lanes>(moment, kRows);
  for (std::size_t k = 0; k < interface.modes; ++k) {
    const auto Phi = load_column<Lanes>(interface.Phi, k, interface.modes);
    const auto Psi = load_column<Lanes>(interface.Psi, k, interface.modes);
    modal_force[k] += (Phi * f + Psi * t).sum_of_three();
  }
}

// Two columns of six at a time.
template <typename Lanes>
LIMBER_KERNEL void add_columns(const double* G, const double* x,
                               std::size_t count, double* sum) {
  auto head = spread<Lanes>(0.0);
  auto middle = head;
  auto tail = head;
  std::size_t k = 0;
  for (; k + 2 <= count; k += 2, G += 12) {
    const double a = x[k];
    const double b = x[k + 1];
    head = head + Lanes::load(G) * spread<Lanes>(a);
    middle = middle + Lanes::load(G + 4) * Lanes::set(a, a, b, b);
    tail = tail + Lanes::load(G + 8) * spread<Lanes>(b);
  }
  double all[12];
  head.store(all);
  middle.store(all + 4);
  tail.store(all + 8);
  for (std::size_t i = 0; i < 6; ++i) {
    all[i] += all[6 + i];
    if (k < count) all[i] += G[i] * x[k];
    sum[i] += all[i];
  }
}

// Four columns of six at a time.
template <typename Lanes>
LIMBER_KERNEL void add_dots(const double* G, const double* wrench,
                            std::size_t count, double* x) {
  const double* const w = wrench;
  const auto head = Lanes::load(w);
  const auto middle = Lanes::set(w[4], w[5], w[0], w[1]);
  const auto tail = Lanes::load(w + 2);
  std::size_t k = 0;
  for (; k + kLanes <= count; k += kLanes, G += 24) {
    const auto first =
        Lanes::sum_pairs(Lanes::load(G) * head, Lanes::load(G + 4) * middle);
    const auto second =
        Lanes::sum_pairs(Lanes::load(G + 8) * tail, Lanes::load(G + 12) * head);
    const auto third = Lanes::sum_pairs(Lanes::load(G + 16) * middle,
                                        Lanes::load(G + 20) * tail);
    (Lanes::load(x + k) + Lanes::sum_triples(first, second, third))
        .store(x + k);
  }
  for (; k < count; ++k, G += 6) {
    x[k] += (G[0] * w[0] + G[1] * w[1]) + (G[2] * w[2] + G[3] * w[3]) +
            (G[4] * w[4] + G[5] * w[5]);
  }
}

template <typename Lanes>
LIMBER_KERNEL void add_outer(const double* G, const double* Z,
                             std::size_t count, double* block) {
  Lanes head[6];
  Two tail[6];
  for (std::size_t j = 0; j < 6; ++j) {
    head[j] = Lanes::load(block + 6 * j);
    tail[j] = load_vector<Two>(block + 6 * j + 4);
  }
  for (std::size_t k = 0; k < count; ++k, G += 6, Z += 6) {
    const auto top = Lanes::load(G);
    const auto bottom = load_vector<Two>(G + 4);
    for (std::size_t j = 0; j < 6; ++j) {
      head[j] = head[j] + top * spread<Lanes>(Z[j]);
      tail[j] = tail[j] + bottom * Two{Z[j], Z[j]};
    }
  }
  for (std::size_t j = 0; j < 6; ++j) {
    head[j].store(block + 6 * j);
    store_vector(tail[j], block + 6 * j + 4);
  }
}

#if LIMBER_HAS_AVX2
[[gnu::target("avx2")]] void move_by_avx2(const InterfaceColumns& interface,
                                          const double* eta,
                                          const double* etadot,
                                          InterfaceMotion& motion) {
  move<OneOfFour>(interface, eta, etadot, motion);
}
[[gnu::target("avx2")]] void push_by_avx2(const InterfaceColumns& interface,
                                          const double* force,
                                          const double* moment,
                                          double* modal_force) {
  push<OneOfFour>(interface, force, moment, modal_force);
}
[[gnu::target("avx2")]] void add_columns_by_avx2(const double* G,
                                                 const double* x,
                                                 std::size_t count,
                                                 double* sum) {
  add_columns<OneOfFour>(G, x, count, sum);
}
[[gnu::target("avx2")]] void add_dots_by_avx2(const double* G,
                                              const double* wrench,
                                              std::size_t count, double* x) {
  add_dots<OneOfFour>(G, wrench, count, x);
}
[[gnu::target("avx2")]] void add_outer_by_avx2(const double* G, const double* Z,
                                               std::size_t count,
                                               double* block) {
  add_outer<OneOfFour>(G, Z, count, block);
}
#endif

}  // namespace

InterfaceMotion calc_interface_motion(const InterfaceColumns& interface,
                                      const double* eta, const double* etadot) {
  InterfaceMotion motion;
#if LIMBER_HAS_AVX2
  if (uses_avx2()) {
    move_by_avx2(interface, eta, etadot, motion);
    return motion;
  }
#endif
  move<PairOfTwo>(interface, eta, etadot, motion);
  return motion;
}

void add_interface_force(const InterfaceColumns& interface, const double* force,
                         const double* moment, double* modal_force) {
#if LIMBER_HAS_AVX2
  if (uses_avx2()) {
    return push_by_avx2(interface, force, moment, modal_force);
  }
#endif
  push<PairOfTwo>(interface, force, moment, modal_force);
}

void add_product(const double* G, const double* x, std::size_t count,
                 double* sum) {
#if LIMBER_HAS_AVX2
  if (uses_avx2()) return add_columns_by_avx2(G, x, count, sum);
#endif
  add_columns<PairOfTwo>(G, x, count, sum);
}

void add_transposed_product(const double* G, const double* wrench,
                            std::size_t count, double* x) {
#if LIMBER_HAS_AVX2
  if (uses_avx2()) return add_dots_by_avx2(G, wrench, count, x);
#endif
  add_dots<PairOfTwo>(G, wrench, count, x);
}

void add_outer_products(const double* G, const double* Z, std::size_t count,
                        double* block) {
#if LIMBER_HAS_AVX2
  if (uses_avx2()) return add_outer_by_avx2(G, Z, count, block);
#endif
  add_outer<PairOfTwo>(G, Z, count, block);
}

}  // namespace limber::dynamics::kernels
