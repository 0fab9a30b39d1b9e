// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

/// Products with the columns of an interface or of a link's end, one a mode or
/// an unknown.
namespace limber::dynamics::kernels {

/// Columns of an interface's tables, 3 x m each, contiguous.
struct InterfaceColumns {
  const double* Phi = nullptr;
  const double* Psi = nullptr;
  std::size_t modes = 0;
};

struct InterfaceMotion {
  std::array<double, 3> u{};       ///< Phi eta
  std::array<double, 3> psi{};     ///< Psi eta
  std::array<double, 3> udot{};    ///< Phi etadot
  std::array<double, 3> psidot{};  ///< Psi etadot
};

[[nodiscard]] InterfaceMotion calc_interface_motion(
    const InterfaceColumns& interface, const double* eta, const double* etadot);

/// modal_force += Phi' force + Psi' moment, of m modes.
void add_interface_force(const InterfaceColumns& interface, const double* force,
                         const double* moment, double* modal_force);

/// sum += G x, G 6 x count with contiguous columns.
void add_product(const double* G, const double* x, std::size_t count,
                 double* sum);

/// x += G' wrench, G 6 x count with contiguous columns.
void add_transposed_product(const double* G, const double* wrench,
                            std::size_t count, double* x);

/// block += G Z', 6 x 6 with contiguous columns, G and Z 6 x count likewise.
void add_outer_products(const double* G, const double* Z, std::size_t count,
                        double* block);

}  // namespace limber::dynamics::kernels
