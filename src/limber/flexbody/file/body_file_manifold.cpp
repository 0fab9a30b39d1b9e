// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/body_file_manifold.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "limber/flexbody/elasticity/quadratic_strain.hpp"

namespace limber::flexbody {
namespace {

std::string name_manifold_place(std::size_t interface) {
  return fmt::format("manifold/interfaces/{:04}/", interface);
}

std::vector<int> read_paired(const BodyFileReader& reader, Eigen::Index m) {
  std::vector<int> paired;
  for (const std::size_t k : reader.sizes("manifold/paired", -1)) {
    if (static_cast<Eigen::Index>(k) >= m ||
        (!paired.empty() && static_cast<int>(k) <= paired.back())) {
      reader.fail(fmt::format(
          "'manifold/paired' holds {}, not one of {} modes in order", k, m));
    }
    paired.push_back(static_cast<int>(k));
  }
  if (paired.size() > QuadraticStrain::kMostPaired) {
    reader.fail(fmt::format("'manifold/paired' has {} entries", paired.size()));
  }
  return paired;
}

}  // namespace

void write_manifold(Hdf5File& out, const ReducedBody& body) {
  if (!body.manifold) return;
  const QuadraticManifold& manifold = *body.manifold;
  out.write(
      "manifold/paired",
      std::vector<std::int64_t>(manifold.paired.begin(), manifold.paired.end()),
      "1", "modes that rotate more than they strain");
  out.write("manifold/has_surfaces",
            std::vector<std::int64_t>{body.contact_surfaces.empty() ? 0 : 1},
            "1", "1 if there are contact surfaces");
  out.write("manifold/Q", manifold.Q, "rad kg^-1/2 m^-1 s^-1",
            "quadratic modal strains, a column a pair 11, 12, .., 22, ..");
  if (manifold.self.rows() > 0) {
    out.write("manifold/self", manifold.self, "rad kg^-1/2 m^-1 s^-1",
              "self-strains, which are of no mode, a column a pair");
  }
  out.write("manifold/S2", MatrixX(manifold.S2), "1",
            "sym(int x theta' dm): xx, yy, zz, xy, xz, yz, a column a pair");
  out.write("manifold/Theta_B", manifold.Theta_B, "kg^-1 m^-1",
            "second derivatives of the displacement, 3n x pairs");
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    const InterfaceTable& table = body.interfaces[i];
    out.write(name_manifold_place(i) + "Phi2_B", MatrixX(table.Phi2_B),
              "kg^-1 m^-1", "second derivatives of the translation, 3 x pairs");
    out.write(name_manifold_place(i) + "Psi2_B", MatrixX(table.Psi2_B),
              "rad kg^-1 m^-2",
              "second derivatives of the rotation vector, 3 x pairs");
  }
}

bool has_surfaces(const BodyFileReader& reader) {
  return reader.integer("manifold/has_surfaces") != 0;
}

Eigen::Index count_products(const BodyFileReader& reader, Eigen::Index m) {
  return count_pairs(std::ssize(read_paired(reader, m)));
}

void read_manifold(const BodyFileReader& reader, ReducedBody& body) {
  QuadraticManifold manifold;
  manifold.paired = read_paired(reader, body.lambda.size());
  const auto p = static_cast<Eigen::Index>(manifold.paired.size());
  const Eigen::Index pairs = count_pairs(p);
  manifold.Q = reader.matrix("manifold/Q", p, pairs);
  manifold.self.resize(0, pairs);
  if (reader.in().has("manifold/self")) {
    const Eigen::Index rows = reader.in().read_matrix("manifold/self").rows();
    if (rows > QuadraticStrain::kMostPaired - p) {
      reader.fail(fmt::format("'manifold/self' has {} rows", rows));
    }
    manifold.self = reader.matrix("manifold/self", rows, pairs);
  }
  manifold.S2 = reader.matrix("manifold/S2", 6, pairs);
  manifold.Theta_B =
      reader.matrix("manifold/Theta_B", body.rows.Phi_B.rows(), pairs);
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    InterfaceTable& table = body.interfaces[i];
    table.Phi2_B = reader.matrix(name_manifold_place(i) + "Phi2_B", 3, pairs);
    table.Psi2_B = reader.matrix(name_manifold_place(i) + "Psi2_B", 3, pairs);
  }
  body.manifold = std::move(manifold);
}

}  // namespace limber::flexbody
