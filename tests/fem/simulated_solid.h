#pragma once
// A solid taken all the way to a system that integrators can step, for the tests of discretization and dynamics.

#include <array>
#include <memory>

#include "fem/discretization.h"
#include "fem/dynamics/integrator.h"
#include "subdiv/primitives.h"
#include "subdiv/refinement.h"
#include "subdiv/transaction.h"

namespace argil::fem::test {

struct Material {
  double young_modulus = 1000, poisson_ratio = 0.3, density = 1.25, damping = 0;
};

inline NodalFields constant_fields(const subdiv::Refinement& refinement, const Material& material) {
  const auto n = static_cast<Eigen::Index>(refinement.solid().vertex_capacity());
  return {Eigen::VectorXd::Constant(n, material.young_modulus),
          Eigen::VectorXd::Constant(n, material.poisson_ratio), Eigen::VectorXd::Constant(n, material.density),
          Eigen::VectorXd::Constant(n, material.damping)};
}

class SimulatedSolid {
 public:
  SimulatedSolid(const subdiv::Built& built, int level, const Material& material = {},
                 const DiscretizationOptions& options = {}, bool linear = false,
                 subdiv::RuleSet rules = subdiv::RuleSet::maccracken_joy)
      : rest(built.positions), refinement(subdiv::refine_to_level(built.solid, level, rules)) {
    fields = constant_fields(refinement, material);
    discretization = discretize(refinement, rest, fields, options);
    model = linear ? make_linear(discretization.blocks, discretization.rest_nodes)
                   : make_corotational(discretization.blocks, discretization.rest_nodes);
    system.rows = &discretization.nodes.rows;
    system.rows_transposed = &discretization.rows_transposed;
    system.model = model.get();
    system.rest_nodes = &discretization.rest_nodes;
    system.mass = &discretization.mass;
    system.damping = &discretization.damping;
    system.blocks = discretization.blocks;
    system.fixed.assign(system.rows->column_count, 0);
    state.positions = rest;
    state.velocities.setZero(3, rest.cols());
  }
  SimulatedSolid(const SimulatedSolid&) = delete;
  SimulatedSolid& operator=(const SimulatedSolid&) = delete;

  template <class Where>
  void fix(const Where& where) {
    for (Eigen::Index i = 0; i < rest.cols(); ++i)
      if (where(Eigen::Vector3d(rest.col(i)))) system.fixed[static_cast<std::size_t>(i)] = 1;
  }

  Eigen::Matrix3Xd rest;  // control points
  subdiv::Refinement refinement;
  NodalFields fields;
  Discretization discretization;
  std::unique_ptr<ForceModel> model;
  System system;
  BodyState state;
};

/// A box of nx × ny × nz cells; if `sharp`, its edges and corners are, so that it keeps its shape.
inline subdiv::Built box(int nx, int ny, int nz, const Eigen::Vector3d& size, bool sharp = true) {
  subdiv::Built built = subdiv::box_grid(nx, ny, nz, size);
  if (!sharp) return built;
  const auto sides = [&](subdiv::VertexId v) {  // which of the three directions has v on a side of the box
    const Eigen::Vector3d x = built.positions.col(static_cast<Eigen::Index>(v.index()));
    return std::array<int, 3>{x[0] < 1e-9 * size[0] ? -1 : (x[0] > (1 - 1e-9) * size[0] ? 1 : 0),
                              x[1] < 1e-9 * size[1] ? -1 : (x[1] > (1 - 1e-9) * size[1] ? 1 : 0),
                              x[2] < 1e-9 * size[2] ? -1 : (x[2] > (1 - 1e-9) * size[2] ? 1 : 0)};
  };
  subdiv::Transaction edit(built.solid);
  for (const subdiv::VertexId v : built.solid.vertices()) {
    const auto s = sides(v);
    if (s[0] && s[1] && s[2]) edit.set_sharpness(v, subdiv::k_infinitely_sharp);
  }
  for (const subdiv::EdgeId e : built.solid.edges()) {
    const auto a = sides(built.solid.edge_vertices(e)[0]), b = sides(built.solid.edge_vertices(e)[1]);
    int shared = 0;
    for (std::size_t d = 0; d < 3; ++d) shared += a[d] != 0 && a[d] == b[d] ? 1 : 0;
    if (shared >= 2) edit.set_sharpness(e, subdiv::k_infinitely_sharp);
  }
  static_cast<void>(edit.commit());
  return built;
}

}  // namespace argil::fem::test
