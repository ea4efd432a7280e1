#include "tools/chart/frequencies.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "fem/solvers/rest_operator.h"
#include "subdiv/error.h"

namespace argil::chart {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

struct Pencil {
  Sparse stiffness, mass;  // lower triangles, free control points times three
};

Pencil pencil(const fem::System& system) {
  const fem::RestOperator rest = fem::rest_operator(system, true);
  std::vector<int> number(system.fixed.size(), -1);
  int free = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (!system.fixed[i] && rest.touched[i]) number[i] = free++;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index c = 0; c < rest.stiffness.outerSize(); ++c)
    for (Sparse::InnerIterator it(rest.stiffness, c); it; ++it) {
      const int row = number[static_cast<std::size_t>(it.row() / 3)],
                column = number[static_cast<std::size_t>(c / 3)];
      if (row < 0 || column < 0) continue;
      const auto r = 3 * row + it.row() % 3, k = 3 * column + c % 3;
      if (r >= k) entries.emplace_back(r, k, it.value());
    }
  Pencil result;
  result.stiffness.resize(3 * free, 3 * free);
  result.stiffness.setFromTriplets(entries.begin(), entries.end());
  entries.clear();
  for (Eigen::Index c = 0; c < system.mass->outerSize(); ++c)
    for (Sparse::InnerIterator it(*system.mass, c); it; ++it) {
      const int row = number[static_cast<std::size_t>(it.row())], column = number[static_cast<std::size_t>(c)];
      if (row < column || column < 0) continue;
      for (int axis = 0; axis < 3; ++axis) entries.emplace_back(3 * row + axis, 3 * column + axis, it.value());
    }
  result.mass.resize(3 * free, 3 * free);
  result.mass.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

std::vector<double> lowest_frequencies(const fem::System& system, int count, double shift) {
  const Pencil of = pencil(system);
  const Eigen::Index n = of.mass.rows();
  if (n < count)
    throw Error(ErrorCode::bad_input,
                "The body has fewer free unknowns than frequencies are asked for; refine it.");
  Sparse shifted = of.stiffness;
  shifted += shift * of.mass;
  const Eigen::SimplicialLDLT<Sparse, Eigen::Lower> factor(shifted);
  if (factor.info() != Eigen::Success || factor.vectorD().minCoeff() <= 0)
    throw Error(
        ErrorCode::not_converged,
        "The stiffness at rest is not positive: hold the body, or take a model whose rest state is stable.");
  const auto mass = of.mass.selfadjointView<Eigen::Lower>();
  const auto stiffness = of.stiffness.selfadjointView<Eigen::Lower>();

  const Eigen::Index size = std::min<Eigen::Index>(n, 2 * count + 8);
  Eigen::MatrixXd space(n, size);
  std::uint64_t seed = 1;
  for (Eigen::Index i = 0; i < space.size(); ++i) {  // a fixed sequence (Knuth's multiplier): same bits every time
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    space.data()[i] = static_cast<double>(seed >> 11) / 9007199254740992.0 - 0.5;
  }
  Eigen::VectorXd before = Eigen::VectorXd::Zero(count);
  for (int iteration = 0; iteration < 300; ++iteration) {
    const Eigen::MatrixXd moved = mass * space;
    space = factor.solve(moved);
    const Eigen::MatrixXd small_stiffness = space.transpose() * (stiffness * space).eval();
    const Eigen::MatrixXd small_mass = space.transpose() * (mass * space).eval();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> small(small_stiffness, small_mass);
    if (small.info() != Eigen::Success) break;
    space = (space * small.eigenvectors()).eval();
    const Eigen::VectorXd values = small.eigenvalues().head(count);
    const double largest = std::max(values.cwiseAbs().maxCoeff(), 1e-300);
    if ((values - before).cwiseAbs().maxCoeff() < 1e-10 * largest) {
      std::vector<double> result;
      for (Eigen::Index i = 0; i < count; ++i)
        result.push_back(std::sqrt(std::max(values[i], 0.0)) / (2 * std::numbers::pi));
      return result;
    }
    before = values;
  }
  throw Error(ErrorCode::not_converged, "The lowest frequencies did not settle within 300 iterations.");
}

}  // namespace argil::chart
