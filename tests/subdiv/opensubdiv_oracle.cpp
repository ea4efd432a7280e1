#include "tests/subdiv/opensubdiv_oracle.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>
#include <stdexcept>

namespace argil::subdiv::test {

namespace {

namespace far = OpenSubdiv::Far;
namespace sdc = OpenSubdiv::Sdc;

struct Point {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  void Clear(void* = nullptr) { at.setZero(); }
  void AddWithWeight(const Point& other, double weight) { at += weight * other.at; }
};

Eigen::Matrix3Xd matrix(const std::vector<Point>& points) {
  Eigen::Matrix3Xd m(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) m.col(static_cast<Eigen::Index>(i)) = points[i].at;
  return m;
}

std::set<int> set_of(const far::ConstIndexArray& vertices) {
  return {vertices.begin(), vertices.end()};
}

}  // namespace

OpenSubdivResult refine_with_opensubdiv(const Eigen::Matrix3Xd& points, const std::vector<std::vector<int>>& faces,
                                        const std::map<std::set<int>, double>& sharp_edges,
                                        const std::map<int, double>& corners, int level_count) {
  std::vector<int> sizes, loops, edge_ends, corner_list;
  std::vector<float> edge_weights, corner_weights;
  for (const auto& face : faces) {
    sizes.push_back(static_cast<int>(face.size()));
    loops.insert(loops.end(), face.begin(), face.end());
  }
  for (const auto& [e, sharpness] : sharp_edges) {
    edge_ends.insert(edge_ends.end(), e.begin(), e.end());
    edge_weights.push_back(static_cast<float>(sharpness));
  }
  for (const auto& [v, sharpness] : corners) {
    corner_list.push_back(v);
    corner_weights.push_back(static_cast<float>(sharpness));
  }
  far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(points.cols());
  descriptor.numFaces = static_cast<int>(faces.size());
  descriptor.numVertsPerFace = sizes.data();
  descriptor.vertIndicesPerFace = loops.data();
  descriptor.numCreases = static_cast<int>(sharp_edges.size());
  descriptor.creaseVertexIndexPairs = edge_ends.data();
  descriptor.creaseWeights = edge_weights.data();
  descriptor.numCorners = static_cast<int>(corners.size());
  descriptor.cornerVertexIndices = corner_list.data();
  descriptor.cornerWeights = corner_weights.data();

  using Factory = far::TopologyRefinerFactory<far::TopologyDescriptor>;
  sdc::Options boundary;
  boundary.SetVtxBoundaryInterpolation(sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  Factory::Options options(sdc::SCHEME_CATMARK, boundary);
  options.validateFullTopology = true;
  const std::unique_ptr<far::TopologyRefiner> refiner(Factory::Create(descriptor, options));
  if (!refiner) throw std::runtime_error("OpenSubdiv refuses the surface");
  far::TopologyRefiner::UniformOptions uniform(level_count);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);

  OpenSubdivResult result;
  std::vector<Point> values(static_cast<std::size_t>(points.cols()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i].at = points.col(static_cast<Eigen::Index>(i));
  const far::PrimvarRefinerReal<double> interpolate(*refiner);
  for (int l = 1; l <= level_count; ++l) {
    const far::TopologyLevel& coarse = refiner->GetLevel(l - 1);
    std::vector<Point> fine(static_cast<std::size_t>(refiner->GetLevel(l).GetNumVertices()));
    interpolate.Interpolate(l, values, fine);
    values = fine;
    OpenSubdivLevel level;
    level.positions = matrix(values);
    for (int v = 0; v < coarse.GetNumVertices(); ++v) level.fine_from_coarse[{v}] = coarse.GetVertexChildVertex(v);
    for (int e = 0; e < coarse.GetNumEdges(); ++e)
      level.fine_from_coarse[set_of(coarse.GetEdgeVertices(e))] = coarse.GetEdgeChildVertex(e);
    for (int f = 0; f < coarse.GetNumFaces(); ++f)
      level.fine_from_coarse[set_of(coarse.GetFaceVertices(f))] = coarse.GetFaceChildVertex(f);
    result.levels.push_back(std::move(level));
  }
  std::vector<Point> limits(values.size());
  interpolate.Limit(values, limits);
  result.limits = matrix(limits);
  return result;
}

}  // namespace argil::subdiv::test
