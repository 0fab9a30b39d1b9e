// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/piece_names.hpp"
#include "limber/results/path_step.hpp"
#include "limber/results/results_file.hpp"
#include "limber/view/surface_edges.hpp"

namespace limber::view {
namespace {

namespace fs = std::filesystem;

// Pages and scenes hold single precision, squares of it among them.
constexpr double kLargest = 1e18;

class RecordingReader {
 public:
  explicit RecordingReader(const fs::path& file)
      : file_(file), in_(Hdf5File::open(file)) {}

  Recording read() {
    check_layout();
    recording_.name = in_.read_text("scene/name");
    recording_.limber = in_.read_text("scene/limber");
    recording_.times = matrix("time", -1, 1).col(0);
    check_times();
    read_surfaces();
    read_bodies();
    read_shapes();
    read_marks();
    read_loads();
    read_contacts();
    read_events();
    read_probes();
    return std::move(recording_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("'{}' {}", file_.string(), what));
  }

  void check_layout() const {
    if (!results::is_results_file(file_)) {
      fail("is not a results file of Limber's");
    }
    if (!in_.has("scene/version")) {
      fail(
          "has no surfaces and shapes to draw: it was written by an earlier "
          "version of Limber, or by another command than `limber run`. Run the "
          "scenario again");
    }
    const auto version = in_.read_integers("scene/version");
    if (version.size() == 1 && version[0] == results::kSceneryVersion) return;
    fail(fmt::format(
        "holds its drawing data in layout {}, but this version of Limber reads "
        "layout {}. Run the scenario again",
        version.empty() ? 0 : version[0], results::kSceneryVersion));
  }

  void check_times() const {
    const VectorX& times = recording_.times;
    if (times.size() == 0) fail("has no output times");
    for (Eigen::Index i = 1; i < times.size(); ++i) {
      if (times[i] > times[i - 1]) continue;
      fail(fmt::format("is damaged: output {} is at {} s, not after {} s",
                       i + 1, times[i], times[i - 1]));
    }
  }

  Eigen::Index outputs() const { return recording_.times.size(); }

  /// Of finite values. @param rows, cols expected; -1: any
  MatrixX matrix(const std::string& name, Eigen::Index rows,
                 Eigen::Index cols) const {
    MatrixX values = matrix_with_gaps(name, rows, cols);
    if (!values.allFinite()) {
      fail(fmt::format("is damaged: '{}' has a value that is NaN or infinity",
                       name));
    }
    if (values.size() > 0 && values.cwiseAbs().maxCoeff() > kLargest) {
      fail(fmt::format("cannot be drawn: '{}' has a value beyond {:.0e}", name,
                       kLargest));
    }
    return values;
  }

  /// Of rotations, w x y z in each row.
  MatrixX quaternions(const std::string& name, Eigen::Index rows) const {
    MatrixX q = matrix(name, rows, 4);
    const auto errors = (q.rowwise().norm().array() - 1.0).abs();
    if (errors.maxCoeff() < 1e-3) return q;
    fail(fmt::format("is damaged: '{}' is not a rotation", name));
  }

  /// As `matrix`, of values that may be NaN.
  MatrixX matrix_with_gaps(const std::string& name, Eigen::Index rows,
                           Eigen::Index cols) const {
    MatrixX values = in_.read_matrix(name);
    if ((rows < 0 || values.rows() == rows) &&
        (cols < 0 || values.cols() == cols)) {
      return values;
    }
    fail(fmt::format("is damaged: '{}' is {} x {}", name, values.rows(),
                     values.cols()));
  }

  Vector3 vector(const std::string& name) const {
    return matrix(name, 1, 3).row(0);
  }

  int find_body(const std::string& name) const {
    if (name.empty()) return -1;
    const auto found = body_of_.find(name);
    if (found != body_of_.end()) return found->second;
    fail(fmt::format("is damaged: it has no body '{}'", name));
  }

