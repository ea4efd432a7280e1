#pragma once
// OpenSubdiv as oracle: Catmull–Clark of a polygonal surface with sharp edges and corners; where it is open, its
// edges are creases (and its corners no more than that).

#include <Eigen/Core>
#include <map>
#include <set>
#include <vector>

namespace argil::subdiv::test {

struct OpenSubdivLevel {
  Eigen::Matrix3Xd positions;
  std::map<std::set<int>, int> fine_from_coarse;  // by the coarser level's vertices of a vertex, edge or face
};
struct OpenSubdivResult {
  std::vector<OpenSubdivLevel> levels;  // 1 … K
  Eigen::Matrix3Xd limits;              // of the last level's vertices
};

OpenSubdivResult refine_with_opensubdiv(const Eigen::Matrix3Xd& points, const std::vector<std::vector<int>>& faces,
                                        const std::map<std::set<int>, double>& sharp_edges,
                                        const std::map<int, double>& corners, int level_count);

}  // namespace argil::subdiv::test
