#include <benchmark/benchmark.h>

#include <memory>

#include "fem/discretization.h"
#include "fem/models/force_model.h"
#include "subdiv/primitives.h"

namespace {

using namespace argil;

// A sharp-free box at one level: 8 n³ trilinear hexahedra, or tricubic elements where it is regular; slightly
// sheared so that rotations have to be found.
struct Body {
  fem::Discretization discretization;
  std::unique_ptr<fem::ForceModel> model;
  Eigen::Matrix3Xd nodes;

  Body(int n, fem::Space space) {
    const subdiv::Built box = subdiv::box_grid(n, n, n, {1, 1, 1});
    const subdiv::Refinement refinement = subdiv::refine_to_level(box.solid, 1);
    const auto count = static_cast<Eigen::Index>(refinement.solid().vertex_capacity());
    const fem::NodalFields fields{Eigen::VectorXd::Constant(count, 1e5), Eigen::VectorXd::Constant(count, 0.3),
                                  Eigen::VectorXd::Constant(count, 1000), Eigen::VectorXd::Zero(count)};
    discretization = fem::discretize(refinement, box.positions, fields, {.space = space, .split = 0});
    model = fem::make_corotational(discretization.blocks, discretization.rest_nodes);
    nodes = discretization.rest_nodes;
    nodes.row(0) += 0.3 * nodes.row(2).cwiseProduct(nodes.row(1));
  }
};

fem::Space space_of(const benchmark::State& state) {
  return state.range(1) == 0 ? fem::Space::standard : fem::Space::cubic;
}

void label(benchmark::State& state, const Body& body) {
  const auto& e = body.discretization.elements;
  state.SetLabel(std::to_string(e.cubic) + " cubic, " + std::to_string(e.linear) + " linear");
}

void forces(benchmark::State& state) {
  const Body body(static_cast<int>(state.range(0)), space_of(state));
  Eigen::Matrix3Xd result;
  for (auto _ : state) {
    body.model->forces(body.nodes, result);
    benchmark::DoNotOptimize(result.data());
  }
  label(state, body);
}

void tangent(benchmark::State& state) {
  const Body body(static_cast<int>(state.range(0)), space_of(state));
  for (auto _ : state)
    benchmark::DoNotOptimize(body.model->tangent(body.nodes, fem::Projection::positive_semidefinite));
  label(state, body);
}

void stiffness_product(benchmark::State& state) {
  const Body body(static_cast<int>(state.range(0)), space_of(state));
  const auto at = body.model->tangent(body.nodes, fem::Projection::positive_semidefinite);
  Eigen::Matrix3Xd result;
  for (auto _ : state) {
    at->stiffness_product(body.nodes, result);
    benchmark::DoNotOptimize(result.data());
  }
  label(state, body);
}

BENCHMARK(forces)->Args({8, 0})->Args({8, 1})->Unit(benchmark::kMillisecond);
BENCHMARK(tangent)->Args({8, 0})->Args({8, 1})->Unit(benchmark::kMillisecond);
BENCHMARK(stiffness_product)->Args({8, 0})->Args({8, 1})->Unit(benchmark::kMillisecond);

}  // namespace
