// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/body_file_contact.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace limber::flexbody {
namespace {

constexpr std::size_t kFaceNodes = 6;

// Of flat surfaces.
void write_parts(Hdf5File& out, const std::string& at,
                 const std::vector<ContactPart>& parts) {
  if (parts.empty()) return;
  out.write(at + "count", std::vector<std::int64_t>{std::ssize(parts)}, "1",
            "convex parts that move as one piece");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ContactPart& part = parts[i];
    const std::string of_part = fmt::format("{}{}/", at, i + 1);
    out.write(of_part + "normal_B", MatrixX(part.normal_B), "1",
              "outward normal");
    out.write(of_part + "centre_B", MatrixX(part.centre_B), "m",
              "centre of area, from the centre of mass");
    out.write(of_part + "corners_B", part.corners_B, "m",
              "corners, right-hand about the normal, 3 x k");
    out.write(of_part + "rim",
              std::vector<std::int64_t>(part.rim.begin(), part.rim.end()), "1",
              "edges on the surface's rim, by their first corners");
    out.write(of_part + "motion_B", part.motion_B, "kg^-1/2, kg^-1/2 / m",
              "displacement of the centre and rotation by modes, 6 x m");
    out.write(of_part + "depth", MatrixX::Constant(1, 1, part.depth), "m",
              "of material under it");
    out.write(of_part + "residual", MatrixX::Constant(1, 1, part.residual),
              "m/N", "normal flexibility that the modes do not have");
    out.write(of_part + "flexibility",
              MatrixX::Constant(1, 1, part.flexibility), "m/N",
              "normal flexibility that 'motion_B' does not have");
  }
}

std::vector<ContactPart> read_parts(const BodyFileReader& reader,
                                    const std::string& at,
                                    Eigen::Index columns) {
  std::vector<ContactPart> parts;
  if (!reader.in().has(at + "count")) return parts;
  const std::int64_t count = reader.integer(at + "count");
  if (count < 0 || count > std::int64_t{kMostParts}) {
    reader.fail(fmt::format("'{}count' is {}", at, count));
  }
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string of_part = fmt::format("{}{}/", at, i + 1);
    const Eigen::Index k =
        reader.in().read_matrix(of_part + "corners_B").cols();
    ContactPart part;
    part.normal_B = reader.matrix(of_part + "normal_B", 3, 1);
    part.centre_B = reader.matrix(of_part + "centre_B", 3, 1);
    part.corners_B = reader.matrix(of_part + "corners_B", 3, k);
    part.rim = reader.sizes(of_part + "rim", -1);
    part.motion_B = reader.matrix(of_part + "motion_B", 6, columns);
    part.depth = reader.matrix(of_part + "depth", 1, 1)(0, 0);
    part.residual = reader.matrix(of_part + "residual", 1, 1)(0, 0);
    part.flexibility = reader.matrix(of_part + "flexibility", 1, 1)(0, 0);
    parts.push_back(std::move(part));
  }
  return parts;
}

// Of surfaces that are not flat.
void write_slices(Hdf5File& out, const std::string& at,
                  const std::vector<ContactSlice>& slices) {
  if (slices.empty()) return;
  out.write(at + "count", std::vector<std::int64_t>{std::ssize(slices)}, "1",
            "pieces that move as one");
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const ContactSlice& slice = slices[i];
    const std::string of_slice = fmt::format("{}{}/", at, i + 1);
    out.write(of_slice + "normals_B", slice.normals_B, "1",
              "of the planes that bound it, away from it, 3 x k");
    out.write(of_slice + "heights", MatrixX(slice.heights), "m",
              "of these planes, along their normals from the centre of mass");
    out.write(of_slice + "centre_B", MatrixX(slice.centre_B), "m",
              "centre of area, from the centre of mass");
    out.write(of_slice + "motion_B", slice.motion_B, "kg^-1/2, kg^-1/2 / m",
              "displacement of the centre and rotation by modes, 6 x m");
    out.write(of_slice + "flexibility_B", MatrixX(slice.flexibility_B), "m/N",
              "flexibility that 'motion_B' does not have, 3 x 3");
    out.write(
        of_slice + "own_B", MatrixX(slice.own_B), "m/N",
        "fraction of it by which the modes deform the slice itself, 3 x 3");
  }
}

// None of earlier versions.
std::vector<ContactSlice> read_slices(const BodyFileReader& reader,
                                      const std::string& at,
                                      Eigen::Index columns) {
  std::vector<ContactSlice> slices;
  if (!reader.in().has(at + "count")) return slices;
  const std::int64_t count = reader.integer(at + "count");
  if (count < 0 || count > std::int64_t{kMostSlices}) {
    reader.fail(fmt::format("'{}count' is {}", at, count));
  }
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string of_slice = fmt::format("{}{}/", at, i + 1);
    const Eigen::Index k =
        reader.in().read_matrix(of_slice + "normals_B").cols();
    ContactSlice slice;
    slice.normals_B = reader.matrix(of_slice + "normals_B", 3, k);
    slice.heights = reader.matrix(of_slice + "heights", k, 1);
    slice.centre_B = reader.matrix(of_slice + "centre_B", 3, 1);
    slice.motion_B = reader.matrix(of_slice + "motion_B", 6, columns);
    slice.flexibility_B = reader.matrix(of_slice + "flexibility_B", 3, 3);
    if (reader.in().has(of_slice + "own_B")) {  // not of earlier versions
      slice.own_B = reader.matrix(of_slice + "own_B", 3, 3);
    }
    slices.push_back(std::move(slice));
  }
  return slices;
}

