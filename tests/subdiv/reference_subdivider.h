#pragma once
// A second MacCracken–Joy subdivider, slow and plain, as oracle: solids are lists of loops, incidence is found by
// searching sets, the boundary is refined as a surface of its own. Shares no code with subdiv/.

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
  std::set<PointSet> sharp_edges;
  std::set<int> corners;
};

struct ReferenceStep {
  ReferenceSolid fine;
  std::map<PointSet, int> fine_from_coarse;  // of a coarse vertex, edge, face or cell
};
ReferenceStep refine(const ReferenceSolid& coarse);

/// New points of a closed polygonal surface by Catmull–Clark, by the vertices of the element.
std::map<PointSet, Eigen::Vector3d> catmull_clark(const Points& points, const std::vector<std::vector<int>>& faces,
                                                  const std::set<PointSet>& sharp_edges,
                                                  const std::set<int>& corners);

}  // namespace argil::subdiv::test
