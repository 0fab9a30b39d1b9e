// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/xdmf_file.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <fstream>
#include <string>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/common/utf8.hpp"
#include "limber/flexbody/model/stress_modes.hpp"

namespace limber::results {
namespace {

// A field of numbers at nodes.
struct Field {
  const char* name;
  const char* kind;  // of an attribute of XDMF
  std::uint64_t components;
};

std::vector<Field> list_fields(const MovingSurface& surface) {
  std::vector<Field> fields = {{"deformation", "Scalar", 1},
                               {"deformation_vector", "Vector", 3},
                               {"displacement", "Vector", 3}};
  if (surface.has_stress) {
    fields.push_back({"von_mises", "Scalar", 1});
    fields.push_back({"stress", "Tensor6", 6});
  }
  return fields;
}

// A file's name as XML text.
std::string escape(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else if (c == '>') {
      text += "&gt;";
    } else {
      text += c;
    }
  }
  return text;
}

void write_item(std::ostream& out, const char* number, const std::string& shape,
                const std::string& place) {
  fmt::print(out,
             "<DataItem Dimensions=\"{}\" NumberType=\"{}\" "
             "Precision=\"8\" Format=\"HDF\">{}</DataItem>\n",
             shape, number, place);
}

std::string name_step(std::size_t i) { return fmt::format("steps/{:06}/", i); }

class DataWriter {
 public:
  DataWriter(Hdf5File& out, const MovingSurface& surface)
      : out_(out), surface_(surface) {}

  void write(std::size_t i) {
    const SurfaceFrame frame = surface_.find_frame(i);
    const std::string at = name_step(i);
    add(at + "points", frame.points, "m", "positions less offset, world axes");
    add(at + "deformation", frame.deformation.colwise().norm(), "m",
        "|Phi eta|");
    add(at + "deformation_vector", frame.deformation, "m",
        "Phi eta, world frame");
    add(at + "displacement", frame.displacement, "m",
        "from the start, world frame");
    if (!surface_.has_stress) return;
    MatrixX mises(1, surface_.nodes);
    for (Eigen::Index n = 0; n < surface_.nodes; ++n) {
      mises(0, n) = flexbody::calc_von_mises(frame.stress.col(n));
    }
    add(at + "von_mises", mises, "Pa", "von Mises stress");
    // In the order of XDMF.
    const std::array<int, 6> order = {0, 3, 5, 1, 4, 2};
    add(at + "stress", frame.stress(order, Eigen::all), "Pa",
        "xx, xy, xz, yy, yz, zz, world frame");
  }

 private:
  // A column a node.
  void add(const std::string& name, const MatrixX& values,
           const std::string& unit, const std::string& meaning) {
    LIMBER_EXPECT(values.cols() == surface_.nodes);
    std::vector<std::uint64_t> shape = {
        static_cast<std::uint64_t>(values.cols())};
    if (values.rows() > 1) {
      shape.push_back(static_cast<std::uint64_t>(values.rows()));
    }
    const std::vector<double> flat(values.data(),
                                   values.data() + values.size());
    out_.write_array(name, flat, shape, unit, meaning);
  }

  Hdf5File& out_;
  const MovingSurface& surface_;
};

void write_data(const std::filesystem::path& file,
                const MovingSurface& surface) {
  Hdf5File out = Hdf5File::create(file);
  out.write_array("triangles", surface.corners, {surface.corners.size() / 3, 3},
                  "1", "node indices");
  const std::vector<double> offset(surface.offset.begin(),
                                   surface.offset.end());
  out.write_array("offset", offset, {3}, "m",
                  "place of the points' origin, world frame");
  DataWriter writer(out, surface);
  for (std::size_t i = 0; i < surface.times.size(); ++i) writer.write(i);
  out.close();
}

void write_step(std::ostream& out, const MovingSurface& surface, double time,
                const std::string& data, const std::string& step) {
  const std::size_t triangles = surface.corners.size() / 3;
  fmt::print(out,
             "<Grid Name=\"bodies\" GridType=\"Uniform\">"
             "<Time Value=\"{:.17g}\"/>\n<Topology "
             "TopologyType=\"Triangle\" NumberOfElements=\"{}\">\n",
             time, triangles);
  write_item(out, "Int", fmt::format("{} 3", triangles), data + ":/triangles");
  out << "</Topology><Geometry GeometryType=\"XYZ\">\n";
  write_item(out, "Float", fmt::format("{} 3", surface.nodes),
             fmt::format("{}:/{}points", data, step));
  out << "</Geometry>";
  for (const Field& field : list_fields(surface)) {
    fmt::print(out,
               "<Attribute Name=\"{}\" AttributeType=\"{}\" "
               "Center=\"Node\">\n",
               field.name, field.kind);
    write_item(out, "Float",
               field.components == 1
                   ? fmt::format("{}", surface.nodes)
                   : fmt::format("{} {}", surface.nodes, field.components),
               fmt::format("{}:/{}{}", data, step, field.name));
    out << "</Attribute>";
  }
  out << "</Grid>\n";
}

void write_index(std::ostream& out, const MovingSurface& surface,
                 const std::string& data) {
  fmt::print(
      out,
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
      "<Information Name=\"offset\" Value=\"{:.17g} {:.17g} {:.17g}\"/>\n"
      "<Grid Name=\"bodies\" GridType=\"Collection\" "
      "CollectionType=\"Temporal\">\n",
      surface.offset[0], surface.offset[1], surface.offset[2]);
  for (std::size_t i = 0; i < surface.times.size(); ++i) {
    write_step(out, surface, surface.times[i], data, name_step(i));
  }
  out << "</Grid></Domain></Xdmf>\n";
}

// XDMF has no escape for these characters: a place is "FILE:/DATASET", with
// blanks around it removed, and "|" between several.
void check_data_name(const std::filesystem::path& file,
                     const std::string& data) {
  const char* problem = nullptr;
  if (data.find_first_of(":|") != std::string::npos) {
    problem = "has a ':' or '|'";
  } else if (data.front() == ' ') {
    problem = "begins with a blank";
  } else if (has_control(data)) {
    problem = "has a control character";
  } else if (!is_utf8(data)) {
    problem = "is not UTF-8";
  }
  if (problem == nullptr) return;
  throw InputError(
      fmt::format("'{}': its name {}, so that readers of XDMF would not find "
                  "'{}' beside it; choose another name",
                  echo(file.string()), problem, echo(data)));
}

}  // namespace

Matrix6X rotate_to_world(const Matrix6X& stress_B, const Matrix3& R_WB) {
  Matrix6X stress_W(6, stress_B.cols());
  for (Eigen::Index n = 0; n < stress_B.cols(); ++n) {
    stress_W.col(n) =
        flexbody::rotate_stress(stress_B.col(n), R_WB.transpose());
  }
  return stress_W;
}

void write_xdmf_file(const std::filesystem::path& file,
                     const MovingSurface& surface) {
  std::filesystem::path data = file;
  data.replace_extension(".h5");
  check_data_name(file, data.filename().string());
  write_whole(data, [&](const std::filesystem::path& part) {
    write_data(part, surface);
  });
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream out(part);
    write_index(out, surface, escape(data.filename().string()));
    out.flush();
    if (out) return;
    throw InputError(fmt::format("'{}' cannot be written; is the disk full?",
                                 file.string()));
  });
}

}  // namespace limber::results
