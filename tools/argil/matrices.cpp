#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "fem/element_block.h"
#include "fem/solvers/block_accumulator.h"
#include "fem/solvers/rest_operator.h"
#include "fem/spectrum/pencil.h"
#include "io/file_bytes.h"
#include "io/matrix_market.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"

namespace argil::tools {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Bytes of a line of text, and of the same entry in memory while it is summed and held.
constexpr double k_entry_bytes = 90;

Matrix stencil_matrix(const subdiv::Stencils& stencils) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(stencils.columns.size());
  for (std::size_t row = 0; row < stencils.row_count(); ++row)
    for (std::size_t e = stencils.offsets[row]; e < stencils.offsets[row + 1]; ++e)
      entries.emplace_back(static_cast<int>(row), static_cast<int>(stencils.columns[e]), stencils.weights[e]);
  Matrix result(static_cast<Eigen::Index>(stencils.row_count()), static_cast<Eigen::Index>(stencils.column_count));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// K at the nodes: row 3 i + axis is that axis of node i.
Matrix node_stiffness(const fem::System& system, const Eigen::Matrix3Xd& nodes) {
  fem::BlockAccumulator blocks(3);
  system.model->tangent(nodes, fem::Projection::none)
      ->element_tangents([&](std::span<const std::uint32_t> named, const Eigen::MatrixXd& stiffness) {
        for (std::size_t b = 0; b < named.size(); ++b)
          for (std::size_t a = 0; a < named.size(); ++a) {
            double* sum = blocks.block(named[a], named[b]);
            for (int k = 0; k < 9; ++k)
              sum[k] +=
                  stiffness(3 * static_cast<Eigen::Index>(a) + k % 3, 3 * static_cast<Eigen::Index>(b) + k / 3);
          }
      });
  return blocks.matrix(static_cast<std::size_t>(nodes.cols()));
}

/// Consistent mass at the nodes [kg], or with the damping coefficient [kg/s].
Matrix node_mass(const fem::Discretization& discretization, bool damping) {
  fem::BlockAccumulator blocks(1);
  for (const fem::ElementBlock& block : discretization.blocks) {
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    for (std::size_t e = 0; e < block.element_count(); ++e)
      for (int q = 0; q < block.kind->point_count; ++q) {
        const std::size_t point = block.point_index(e, q);
        const double weight = block.volumes[point] * block.density[point] * (damping ? block.damping[point] : 1);
        const double* shapes = block.kind->shapes.data() + static_cast<std::size_t>(q) * n;
        for (std::size_t b = 0; b < n; ++b)
          for (std::size_t a = 0; a < n; ++a)
            *blocks.block(block.nodes[e * n + a], block.nodes[e * n + b]) += weight * shapes[a] * shapes[b];
      }
  }
  return blocks.matrix(discretization.nodes.node_count());
}

double node_bytes(const fem::Discretization& discretization) {
  double couplings = 0;
  for (const fem::ElementBlock& block : discretization.blocks)
    couplings += static_cast<double>(block.element_count()) * block.kind->node_count * block.kind->node_count;
  return couplings * 9 * k_entry_bytes;
}

bool is_symmetric(const Matrix& matrix) {
  double largest = 0;
  for (Eigen::Index c = 0; c < matrix.outerSize(); ++c)
    for (Matrix::InnerIterator it(matrix, c); it; ++it) largest = std::max(largest, std::abs(it.value()));
  const Matrix difference = matrix - Matrix(matrix.transpose());
  for (Eigen::Index c = 0; c < difference.outerSize(); ++c)
    for (Matrix::InnerIterator it(difference, c); it; ++it)
      if (std::abs(it.value()) > 1e-12 * largest) return false;  // sums in another order differ by less
  return true;
}

}  // namespace

int export_matrices(const MatricesArguments& arguments) {
  const auto session = run_body(arguments.body);
  const sculpt::Document& document = session->document();
  const bool at_rest = arguments.at == "rest";
  const fem::Discretization& discretization = document.discretization();
  fem::System system = document.system();
  const double bytes = std::max(node_bytes(discretization), fem::pencil_bytes(system));
  if (bytes > static_cast<double>(arguments.body.limits.memory))
    throw Error(
        ErrorCode::limit_exceeded,
        fmt::format("the matrices may take {:.2g} GB, more than {:.2g}; lower --levels or raise --max-memory",
                    bytes * 1e-9, static_cast<double>(arguments.body.limits.memory) * 1e-9));
  const Eigen::Matrix3Xd nodes = fem::nodes(system, at_rest ? document.rest() : document.positions());
  system.rest_nodes = &nodes;
  std::error_code failure;
  std::filesystem::create_directories(arguments.out, failure);
  if (failure)
    throw Error(ErrorCode::bad_input, fmt::format("the folder '{}' cannot be made ({}); choose another with --out",
                                                  arguments.out.string(), failure.message()));

  const std::string state = at_rest ? "at rest" : "at the present state";
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const auto write = [&](const std::string& name, const Matrix& matrix, bool symmetric,
                         const std::string& meaning) {
    io::write_file(arguments.out / name,
                   io::matrix_market_bytes(
                       matrix, symmetric ? io::MatrixSymmetry::symmetric : io::MatrixSymmetry::general, meaning));
    list.push_back({{"file", name},
                    {"rows", matrix.rows()},
                    {"columns", matrix.cols()},
                    {"symmetric", symmetric},
                    {"meaning", meaning}});
    if (!arguments.json) fmt::print("{:<28} {} x {}  {}\n", name, matrix.rows(), matrix.cols(), meaning);
  };
  const char* order = "row 3 i + axis (from 0) is that axis of ";
  write("A.mtx", stencil_matrix(discretization.nodes.rows), false, "nodes = A * control points, for each axis");
  write("mass_nodes.mtx", node_mass(discretization, false), true,
        "consistent mass of the nodes [kg], for each axis");
  write("mass.mtx", discretization.mass, true,
        "mass of the control points [kg], for each axis: A' * mass_nodes * A");
  {
    const Matrix stiffness = node_stiffness(system, nodes);
    write("stiffness_nodes.mtx", stiffness, is_symmetric(stiffness),
          fmt::format("tangent stiffness of the nodes [N/m], model {}, {}; {}node i", system.model->name(), state,
                      order));
  }
  write("stiffness.mtx", fem::rest_operator(system, true).stiffness, true,
        fmt::format("tangent stiffness of the control points [N/m], model {}, {}; {}control point i",
                    system.model->name(), state, order));
  write("damping.mtx", discretization.damping, true,
        "damping of the control points by density [kg/s], for each axis");

  // What the matrices act on, so that a reader can check them: one row a point.
  const auto points = [](const Eigen::Matrix3Xd& values) { return Matrix(values.transpose().sparseView(0, 0)); };
  const Eigen::Matrix3Xd& control_points = at_rest ? document.rest() : document.positions();
  write("control_points.mtx", points(control_points), false, fmt::format("control points [m], {}", state));
  write("nodes.mtx", points(nodes), false, fmt::format("nodes [m], {}", state));
  Matrix fixed(static_cast<Eigen::Index>(system.fixed.size()), 1);
  for (std::size_t i = 0; i < system.fixed.size(); ++i)
    if (system.fixed[i]) fixed.insert(static_cast<Eigen::Index>(i), 0) = 1;
  write("fixed.mtx", fixed, false, "1 for a control point that is pinned; no matrix leaves it out");
  if (arguments.json) fmt::print("{}\n", nlohmann::ordered_json{{"matrices", list}}.dump(2));
  return k_well;
}

}  // namespace argil::tools
