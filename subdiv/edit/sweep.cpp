#include "subdiv/edit/sweep.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "subdiv/disjoint_sets.h"
#include "subdiv/edit/extrude.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/edit/sweep_path.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

constexpr double k_flat = 0.05;  // normals closer to a plane or a line than this share of the spread lie in it
constexpr double k_longest_spike = 4;  // of a vertex's way along the normals, against the distance

// The faces to extrude, as they lie in space before it.
class Region {
 public:
  Region(const Solid& solid, const Eigen::Matrix3Xd& rest, std::span<const FaceId> faces) : rest_(rest) {
    std::map<VertexId, std::uint32_t> numbers;
    for (const FaceId f : faces)
      for (const VertexId v : solid.face_vertices(f)) numbers.emplace(v, 0);
    std::uint32_t count = 0;
    for (auto& [v, number] : numbers) number = count++;
    DisjointSets patches(count);
    for (const FaceId f : faces) {
      const auto loop = use_vertices(solid, solid.boundary_use(f));
      Eigen::Vector3d area = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < loop.size(); ++i) area += at(loop[i]).cross(at(loop[(i + 1) % loop.size()]));
      for (const VertexId v : loop) {
        patches.unite(numbers.at(v), numbers.at(loop[0]));
        normals_[v].push_back(area);
      }
    }
    std::map<std::uint32_t, std::pair<Eigen::Vector3d, double>> sums;
    for (const auto& [v, number] : numbers) {
      auto& [sum, size] = sums.try_emplace(patches.find(number), Eigen::Vector3d::Zero(), 0.0).first->second;
      sum += at(v);
      size += 1;
    }
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    for (const auto& [v, number] : numbers) {
      const auto& [sum, size] = sums.at(patches.find(number));
      middle_[v] = sum / size;
      total += at(v);
    }
    middle_of_all_ = total / count;
    for (const FaceId f : faces) {
      const auto loop = use_vertices(solid, solid.boundary_use(f));
      for (std::size_t i = 0; i < loop.size(); ++i)
        area_[patches.find(numbers.at(loop[0]))] +=
            Eigen::Vector3d(at(loop[i]).cross(at(loop[(i + 1) % loop.size()])));
    }
    for (const auto& [v, number] : numbers) patch_[v] = patches.find(number);
  }

  Eigen::Vector3d at(VertexId v) const { return rest_.col(static_cast<Eigen::Index>(v.index())); }
  const Eigen::Vector3d& middle(VertexId v) const { return middle_.at(v); }
  const Eigen::Vector3d& middle() const { return middle_of_all_; }
  Eigen::Vector3d normal() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [patch, area] : area_) sum += area;
    return normalized(sum);
  }
  Eigen::Vector3d patch_normal(VertexId v) const { return normalized(area_.at(patch_.at(v))); }

  // The way whose share along the normal of each face at the vertex is 1, as nearly as can be.
  Eigen::Vector3d outward(VertexId v) const {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& area : normals_.at(v)) {
      if (!(area.norm() > 0)) continue;
      spread += area * area.transpose() / area.norm();
      sum += area;
    }
    (void)normalized(sum);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    Eigen::Vector3d way = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = axes.eigenvectors().col(i);
      if (axes.eigenvalues()[i] > k_flat * axes.eigenvalues()[2])
        way += axis.dot(sum) / axes.eigenvalues()[i] * axis;
    }
    return way.norm() > k_longest_spike ? Eigen::Vector3d(k_longest_spike * way.normalized()) : way;
  }

 private:
  static Eigen::Vector3d normalized(const Eigen::Vector3d& area) {
    if (area.norm() < 1e-300)
      throw Error(ErrorCode::bad_geometry,
                  "the faces have no common direction; give one with `along X Y Z`, or choose fewer faces");
    return area.normalized();
  }

  const Eigen::Matrix3Xd& rest_;
  std::map<VertexId, std::vector<Eigen::Vector3d>> normals_;  // times twice the area
  std::map<VertexId, Eigen::Vector3d> middle_;
  std::map<VertexId, std::uint32_t> patch_;
  std::map<std::uint32_t, Eigen::Vector3d> area_;
  Eigen::Vector3d middle_of_all_;
};

Eigen::Matrix3d twisted(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

class Placer {
 public:
  Placer(const Region& region, const Sweep& how) : region_(region), how_(how) {
    if (how.way != Sweep::Way::path) return;
    normal_ = region.normal();
    stations_ = stations(region.middle(), normal_, how.path, how.curve, how.steps);
  }

  Eigen::Vector3d offset(VertexId v, int step) const {
    if (how_.way == Sweep::Way::path) return along_path(v, stations_[static_cast<std::size_t>(step) - 1]);
    const double part = static_cast<double>(step) / how_.steps;
    const bool normals = how_.way == Sweep::Way::normals;
    const Eigen::Vector3d way = normals ? how_.distance * region_.outward(v) : how_.vector;
    const Eigen::Vector3d radius = region_.at(v) - region_.middle(v);
    if (how_.twist == 0) return part * way + part * (how_.scale - 1) * radius;
    const Eigen::Vector3d axis = normals ? region_.patch_normal(v) : how_.vector.normalized();
    return part * way + (1 + part * (how_.scale - 1)) * (twisted(part * how_.twist, axis) * radius) - radius;
  }

 private:
  Eigen::Vector3d along_path(VertexId v, const Station& station) const {
    const Eigen::Vector3d radius = region_.at(v) - region_.middle();
    const double size = 1 + station.part * (how_.scale - 1);
    return station.at + size * (station.turn * (twisted(station.part * how_.twist, normal_) * radius)) -
           region_.at(v);
  }

  const Region& region_;
  const Sweep& how_;
  Eigen::Vector3d normal_;
  std::vector<Station> stations_;
};

}  // namespace

Edit sweep(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const FaceId> faces,
           const Sweep& how) {
  check_extrusion(transaction.solid(), faces, how.steps);
  const Solid& solid = transaction.solid();
  const Region region(solid, rest, faces);
  const Placer placer(region, how);
  std::vector<std::vector<VertexId>> loops;
  for (const FaceId f : faces) loops.push_back(use_vertices(solid, solid.boundary_use(f)));

  const Extrusion grown = extrude(transaction, faces, how.steps);
  Edit edit;
  std::vector<VertexId> touched;
  std::map<VertexId, VertexId> top;
  for (std::size_t i = 0; i < grown.new_vertices.size(); ++i) {
    const VertexId source = grown.source_of_new[i];
    edit.placed.push_back({grown.new_vertices[i], {{source, 1.0}}, placer.offset(source, grown.step_of_new[i])});
    top[source] = grown.new_vertices[i];
    touched.push_back(grown.new_vertices[i]);
  }
  std::map<EdgeId, EdgeId> rims;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    edit.faces.push_back({grown.caps[i], faces[i]});
    for (const EdgeId e : solid.face_edges(faces[i])) {
      const auto [a, b] = solid.edge_vertices(e);
      rims.emplace(e, solid.find_edge(top.at(a), top.at(b)).value());
    }
  }
  for (const auto& [source, made] : rims) edit.edges.push_back({made, source});
  for (const auto& [source, made] : top) touched.push_back(source);
  edit.next_faces = grown.caps;
  check_links(solid, touched);
  return edit;
}

}  // namespace argil::subdiv