  void read_surfaces() {
    for (const std::string& name : in_.list("scene/surfaces")) {
      const std::string at = "scene/surfaces/" + name + "/";
      Surface surface;
      surface.body = in_.read_text(at + "body");
      surface.key = in_.read_text(at + "key");
      surface.tags = in_.read_integers(at + "tags");
      const auto n = std::ssize(surface.tags);
      surface.x_B = matrix(at + "x_B", 3, n);
      surface.Phi_B = matrix(at + "Phi_B", 3 * n, -1);
      if (in_.has(at + "Sigma_B")) {
        surface.Sigma_B = matrix(at + "Sigma_B", 6 * n, surface.Phi_B.cols());
      }
      surface.corners = in_.read_integers(at + "triangles");
      check_triangles(surface.corners, n, at);
      surface_of_[name] = static_cast<int>(recording_.surfaces.size());
      recording_.surfaces.push_back(std::move(surface));
    }
  }

  void read_bodies() {
    std::vector<std::string> bare;
    std::map<std::int64_t, Body> by_place;
    for (const std::string& step : in_.list("scene/bodies")) {
      Body body;
      body.name = results::from_path_step(step);
      const auto place = in_.read_integers("scene/bodies/" + step + "/place");
      if (place.size() != 1 || by_place.contains(place[0])) {
        fail(fmt::format("is damaged: place of body '{}'", body.name));
      }
      if (read_surface_of(step, body)) {
        read_states(step, body);
      } else {
        bare.push_back(body.name);
      }
      by_place.emplace(place[0], std::move(body));
    }
    if (!bare.empty()) refuse(bare);
    for (auto& [place, body] : by_place) {
      body_of_[body.name] = static_cast<int>(recording_.bodies.size());
      recording_.bodies.push_back(std::move(body));
    }
    const std::vector<std::string> open = find_open_links();
    if (!open.empty()) refuse(open);
  }

  /// @returns whether it has a surface or needs none
  bool read_surface_of(const std::string& step, Body& body) const {
    const std::string at = "scene/bodies/" + step + "/";
    if (!in_.has(at + "surface")) return true;
    const std::string name = in_.read_text(at + "surface");
    const auto found = surface_of_.find(name);
    if (found == surface_of_.end()) {
      if (name == "none") return false;
      fail(fmt::format("is damaged: it has no surface '{}'", name));
    }
    body.surface = found->second;
    return true;
  }

  /// Names of links whose surfaces are open: rows of a group or an interface
  /// have the triangles between them alone. Pieces of a link are open where
  /// they are cut, and closed together.
  [[nodiscard]] std::vector<std::string> find_open_links() const {
    std::map<std::string, std::vector<Edge>> edges;
    for (const Body& body : recording_.bodies) {
      if (body.surface < 0) continue;
      const Surface& surface = recording_.surfaces[std::size_t(body.surface)];
      add_edges(surface.tags, surface.corners, edges[find_whole(body.name)]);
    }
    std::vector<std::string> open;
    for (const auto& [link, all] : edges) {
      if (!are_closed(all)) open.push_back(link);
    }
    return open;
  }

  [[noreturn]] void refuse(const std::vector<std::string>& bare) const {
    fail(fmt::format(
        "cannot be drawn: not all nodes on the surface of {} '{}' were kept. "
        "Take rows=\"boundary\" (the default) in <flexible><basis> of the "
        "robot, or `limber reduce --rows boundary` for a saved body, and run "
        "the scenario again. A link from matrices has no closed surface and "
        "cannot be drawn",
        bare.size() == 1 ? "link" : "links", fmt::join(bare, "', '")));
  }

  void read_states(const std::string& step, Body& body) {
    const std::string drawn = "scene/bodies/" + step + "/";
    const std::string at = "bodies/" + step + "/";
    const Eigen::Index T = outputs();
    body.level = in_.read_text(at + "fidelity");
    if (body.surface < 0 && body.level != "rigid") {
      fail(fmt::format("is damaged: flexible link '{}' has no surface",
                       body.name));
    }
    body.mass = matrix(drawn + "mass", 1, 1)(0, 0);
    body.inertia = matrix(drawn + "inertia", 3, 3);
    body.p_WB = matrix(at + "p_WB", T, 3);
    body.quat_WB = quaternions(at + "quat_WB", T);
    body.v_WB_W = matrix(at + "v_WB_W", T, 3);
    body.w_WB_B = matrix(at + "w_WB_B", T, 3);
    const Eigen::Index m =
        body.surface < 0
            ? 0
            : recording_.surfaces[std::size_t(body.surface)].Phi_B.cols();
    body.eta.resize(T, m);
    body.etadot.resize(T, 0);
    if (m == 0) return;
    if (in_.has(drawn + "eta")) {
      body.eta = matrix(drawn + "eta", T, m);
      body.truncation = matrix(drawn + "truncation", 1, 1)(0, 0);
    } else {
      body.eta = matrix(at + "eta", T, m);
      body.etadot = matrix(at + "etadot", T, m);
    }
    if (in_.has(drawn + "Sigma_B")) read_stress(drawn, body);
  }

