#pragma once
// Small meshes as MEDIT text, for tests that hand files to the program.

#include <fmt/format.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace argil::tests {

using Corner = std::array<double, 3>;

/// `section` is Hexahedra, Tetrahedra …; vertices are numbered from 0 here.
inline std::string medit(const std::vector<Corner>& corners, const std::string& section,
                         const std::vector<std::vector<int>>& cells) {
  std::string text = fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", corners.size());
  for (const Corner& p : corners) text += fmt::format("{:.17g} {:.17g} {:.17g} 0\n", p[0], p[1], p[2]);
  text += fmt::format("{}\n{}\n", section, cells.size());
  for (const auto& cell : cells) {
    for (const int vertex : cell) text += fmt::format("{} ", vertex + 1);
    text += "0\n";
  }
  return text + "End\n";
}

/// nx × ny × nz cubes of side `side` with a corner at the origin; those that `keep` refuses are left out.
inline std::string cube_grid(int nx, int ny, int nz, double side = 1,
                             const std::function<bool(int, int, int)>& keep = {}) {
  std::vector<Corner> corners;
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) corners.push_back({i * side, j * side, k * side});
  const auto at = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  std::vector<std::vector<int>> cells;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        if (!keep || keep(i, j, k))
          cells.push_back({at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
                           at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
  return medit(corners, "Hexahedra", cells);
}

/// Eight cubes about a hole: a torus.
inline std::string ring() {
  return cube_grid(3, 3, 1, 1, [](int i, int j, int) { return i != 1 || j != 1; });
}

}  // namespace argil::tests
