#pragma once
// Strain and stress as pictures, files and expectations show them: of trilinear elements (pyramids in irregular
// cells) between the vertices of the finest level where the space shows them. In the default space these are the
// elements that are integrated; in cubic space they sample the tricubic ones, with an error that falls with the
// square of the cell.

#include <Eigen/Core>
#include <vector>

#include "fem/discretization.h"
#include "fem/element_block.h"

namespace argil::fem {

class ShownElements {
 public:
  /// `rest_vertices`: 3 x vertices of the finest level, as shown at rest.
  ShownElements(const subdiv::Solid& finest, const Eigen::Matrix3Xd& rest_vertices, const NodalFields& fields);

  /// Equivalent strain and von Mises stress [Pa] per vertex, from the vertices as shown now.
  [[nodiscard]] Eigen::VectorXd equivalent_strain(const Eigen::Matrix3Xd& vertices) const;
  [[nodiscard]] Eigen::VectorXd von_mises_stress(const Eigen::Matrix3Xd& vertices) const;

 private:
  [[nodiscard]] Eigen::Matrix3Xd with_apexes(const Eigen::Matrix3Xd& vertices) const;

  std::vector<ElementBlock> blocks_;
  std::vector<std::vector<subdiv::VertexId>> apex_cells_;  // vertices whose mean an apex is
  Eigen::Index vertex_count_ = 0;
};

}  // namespace argil::fem