  void read_stress(const std::string& drawn, Body& body) const {
    const auto nodes =
        std::ssize(recording_.surfaces[std::size_t(body.surface)].tags);
    body.Sigma_B = matrix(drawn + "Sigma_B", 6 * nodes, -1);
    body.zeta = matrix(drawn + "zeta", outputs(), body.Sigma_B.cols());
    body.stress_truncation = matrix(drawn + "stress_truncation", 1, 1)(0, 0);
  }

  Anchor read_anchor(const std::string& at) const {
    Anchor anchor;
    anchor.body = find_body(in_.read_text(at + "body"));
    anchor.p_B = vector(at + "p_B");
    anchor.Phi_B = matrix(at + "Phi_B", 3, -1);
    const Eigen::Index m =
        anchor.body < 0
            ? 0
            : recording_.bodies[std::size_t(anchor.body)].eta.cols();
    // A body without a surface to move has no coordinates here.
    if (m == 0) anchor.Phi_B.resize(3, 0);
    if (anchor.Phi_B.cols() != 0 && anchor.Phi_B.cols() != m) {
      fail(fmt::format("is damaged: modes at '{}'", at));
    }
    return anchor;
  }

  void read_shapes() {
    for (const std::string& step : in_.list("scene/shapes")) {
      const std::string at = "scene/shapes/" + step + "/";
      Shape shape;
      shape.name = in_.read_text(at + "name");
      shape.body = find_body(in_.read_text(at + "body"));
      shape.form.kind = in_.read_text(at + "kind");
      shape.form.size = vector(at + "size");
      if (shape.form.kind == "mesh") read_mesh(at, shape.form);
      const MatrixX q = quaternions(at + "quat_BS", 1);
      shape.X_BS = {Quaternion(q(0, 0), q(0, 1), q(0, 2), q(0, 3))
                        .normalized()
                        .toRotationMatrix(),
                    vector(at + "p_BS")};
      recording_.shapes.push_back(std::move(shape));
    }
  }

  void read_mesh(const std::string& at, results::SolidShape& form) const {
    form.x = matrix(at + "x", 3, -1);
    const auto corners = in_.read_integers(at + "triangles");
    check_triangles(corners, form.x.cols(), at);
    form.corners.assign(corners.begin(), corners.end());
  }

  void check_triangles(const std::vector<std::int64_t>& corners,
                       std::int64_t nodes, const std::string& at) const {
    const bool is_inside = std::all_of(
        corners.begin(), corners.end(),
        [nodes](std::int64_t node) { return node >= 0 && node < nodes; });
    if (is_inside && nodes > 0 && corners.size() % 3 == 0) return;
    fail(fmt::format("is damaged: triangles of '{}'", at));
  }

  void read_marks() {
    for (const std::string& step : in_.list("scene/couplers")) {
      const std::string at = "scene/couplers/" + step + "/";
      recording_.marks.push_back(
          {in_.read_text(at + "name"),
           in_.read_text(at + "kind"),
           {read_anchor(at + "F/"), read_anchor(at + "M/")}});
    }
    for (const std::string& step : in_.list("scene/lines")) {
      const std::string at = "scene/lines/" + step + "/";
      Mark line{in_.read_text(at + "name"), "tendon", {}};
      for (const std::string& point : in_.list(at + "points")) {
        line.points.push_back(read_anchor(at + "points/" + point + "/"));
      }
      recording_.marks.push_back(std::move(line));
    }
  }

  void read_loads() {
    for (const std::string& step : in_.list("scene/loads")) {
      const std::string at = "scene/loads/" + step + "/";
      Load load;
      load.name = in_.read_text(at + "name");
      load.in_world = in_.read_text(at + "frame") == "world";
      load.force = vector(at + "force");
      load.moment = vector(at + "moment");
      load.course = matrix(at + "course", -1, 2);
      load.where = read_anchor(at);
      recording_.loads.push_back(std::move(load));
    }
  }

