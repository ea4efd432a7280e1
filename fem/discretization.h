#pragma once
// From a refinement to element blocks: the node table, which element stands for which cell in the chosen space,
// quadrature, mass and damping in the control points.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "fem/element_block.h"
#include "fem/node_table.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/refinement.h"

namespace argil::fem {

enum class Space {
  standard,  // "default": trilinear elements (pyramids in irregular cells) on d = A p of the finest level
  cubic,     // tricubic elements at the coarsest regular level, the rest split trilinear ones at limit positions
  published  // papers/004: both kinds on the vertices of the finest level. Not continuous, for the chart only
};
struct SpaceKind {
  Space space;
  std::string_view name;     // as in a session
  std::string_view summary;  // without a full stop
};
/// The default first.
[[nodiscard]] std::span<const SpaceKind> space_table();
[[nodiscard]] std::string_view word(Space space);
/// @throws Error (not_found) that lists the names.
[[nodiscard]] Space space_by_name(std::string_view name);

/// Values at the vertices of the finest level (by vertex id); what a quadrature point sees is interpolated from
/// them.
struct NodalFields {
  Eigen::VectorXd young_modulus;  // [Pa]
  Eigen::VectorXd poisson_ratio;
  Eigen::VectorXd density;  // [kg/m³]
  Eigen::VectorXd damping;  // [1/s]
  // Zero where empty:
  Eigen::VectorXd stiffness_damping = {};  // [s]
  Eigen::VectorXd prestress = {};          // [Pa]
};

struct DiscretizationOptions {
  Space space = Space::standard;
  int split =
      1;  // cubic space: remaining cells are split 2^split-fold (METHODS §3: patch residual .053, .013, .0034)
};

struct CellCounts {  // at the finest level; regular includes regular_published
  std::size_t regular = 0, regular_published = 0, extraordinary = 0, irregular = 0;
};
struct ElementCounts {  // those integrated
  std::size_t cubic = 0, linear = 0, pyramid = 0;
  std::size_t pyramids_without_stiffness = 0;  // below 1e-3 of their cell's volume; they keep their mass
};

/// Where the fields at quadrature points come from: values at samples, then shape functions of an element's corners
/// (its own nodes, or the eight corners of a tricubic element's cell).
struct FieldSamples {
  subdiv::Stencils rows;                            // sample = rows * values at the vertices of the finest level
  std::vector<std::vector<std::uint32_t>> corners;  // per block: [element * corner_count + corner], samples
};

struct Discretization {
  Space space = Space::standard;
  int level = 0;
  NodeTable nodes;
  std::vector<ElementBlock> blocks;
  CellCounts cells;
  ElementCounts elements;
  Eigen::Matrix3Xd rest_nodes;  // 3 x nodes
  /// Row of the node table that shows vertex v of the finest level: the vertex itself, in cubic space its limit
  /// point.
  std::vector<std::uint32_t> surface_node_from_vertex;
  subdiv::Stencils rows_transposed;  // Aᵀ
  FieldSamples field_samples;
  Eigen::SparseMatrix<double> mass;     // control points, consistent: Aᵀ M A [kg]
  Eigen::SparseMatrix<double> damping;  // ∫ damping · density NᵀN [kg/s]
  double rest_volume = 0, total_mass = 0;
};

[[nodiscard]] CellCounts count_cells(const subdiv::Solid& finest);

/// Default space: rows are the vertices of the finest level and the virtual centres; every hexahedron is an
/// element, every other cell gives a pyramid over each of its faces. Cubic space (METHODS §2, §3): a regular cell
/// over which the fields are trilinear (to 1e-12) becomes one tricubic element at the coarsest such level, at the
/// finest level any regular cell does; what is left is refined `split` times more and meshed linearly, nodes at
/// limit positions. Published (papers/004 §3.4.4): cells of the finest level that are regular by the paper's
/// criterion become tricubic elements that read its vertices as control points, all others are as in the default
/// space and read them as points; the two kinds do not meet (METHODS §3: patch residual 0.404 σh² at every
/// resolution).
/// @throws Error (bad_geometry) naming the cell whose rest Jacobian at a quadrature point is ≤ 0; (unsupported) for
/// a cell with faces that are not quadrilaterals, which only level 0 has.
[[nodiscard]] Discretization discretize(const subdiv::Refinement& refinement,
                                        const Eigen::Matrix3Xd& rest_control_points, const NodalFields& fields,
                                        const DiscretizationOptions& options, const Progress& progress = {});

/// Takes new fields (same refinement and rest positions) into material arrays, mass and damping. In cubic space the
/// choice of levels may change with the fields: returns false if discretize() has to be called instead.
[[nodiscard]] bool update_fields(Discretization& discretization, const subdiv::Refinement& refinement,
                                 const NodalFields& fields, const Progress& progress = {});

/// Present volume [m³]: sum over quadrature points of volume · det F.
[[nodiscard]] double volume(const Discretization& discretization, const Eigen::Matrix3Xd& nodes);

}  // namespace argil::fem
