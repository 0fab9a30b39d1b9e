// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/inertia_check.hpp"

#include <fmt/format.h>

#include "limber/common/dense/symmetric_eigen.hpp"

namespace limber::dynamics {

std::string find_inertia_problem(const Matrix3& inertia) {
  constexpr double kPrinted = 1e-3;  // of the largest moment
  const Vector3 I = dense::find_eigenvalues(inertia);
  const std::string moments = fmt::format(
      "its inertia has the principal moments ({:g}, {:g}, {:g}) kg "
      "m^2",
      I[0], I[1], I[2]);
  if (!(I.minCoeff() > 0.0)) return moments + "; expected all > 0";
  if (I[0] + I[1] >= (1.0 - kPrinted) * I[2]) return "";
  return moments +
         ", the largest exceeds the sum of the others, which is physically "
         "impossible. Check its units, and that it is about the centre of mass";
}

}  // namespace limber::dynamics
