#pragma once
// A second MacCracken–Joy subdivider, slow and plain, as oracle: solids are lists of loops, incidence is found by
// searching sets, the skin is refined as a surface of its own; what is semi-sharp is a blend of two whole
// refinements. Shares no code with subdiv/.

#include <Eigen/Core>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace argil::subdiv::test {

using Points = std::vector<Eigen::Vector3d>;
using PointSet = std::set<int>;  // the vertices of an element: its name

struct ReferenceSolid {
  Points points;
  std::vector<std::vector<std::vector<int>>> cells;  // loops, counter-clockwise from outside the cell
  std::map<PointSet, double> sharpness;              // of edges, vertices, and faces inside; 10 is infinite
};

struct ReferenceStep {
  ReferenceSolid fine;
  std::map<PointSet, int> fine_from_coarse;  // of a coarse vertex, edge, face or cell
};
ReferenceStep refine(const ReferenceSolid& coarse);

/// New points of a polygonal surface by Catmull–Clark, by the vertices of the element.
std::map<PointSet, Eigen::Vector3d> catmull_clark(const Points& points, const std::vector<std::vector<int>>& faces,
                                                  const std::set<PointSet>& sharp_edges,
                                                  const std::set<int>& corners);

}  // namespace argil::subdiv::test
