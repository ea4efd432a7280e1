// Which preconditioner a step should get (fem/solvers/solver_choice.h): one implicit Euler step of the cantilever
// of REFERENCES §1 at 1/60 s by number of elements, contrast and stiffness number, once with each preconditioner.
// Prints iterations, ms of a step and ms to make the preconditioner.

#include <fmt/format.h>

#include <chrono>

#include "benchmark/benchmark.h"
#include "fem/loads.h"
#include "fem/solvers/pcg.h"
#include "fem/solvers/solver_choice.h"
#include "fem/solvers/stencil_product.h"
#include "tests/fem/simulated_solid.h"

namespace {

using namespace argil;
using namespace argil::fem;

/// Arguments: cells across the bar, contrast, decimal logarithm of E.
void cantilever(benchmark::State& state, PreconditionerKind kind) {
  const int n = static_cast<int>(state.range(0));
  const double contrast = static_cast<double>(state.range(1)), young = std::pow(10, state.range(2));
  test::SimulatedSolid solid(test::box(4 * n, n, n, {0.4, 0.1, 0.1}, false), 0, {young, 0.3, 1000, 0});
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (solid.rest(0, i) < 0.2) solid.fields.young_modulus[i] *= contrast;
  static_cast<void>(update_fields(solid.discretization, solid.refinement, solid.fields));
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  std::vector<std::uint8_t> free;
  for (const std::uint8_t fixed : solid.system.fixed) free.push_back(fixed ? 0 : 1);
  const double c = 1.0 / 60;
  const Eigen::SparseMatrix<double> inertia = solid.discretization.mass / (c * c);
  const auto now = [] {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  const double begin = now();
  const RestOperator rest = rest_operator(solid.system, kind != PreconditionerKind::jacobi);
  const double assembled = now();
  const auto preconditioner = make_preconditioner(kind, rest, inertia, {}, free);
  const double made = now();
  const auto tangent = solid.model->tangent(solid.discretization.rest_nodes, Projection::positive_semidefinite);
  Eigen::Matrix3Xd x, y, right = gravity_forces(solid.discretization, {0, 0, -9.81}), solution;
  for (Eigen::Index i = 0; i < right.cols(); ++i)
    if (!free[static_cast<std::size_t>(i)]) right.col(i).setZero();
  const LinearOperator matrix = [&](const Eigen::Matrix3Xd& d, Eigen::Matrix3Xd& result) {
    multiply(rest.rows, d, x);
    tangent->stiffness_product(x, y);
    multiply(rest.rows_transposed, y, result);
    result += d * inertia;
    for (std::size_t i = 0; i < free.size(); ++i)
      if (!free[i]) result.col(static_cast<Eigen::Index>(i)).setZero();
  };
  LinearOutcome outcome;
  for (auto _ : state) outcome = pcg(matrix, *preconditioner, right, solution, 1e-4, 20000);
  state.counters["elements"] = 4 * n * n * n;
  state.counters["iterations"] = outcome.iterations;
  state.counters["number"] = stiffness_number(solid.system, rest, c * c, free);
  state.counters["assembly_ms"] = assembled - begin;
  state.counters["factor_ms"] = made - assembled;
  state.SetLabel(std::string(word(preconditioner->kind())));
}

void sizes(benchmark::internal::Benchmark* of) {
  for (const int n : {7, 13, 20})
    for (const int contrast : {1, 100, 1000})
      for (const int young : {4, 6, 8}) of->Args({n, contrast, young});
  of->Unit(benchmark::kMillisecond)->Iterations(1);
}

BENCHMARK_CAPTURE(cantilever, jacobi, PreconditionerKind::jacobi)->Apply(sizes);
BENCHMARK_CAPTURE(cantilever, supernodal, PreconditionerKind::supernodal)->Apply(sizes);

}  // namespace
