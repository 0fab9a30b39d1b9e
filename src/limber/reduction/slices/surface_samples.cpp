// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/slices/surface_samples.hpp"

namespace limber::flexbody {

std::vector<SurfaceSample> sample_surface(const fem::Mesh& mesh,
                                          const fem::Surface& surface) {
  constexpr std::size_t kFew = 64;
  const int divisions = surface.faces.size() > kFew ? 4 : 16;
  std::vector<fem::FaceTable> rules;
  for (const fem::FaceShape& shape : surface.shapes) {
    rules.push_back(shape.make_rule(divisions));
  }
  std::vector<SurfaceSample> samples;
  for (const fem::SurfaceFace& face : surface.faces) {
    const fem::FaceTable& rule = rules[face.shape];
    const Matrix3X x = mesh.x(Eigen::all, face.nodes);
    const Matrix3X points = x * rule.shape;
    const Matrix3X along_u = x * rule.along_u;
    const Matrix3X along_v = x * rule.along_v;
    for (Eigen::Index q = 0; q < points.cols(); ++q) {
      const Vector3 area =
          Vector3(along_u.col(q)).cross(Vector3(along_v.col(q)));
      samples.push_back({&face, rule.shape.col(q), points.col(q),
                         area.normalized(), rule.weights[q] * area.norm()});
    }
  }
  return samples;
}

VectorX find_heights(const SurfaceSample& s, const MatrixX& Phi,
                     Eigen::Index modes, const Vector3& normal) {
  VectorX heights = VectorX::Zero(modes);
  for (std::size_t k = 0; k < s.face->nodes.size(); ++k) {
    heights +=
        s.shape[static_cast<Eigen::Index>(k)] *
        (Phi.block(3 * s.face->nodes[k], 0, 3, modes).transpose() * normal);
  }
  return heights;
}

}  // namespace limber::flexbody
