#pragma once
// OpenSubdiv as oracle: Catmull–Clark of a closed polygonal surface with infinitely sharp edges and corners.

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
                                        const std::set<std::set<int>>& sharp_edges, const std::set<int>& corners,
                                        int level_count);

}  // namespace argil::subdiv::test