void write_surface(Hdf5File& out, const std::string& at,
                   const ContactSurface& surface) {
  out.write(at + "name", surface.name, "group, or skin");
  out.write(at + "tags",
            std::vector<std::int64_t>(surface.tags.begin(), surface.tags.end()),
            "1", "Gmsh node tags; 0: interpolated middle of an edge");
  out.write(at + "x_B", surface.x_B, "m",
            "undeformed positions from the centre of mass, 3 x n");
  out.write(
      at + "Phi_B", surface.Phi_B, "kg^-1/2",
      "mode shapes, mean over the patch around each node, 3n x m; then of "
      "products of modes");
  out.write(at + "residual", MatrixX(surface.residual), "m/N",
            "normal flexibility of each patch that neither modes nor Hertz's "
            "law have");
  out.write(at + "patch_radius", MatrixX(surface.patch_radius), "m",
            "radius of Hertz's pressure on each patch");
  std::vector<std::int64_t> faces;
  for (const auto& face : surface.faces) {
    faces.insert(faces.end(), face.begin(), face.end());
  }
  out.write(at + "faces", faces, "1",
            "triangles, six indices of nodes each: corners, outward, middles "
            "of edges 01, 12, 20 or -1");
  write_parts(out, at + "parts/", surface.parts);
  write_slices(out, at + "slices/", surface.slices);
  out.write(
      at + "material",
      MatrixX(Eigen::Vector2d(surface.youngs_modulus, surface.poisson_ratio)),
      "Pa, 1", "Young's modulus, Poisson's ratio");
}

// Corners exist; of the middles either all or none.
bool is_face(const std::array<int, kFaceNodes>& face, std::size_t count) {
  const auto exists = [&](int node) {
    return node >= 0 && static_cast<std::size_t>(node) < count;
  };
  return std::all_of(face.begin(), face.begin() + 3, exists) &&
         (std::all_of(face.begin() + 3, face.end(), exists) ||
          std::all_of(face.begin() + 3, face.end(),
                      [](int node) { return node == -1; }));
}

std::vector<std::array<int, kFaceNodes>> read_faces(
    const BodyFileReader& reader, const std::string& name, std::size_t count) {
  const std::vector<std::int64_t> nodes = reader.in().read_integers(name);
  if (nodes.size() % kFaceNodes != 0) {
    reader.fail(fmt::format("'{}' is truncated", name));
  }
  std::vector<std::array<int, kFaceNodes>> faces(nodes.size() / kFaceNodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::int64_t node = nodes[i];
    if (node < -1 || node >= static_cast<std::int64_t>(count)) {
      reader.fail(fmt::format("'{}' names a node that does not exist", name));
    }
    faces[i / kFaceNodes][i % kFaceNodes] = static_cast<int>(node);
  }
  for (const auto& face : faces) {
    if (!is_face(face, count)) {
      reader.fail(fmt::format("'{}' has a face without a node", name));
    }
  }
  return faces;
}

ContactSurface read_surface(const BodyFileReader& reader, const std::string& at,
                            Eigen::Index m, Eigen::Index products) {
  ContactSurface surface;
  surface.name = reader.in().read_text(at + "name");
  surface.tags = reader.sizes(at + "tags", -1);
  const auto n = static_cast<Eigen::Index>(surface.tags.size());
  surface.x_B = reader.matrix(at + "x_B", 3, n);
  // Earlier versions have the modes alone.
  const bool has_products = reader.in().read_matrix(at + "Phi_B").cols() != m;
  const Eigen::Index columns = has_products ? m + products : m;
  surface.Phi_B = reader.matrix(at + "Phi_B", 3 * n, columns);
  surface.residual = reader.matrix(at + "residual", n, 1);
  surface.patch_radius = reader.matrix(at + "patch_radius", n, 1);
  surface.faces = read_faces(reader, at + "faces", surface.tags.size());
  surface.parts = read_parts(reader, at + "parts/", columns);
  surface.slices = read_slices(reader, at + "slices/", columns);
  const MatrixX material = reader.matrix(at + "material", 2, 1);
  surface.youngs_modulus = material(0, 0);
  surface.poisson_ratio = material(1, 0);
  return surface;
}

}  // namespace

void write_contact_surfaces(Hdf5File& out,
                            const std::vector<ContactSurface>& surfaces) {
  if (surfaces.empty()) return;
  out.write("contact/count", std::vector<std::int64_t>{std::ssize(surfaces)},
            "1", "contact surfaces");
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    write_surface(out, fmt::format("contact/{:04}/", i), surfaces[i]);
  }
}

std::vector<ContactSurface> read_contact_surfaces(const BodyFileReader& reader,
                                                  Eigen::Index m,
                                                  Eigen::Index products) {
  const std::size_t count = reader.sizes("contact/count", 1)[0];
  std::vector<ContactSurface> surfaces;
  for (std::size_t i = 0; i < count; ++i) {
    surfaces.push_back(
        read_surface(reader, fmt::format("contact/{:04}/", i), m, products));
  }
  return surfaces;
}

}  // namespace limber::flexbody
