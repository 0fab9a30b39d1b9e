// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/fem/mesh/mesh_reader.hpp"

/// Small meshes for the tests of src/limber/fem.
namespace limber::fem::testing {

/// The box that most tests mesh [m]; no two lengths alike, off the origin.
inline const Vector3 kBoxCorner{0.7, -0.4, 0.2};
inline const Vector3 kBoxSize{0.3, 0.2, 0.1};

/// A folder of the running test's own, empty at first.
[[nodiscard]] std::filesystem::path make_test_folder();

/// Writes `text` to a file of that name in the test's folder.
std::filesystem::path write_file(const std::string& name,
                                 const std::string& text);

/// The InputError that read_mesh throws; a failure of the test if it does not.
[[nodiscard]] std::string find_read_error(const std::filesystem::path& file);

/// A linear mesh as .msh 2.2 text, built by hand.
class MshText {
 public:
  static constexpr int kTriangle = 2;
  static constexpr int kTetrahedron = 4;
  static constexpr int kHexahedron = 5;
  static constexpr int kPrism = 6;
  static constexpr int kPyramid = 7;

  /// Gmsh's tag of the new node: 1, 2, ...
  int add_node(const Vector3& x);
  /// @param volume geometric volume (or surface) and its physical group
  void add_element(int gmsh_type, const std::vector<int>& nodes,
                   int volume = 1);
  void name_group(int dimension, int tag, const std::string& name);
  [[nodiscard]] std::string str() const;

 private:
  std::string names_;
  std::string nodes_;
  std::string elements_;
  int name_count_ = 0;
  int node_count_ = 0;
  int element_count_ = 0;
};

/// One tetrahedron at the origin's corner: volume 1/6.
[[nodiscard]] MshText unit_tetrahedron();

/// How Gmsh shall write a mesh.
struct MshForm {
  double version = 4.1;
  bool binary = false;
  int order = 0;             ///< 0: as it is
  bool serendipity = false;  ///< second order without face and inner nodes
  int bulk_fields = 1;       ///< of .bdf: 0 free, 1 small, 2 large
};

/// Opens `source` (.geo, .msh), meshes it if it is not, raises its order, and
/// writes it in the test's folder.
std::filesystem::path convert(const std::filesystem::path& source,
                              const std::string& name, const MshForm& form);

/// The box as .geo: transfinite tetrahedra, transfinite hexahedra, or layers
/// of prisms, by `commands` on the base and its extrusion.
enum class BoxKind { tetrahedra, hexahedra, prisms };
[[nodiscard]] std::string box_geo(BoxKind kind);

/// Box of all four shapes: two prisms, a hexahedron, two pyramids and eight
/// tetrahedra around one apex. With `skew` the faces between them are
/// warped, but the box stays.
[[nodiscard]] std::string mixed_msh(double skew);
/// Box of six pyramids around one apex.
[[nodiscard]] std::string pyramids_msh();

}  // namespace limber::fem::testing