  void read_contacts() {
    for (const std::string& step : in_.list("scene/contacts")) {
      const std::string at = "scene/contacts/" + step + "/";
      // Files of older versions have no patches.
      recording_.contacts.push_back(
          {in_.read_text(at + "name"),
           matrix_with_gaps(at + "touch", outputs(), 6),
           in_.has(at + "patch") ? matrix_with_gaps(at + "patch", outputs(), 10)
                                 : MatrixX()});
    }
  }

  void read_events() {
    const MatrixX times = matrix("events/time", -1, 1);
    std::istringstream sources(in_.read_text("events/source"));
    std::istringstream whats(in_.read_text("events/what"));
    for (Eigen::Index i = 0; i < times.rows(); ++i) {
      Event event;
      event.time = times(i, 0);
      std::getline(sources, event.source);
      std::getline(whats, event.what);
      recording_.events.push_back(std::move(event));
    }
  }

  void read_probes() {
    for (const std::string& step : in_.list("probes")) {
      Probe probe{results::from_path_step(step),
                  in_.read_unit("probes/" + step),
                  matrix("probes/" + step, outputs(), 1).col(0)};
      if (in_.has("peaks/" + step)) {
        const MatrixX peak = matrix("peaks/" + step, 1, 2);
        probe.peak = {peak(0, 0), peak(0, 1)};
      }
      if (in_.has("errors/" + step)) {
        probe.error = matrix("errors/" + step, 1, 1)(0, 0);
      }
      if (in_.has("envelopes/" + step)) probe.band = read_band(step, probe);
      recording_.probes.push_back(std::move(probe));
    }
  }

  // None if the curve through the outputs shows as much.
  std::optional<results::Band> read_band(const std::string& step,
                                         const Probe& probe) {
    const MatrixX edges = matrix("envelope_edges", -1, 1);
    if (edges.rows() < 2) fail("is damaged: its envelopes have no interval");
    const MatrixX values =
        matrix_with_gaps("envelopes/" + step, edges.rows() - 1, 2);
    results::Band band{to_list(edges.col(0)), to_list(values.col(0)),
                       to_list(values.col(1))};
    if (!exceeds(band, to_list(recording_.times), to_list(probe.values))) {
      return std::nullopt;
    }
    return band;
  }

  static std::vector<double> to_list(const VectorX& values) {
    return {values.begin(), values.end()};
  }

  fs::path file_;
  Hdf5File in_;
  Recording recording_;
  std::map<std::string, int> surface_of_;
  std::map<std::string, int> body_of_;
};

}  // namespace

fs::path find_results(const fs::path& results) {
  if (!fs::exists(results)) {
    throw InputError(
        fmt::format("'{}': no such file or folder", results.string()));
  }
  if (!fs::is_directory(results)) return results;
  if (fs::exists(results / "results.h5")) return results / "results.h5";
  throw InputError(fmt::format(
      "'{}' is not a results folder: it has no results.h5. Give the folder "
      "that `limber run` named",
      results.string()));
}

Recording read_recording(const fs::path& results) {
  const fs::path file = find_results(results);
  Recording recording = RecordingReader(file).read();
  recording.folder = fs::absolute(file).parent_path().filename().string();
  return recording;
}

Matrix3X calc_positions(const Recording& recording, int body, Eigen::Index i,
                        const Vector3& offset) {
  const Body& b = recording.bodies.at(static_cast<std::size_t>(body));
  const Surface& surface =
      recording.surfaces.at(static_cast<std::size_t>(b.surface));
  const VectorX u = surface.Phi_B * b.eta.row(i).transpose();
  const Matrix3X y = surface.x_B + u.reshaped(3, surface.x_B.cols());
  const Quaternion q(b.quat_WB(i, 0), b.quat_WB(i, 1), b.quat_WB(i, 2),
                     b.quat_WB(i, 3));
  return (q.toRotationMatrix() * y).colwise() +
         Vector3(b.p_WB.row(i).transpose() - offset);
}

}  // namespace limber::view
