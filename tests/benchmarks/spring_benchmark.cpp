// What the corrections of papers/001 cost against springs alone, and how near the dense matrices of papers/004 come
// to the speed of memory. Ratios are taken within one run, turn by turn, so that a busy machine slows both sides.

#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>
#include <numeric>

#include "fem/discretization.h"
#include "fem/models/element_stiffness.h"
#include "fem/models/local_frame.h"
#include "fem/models/mass_spring.h"
#include "fem/parallel.h"
#include "subdiv/primitives.h"

namespace {

using namespace argil;

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Forces of n³ cubes with the correction over those without.
void spring_correction(benchmark::State& state, fem::DiagonalSprings diagonals, fem::SpringCorrection correction) {
  const int n = 30;
  const subdiv::Built box = subdiv::box_grid(n, n, n, {1, 1, 1});
  const subdiv::Refinement refinement = subdiv::refine_to_level(box.solid, 0);
  const auto count = static_cast<Eigen::Index>(refinement.solid().vertex_capacity());
  const fem::NodalFields fields{Eigen::VectorXd::Constant(count, 1e5), Eigen::VectorXd::Constant(count, 0.3),
                                Eigen::VectorXd::Constant(count, 1000), Eigen::VectorXd::Zero(count)};
  const fem::Discretization d = fem::discretize(refinement, box.positions, fields, {});
  fem::MassSpringOptions plain{diagonals, fem::SpringCorrection::none}, corrected{diagonals, correction};
  plain.hourglass_springs = false;
  const auto without = fem::make_mass_spring(d.blocks, d.rest_nodes, plain);
  const auto with = fem::make_mass_spring(d.blocks, d.rest_nodes, corrected);
  Eigen::Matrix3Xd x = d.rest_nodes, forces;
  x.row(0) += 0.3 * x.row(2).cwiseProduct(x.row(1));
  double with_time = 0, without_time = 0;
  for (auto _ : state) {
    without_time += seconds([&] { without->forces(x, forces); });
    with_time += seconds([&] { with->forces(x, forces); });
    benchmark::DoNotOptimize(forces.data());
  }
  state.counters["times_uncorrected"] = with_time / without_time;
}

/// Products of distinct 192 x 192 matrices, as many as fill 0.6 GB, against reading the same memory.
void dense_products(benchmark::State& state) {
  constexpr std::size_t k_size = 192, k_count = 2000;
  std::vector<double> matrices(k_size * k_size * k_count, 1e-3), d(k_size * k_count, 0.5), result(k_size * k_count);
  std::vector<double> sums(k_count);
  double product_time = 0, read_time = 0;
  for (auto _ : state) {
    read_time += seconds([&] {
      fem::parallel_for(k_count, 1, [&](std::size_t e) {
        const double* m = matrices.data() + e * k_size * k_size;
        double sum[16] = {};
        for (std::size_t i = 0; i < k_size * k_size; i += 16)
          for (std::size_t k = 0; k < 16; ++k) sum[k] += m[i + k];
        sums[e] = std::accumulate(sum, sum + 16, 0.0);
      });
    });
    product_time += seconds([&] {
      fem::parallel_for(k_count, 1, [&](std::size_t e) {
        fem::multiply_stiffness(matrices.data() + e * k_size * k_size, k_size, d.data() + e * k_size,
                                result.data() + e * k_size);
      });
    });
    benchmark::DoNotOptimize(sums.data());
    benchmark::DoNotOptimize(result.data());
  }
  const double bytes =
      static_cast<double>(matrices.size() * sizeof(double)) * static_cast<double>(state.iterations());
  state.counters["read_GB_per_s"] = 1e-9 * bytes / read_time;
  state.counters["product_GB_per_s"] = 1e-9 * bytes / product_time;
  state.counters["share_of_reading"] = read_time / product_time;
}

BENCHMARK_CAPTURE(spring_correction, m1, fem::DiagonalSprings::faces, fem::SpringCorrection::energy);
BENCHMARK_CAPTURE(spring_correction, m2_with_hourglass_springs, fem::DiagonalSprings::inner,
                  fem::SpringCorrection::energy);
BENCHMARK_CAPTURE(spring_correction, published_with_hourglass_springs, fem::DiagonalSprings::inner,
                  fem::SpringCorrection::printed);
BENCHMARK(dense_products)->Unit(benchmark::kMillisecond);

}  // namespace
