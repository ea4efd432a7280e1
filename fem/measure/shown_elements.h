#pragma once
// Strain and stress as pictures, files and expectations show them: of trilinear elements (pyramids in irregular
// cells) between the vertices of the finest level where the space shows them. In the default space these are the
// elements that are integrated; in cubic space they sample the tricubic ones, with an error that falls with the
// square of the cell.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "fem/discretization.h"
#include "fem/element_block.h"
#include "fem/measure/stress.h"
#include "fem/models/plastic_flow.h"

namespace argil::fem {

class ShownElements {
 public:
  /// `rest_vertices`: 3 x vertices of the finest level, as shown at rest.
  ShownElements(const subdiv::Solid& finest, const Eigen::Matrix3Xd& rest_vertices, const NodalFields& fields);

  /// Stresses from here on are those of a body that has flowed. False, and nothing changes, if the flow is of other
  /// points: where the space integrates other elements than these.
  [[nodiscard]] bool take_flow(const PlasticFlow& flow);

  /// Per vertex, from the vertices as shown now. Stresses [Pa] are by the corotational law without `law`.
  [[nodiscard]] Eigen::VectorXd equivalent_strain(const Eigen::Matrix3Xd& vertices) const;
  [[nodiscard]] Eigen::VectorXd von_mises_stress(const Eigen::Matrix3Xd& vertices, StressLaw law = nullptr) const;
  /// Principal strains σ − 1 and stresses; `order` 0 is the largest, 2 the smallest.
  [[nodiscard]] Eigen::VectorXd principal_strain(const Eigen::Matrix3Xd& vertices, int order) const;
  [[nodiscard]] Eigen::VectorXd principal_stress(const Eigen::Matrix3Xd& vertices, int order,
                                                 StressLaw law = nullptr) const;
  /// Minus the mean of the principal stresses.
  [[nodiscard]] Eigen::VectorXd pressure(const Eigen::Matrix3Xd& vertices, StressLaw law = nullptr) const;
  /// Equivalent strain of the flow that take_flow() took: √(2/3) |log of F_p's stretch|; 0 without.
  [[nodiscard]] Eigen::VectorXd plastic_strain() const;
  /// det F − 1: the change of volume, by its share (papers/004, Fig. 13: "volumetric distortions").
  [[nodiscard]] Eigen::VectorXd distortion(const Eigen::Matrix3Xd& vertices) const;

 private:
  using OfBlock = std::function<Eigen::VectorXd(const ElementBlock&, const Eigen::Matrix3Xd& nodes)>;
  [[nodiscard]] Eigen::VectorXd recovered(const std::vector<ElementBlock>& blocks, const Eigen::Matrix3Xd& vertices,
                                          const OfBlock& point_values) const;
  [[nodiscard]] Eigen::Matrix3Xd with_apexes(const Eigen::Matrix3Xd& vertices) const;

  const std::vector<ElementBlock>& stressed_blocks() const {
    return flowed_blocks_.empty() ? blocks_ : flowed_blocks_;
  }

  std::vector<ElementBlock> blocks_;
  std::vector<ElementBlock> flowed_blocks_;                // with the rest Jacobians of the flow; empty without
  std::vector<Eigen::VectorXd> plastic_strains_;           // of the points of each block; empty without
  std::vector<std::vector<subdiv::VertexId>> apex_cells_;  // vertices whose mean an apex is
  Eigen::Index vertex_count_ = 0;
};

}  // namespace argil::fem
