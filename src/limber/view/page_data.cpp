// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/page_data.hpp"

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "limber/common/escape_texts.hpp"
#include "limber/version.hpp"
#include "limber/view/compress.hpp"
#include "limber/view/extremes.hpp"
#include "limber/view/home.hpp"
#include "limber/view/page_arrays.hpp"

namespace limber::view {
namespace {

using nlohmann::json;

json to_json(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

struct PackedSurface {
  json header;
  double scale = 0.0;  // of positions [m]
  VectorX scales;      // of shapes [kg^-1/2]
};

class PageWriter {
 public:
  json write(const Recording& recording) {
    const results::Home home = find_home(recording);
    std::vector<PackedSurface> surfaces;
    json all = json::array();
    for (const Surface& surface : recording.surfaces) {
      surfaces.push_back(pack(surface));
      all.push_back(surfaces.back().header);
    }
    json result = {{"name", recording.name},
                   {"folder", recording.folder},
                   {"limber", recording.limber},
                   {"times", arrays_.add_doubles(recording.times)},
                   {"offset", to_json(home.offset)},
                   {"travels", home.travels},
                   {"surfaces", all}};
    for (const Body& body : recording.bodies) {
      result["bodies"].push_back(
          pack(body, body.surface < 0 ? nullptr
                                      : &surfaces[std::size_t(body.surface)]));
    }
    if (!recording.bodies.empty()) {
      const Extremes most = calc_extremes(recording, home);
      result["most"] = arrays_.add(most.fields);
      result["box"] = {to_json(most.lower), to_json(most.upper)};
    }
    add_marks(recording, home, result);
    return result;
  }

  [[nodiscard]] std::string finish(const json& header) const {
    const std::string text = escape_texts(header).dump();
    std::string bytes(4, '\0');
    const auto length = static_cast<std::uint32_t>(text.size());
    std::memcpy(bytes.data(), &length, 4);
    bytes += text;
    bytes.resize((bytes.size() + 7) / 8 * 8, ' ');
    return bytes + arrays_.bytes();
  }

 private:
  json pack_stress(const MatrixX& Sigma_B) {
    json stress = json::array();
    for (Eigen::Index k = 0; k < Sigma_B.cols(); ++k) {
      const Quantised mode = quantise(Sigma_B.col(k));
      stress.push_back(
          {{"scale", mode.scale}, {"values", arrays_.add(mode.integers)}});
    }
    return stress;
  }

  PackedSurface pack(const Surface& surface) {
    PackedSurface packed;
    const Vector3 origin = surface.x_B.rowwise().mean();
    const Matrix3X centred = surface.x_B.colwise() - origin;
    const Quantised x = quantise(VectorX(centred.reshaped()));
    packed.scale = x.scale;
    packed.scales.resize(surface.Phi_B.cols());
    json shapes = json::array();
    for (Eigen::Index k = 0; k < surface.Phi_B.cols(); ++k) {
      const Quantised shape = quantise(surface.Phi_B.col(k));
      packed.scales[k] = shape.scale;
      shapes.push_back(
          {{"scale", shape.scale}, {"values", arrays_.add(shape.integers)}});
    }
    const auto to_unsigned = [](const std::vector<std::int64_t>& values) {
      return std::vector<std::uint32_t>(values.begin(), values.end());
    };
    packed.header = {{"body", surface.body},
                     {"nodes", surface.tags.size()},
                     {"tags", arrays_.add(to_unsigned(surface.tags))},
                     {"origin", to_json(origin)},
                     {"scale", x.scale},
                     {"x", arrays_.add(x.integers)},
                     {"shapes", shapes},
                     {"triangles", arrays_.add(to_unsigned(surface.corners))}};
    if (surface.Sigma_B.cols() > 0) {
      packed.header["stress"] = pack_stress(surface.Sigma_B);
    }
    return packed;
  }

  // Bound of the page's positions at magnification 1 [m].
  static double bound_error(const Body& body, const PackedSurface& surface) {
    double shapes = 0.0;
    if (body.eta.cols() > 0) {
      shapes = (body.eta.cwiseAbs() * surface.scales).maxCoeff();
    }
    return std::sqrt(3.0) / 2.0 * (surface.scale + shapes);
  }

  json pack(const Body& body, const PackedSurface* surface) {
    json packed = {
        {"name", body.name},
        {"level", body.level},
        {"mass", body.mass},
        {"inertia", arrays_.add_doubles(VectorX(body.inertia.reshaped()))},
        {"surface", body.surface},
        {"p", arrays_.add_doubles(body.p_WB.transpose().reshaped())},
        {"q", arrays_.add(body.quat_WB)},
        {"v", arrays_.add(body.v_WB_W)},
        {"w", arrays_.add(body.w_WB_B)}};
    if (surface == nullptr) return packed;
    packed["modes"] = body.eta.cols();
    packed["eta"] = arrays_.add(body.eta);
    if (body.etadot.cols() > 0) packed["etadot"] = arrays_.add(body.etadot);
    packed["error"] = bound_error(body, *surface);
    if (body.truncation > 0.0) packed["truncation"] = body.truncation;
    if (body.Sigma_B.rows() > 0) {
      packed["stress"] = pack_stress(body.Sigma_B);
      packed["zeta"] = arrays_.add(body.zeta);
      packed["stress_truncation"] = body.stress_truncation;
    }
    return packed;
  }

  json pack(const Anchor& anchor) {
    return {{"body", anchor.body},
            {"p", to_json(anchor.p_B)},
            {"shapes", arrays_.add(anchor.Phi_B)}};
  }

  json pack(const results::Band& band) {
    const auto add = [&](const std::vector<double>& list) {
      return arrays_.add_doubles(
          Eigen::Map<const VectorX>(list.data(), std::ssize(list)));
    };
    return {{"edges", add(band.edges)},
            {"least", add(band.least)},
            {"most", add(band.most)}};
  }

  /// Places from the home, forces as they are.
  static MatrixX find_touch(const Contact& contact, const results::Home& home) {
    MatrixX touch = contact.touch;
    touch.leftCols<3>().rowwise() -= home.offset.transpose();
    touch.leftCols<3>() -= home.path;
    return touch;
  }

  void add_marks(const Recording& recording, const results::Home& home,
                 json& result) {
    for (const Shape& shape : recording.shapes) {
      const Quaternion q(shape.X_BS.R);
      json packed = {
          {"name", shape.name},         {"body", shape.body},
          {"kind", shape.form.kind},    {"size", to_json(shape.form.size)},
          {"p", to_json(shape.X_BS.p)}, {"q", {q.w(), q.x(), q.y(), q.z()}}};
      if (shape.form.kind == "mesh") {
        // A column a corner.
        packed["x"] = arrays_.add(MatrixX(shape.form.x.transpose()));
        packed["triangles"] = arrays_.add(shape.form.corners);
      }
      result["shapes"].push_back(std::move(packed));
    }
    for (const Mark& mark : recording.marks) {
      json points = json::array();
      for (const Anchor& point : mark.points) points.push_back(pack(point));
      result["marks"].push_back(
          {{"name", mark.name}, {"kind", mark.kind}, {"points", points}});
    }
    for (const Load& load : recording.loads) {
      result["loads"].push_back(
          {{"name", load.name},
           {"in_world", load.in_world},
           {"force", to_json(load.force)},
           {"moment", to_json(load.moment)},
           {"course",
            arrays_.add_doubles(VectorX(load.course.transpose().reshaped()))},
           {"where", pack(load.where)}});
    }
    for (const Contact& contact : recording.contacts) {
      result["contacts"].push_back(
          {{"name", contact.name},
           {"touch", arrays_.add(find_touch(contact, home))},
           {"patch", arrays_.add(contact.patch)}});
    }
    for (const Event& event : recording.events) {
      result["events"].push_back({{"time", event.time},
                                  {"source", event.source},
                                  {"what", event.what}});
    }
    for (const Probe& probe : recording.probes) {
      json packed = {{"name", probe.name},
                     {"unit", probe.unit},
                     {"values", arrays_.add_doubles(probe.values)}};
      if (probe.peak) {
        packed["peak"] = {{"value", probe.peak->value},
                          {"time", probe.peak->time}};
      }
      if (probe.error) packed["error"] = *probe.error;
      if (probe.band) packed["band"] = pack(*probe.band);
      result["probes"].push_back(std::move(packed));
    }
  }

  PageArrays arrays_;
};

}  // namespace

std::string pack_page_data(std::span<const Recording> recordings) {
  PageWriter writer;
  json header = {{"layout", 2}, {"limber", LIMBER_VERSION}};
  for (const Recording& recording : recordings) {
    header["results"].push_back(writer.write(recording));
  }
  return writer.finish(header);
}

std::string make_page_data(std::span<const Recording> recordings) {
  return compress(pack_page_data(recordings));
}

}  // namespace limber::view
