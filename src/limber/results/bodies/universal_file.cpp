// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/results/bodies/body_files.hpp"

namespace limber::results {
namespace {

std::string wrap_dataset(int number, const std::string& text) {
  return fmt::format("    -1\n{:6}\n{}    -1\n", number, text);
}

std::string make_units() {
  return wrap_dataset(
      164, fmt::format("{:10}{:<20}{:10}\n{:25.17E}{:25.17E}{:25.17E}\n"
                       "{:25.17E}\n",
                       1, "SI: Meter (newton)", 2, 1.0, 1.0, 1.0, 273.15));
}

std::string make_nodes(const flexbody::ReducedBody& body, bool is_of_test) {
  std::string text;
  for (std::size_t i = 0; i < body.rows.tags.size(); ++i) {
    const Vector3 x =
        body.rows.x_B.col(static_cast<Eigen::Index>(i)) + body.p_MoBcm_M;
    text += fmt::format("{:10}{:10}{:10}{:10}", body.rows.tags[i], 1, 1, 11);
    text +=
        is_of_test
            ? fmt::format("{:13.5E}{:13.5E}{:13.5E}\n", x[0], x[1], x[2])
            : fmt::format("\n{:25.16E}{:25.16E}{:25.16E}\n", x[0], x[1], x[2]);
  }
  return wrap_dataset(is_of_test ? 15 : 2411, text);
}

/// Real modes, three values a node. The largest is 1, as values have six
/// digits; the modal mass states their scale.
std::string make_mode(const flexbody::ReducedBody& body, Eigen::Index k,
                      double ratio) {
  const VectorX phi = body.rows.Phi_B.col(k);
  const double size = phi.cwiseAbs().maxCoeff();
  const double scale = size > 0.0 ? 1.0 / size : 1.0;
  const double f = std::sqrt(std::max(body.lambda[k], 0.0)) / (2.0 * M_PI);
  std::string text = fmt::format(
      "{:.80}\nmode {}, {:.6g} Hz\nNONE\nNONE\n"
      "NONE\n{:10}{:10}{:10}{:10}{:10}{:10}\n"
      "{:10}{:10}{:10}{:10}\n"
      "{:13.5E}{:13.5E}{:13.5E}{:13.5E}\n",
      body.name, k + 1, f, 1, 2, 2, 8, 2, 3, 2, 4, 0, k + 1, f, scale * scale,
      ratio, 0.0);
  for (std::size_t i = 0; i < body.rows.tags.size(); ++i) {
    const Vector3 u = scale * phi.segment<3>(3 * static_cast<Eigen::Index>(i));
    text += fmt::format("{:10}\n{:13.5E}{:13.5E}{:13.5E}\n", body.rows.tags[i],
                        u[0], u[1], u[2]);
  }
  return wrap_dataset(55, text);
}

}  // namespace

std::string make_universal_file(const flexbody::ReducedBody& body, double ratio,
                                bool is_of_test) {
  std::string text = make_units() + make_nodes(body, is_of_test);
  for (Eigen::Index k = 0; k < body.lambda.size(); ++k)
    text += make_mode(body, k, ratio);
  return text;
}

}  // namespace limber::results
