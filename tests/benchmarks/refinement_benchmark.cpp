#include <benchmark/benchmark.h>

#include "subdiv/limit.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/primitives.h"
#include "subdiv/refinement.h"

namespace {

using namespace argil::subdiv;

// One step on n x n x n hexahedra, positions included.
void refine_box(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Built box = box_grid(n, n, n, {1, 1, 1});
  for (auto _ : state) {
    const RefinementStep step = refine(box.solid);
    benchmark::DoNotOptimize(apply(step.stencils, box.positions));
  }
  state.SetItemsProcessed(state.iterations() * 8 * n * n * n);
  state.SetLabel("items are fine cells");
}
BENCHMARK(refine_box)->Arg(8)->Arg(22)->Unit(benchmark::kMillisecond);

void compose_two_levels(benchmark::State& state) {
  const Built box = box_grid(8, 8, 8, {1, 1, 1});
  for (auto _ : state) benchmark::DoNotOptimize(refine_to_level(box.solid, 2));
}
BENCHMARK(compose_two_levels)->Unit(benchmark::kMillisecond);

void limits(benchmark::State& state) {
  const Built box = box_grid(16, 16, 16, {1, 1, 1});
  for (auto _ : state) benchmark::DoNotOptimize(limit_stencils(box.solid));
}
BENCHMARK(limits)->Unit(benchmark::kMillisecond);

void nets(benchmark::State& state) {
  const Built box = box_grid(16, 16, 16, {1, 1, 1});
  for (auto _ : state) benchmark::DoNotOptimize(regular_nets(box.solid, classify_cells(box.solid)));
}
BENCHMARK(nets)->Unit(benchmark::kMillisecond);

}  // namespace
