// Two comparisons within one run, as ratios. First, products with the stiffness of 30,000 hexahedra, matrix-free
// against assembled, on one thread. Second, a simulated second of the 3³ block at level 2 (1728 cells): the default
// method against papers/004's scheme, which multiplies the 192×192 matrix of every cubic element at every explicit
// step.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <Eigen/SparseCore>
#include <chrono>
#include <cmath>

#include "fem/loads.h"
#include "fem/models/model_table.h"
#include "fem/spectrum/largest_frequency.h"
#include "tests/fem/simulated_solid.h"

namespace {

using namespace argil;
using namespace argil::fem;
using fem::test::SimulatedSolid;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Work>
double time_of(const Work& work) {
  const double start = seconds();
  work();
  return seconds() - start;
}

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

RowMajor assembled(const Tangent& tangent, Eigen::Index nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  tangent.element_tangents([&](std::span<const std::uint32_t> element, const Eigen::MatrixXd& stiffness) {
    for (std::size_t a = 0; a < element.size(); ++a)
      for (std::size_t b = 0; b < element.size(); ++b)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            entries.emplace_back(
                static_cast<int>(3 * element[a]) + i, static_cast<int>(3 * element[b]) + j,
                stiffness(static_cast<Eigen::Index>(3 * a) + i, static_cast<Eigen::Index>(3 * b) + j));
  });
  RowMajor matrix(3 * nodes, 3 * nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

enum Body { congruent, painted, distorted };

/// 30 × 25 × 40 cells; painted: a stiffness of its own in every cell; distorted: each node moved by up to a fifth.
void product(benchmark::State& state, Body body, Formulation formulation, const char* model_name) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  subdiv::Built box = subdiv::box_grid(30, 25, 40, {3, 2.5, 4});
  if (body == distorted) {
    std::uint32_t random = 1;
    for (Eigen::Index i = 0; i < box.positions.size(); ++i) {
      random = 1664525u * random + 1013904223u;
      box.positions.data()[i] += 0.02 * (static_cast<double>(random >> 8) / 8388608.0 - 1);
    }
  }
  SimulatedSolid solid(box, 0, {.young_modulus = 1e5});
  if (body == painted) {
    for (Eigen::Index v = 0; v < solid.fields.young_modulus.size(); ++v)
      solid.fields.young_modulus[v] *= 1 + 0.5 * std::sin(static_cast<double>(v));
    static_cast<void>(update_fields(solid.discretization, solid.refinement, solid.fields));
  }
  const auto model =
      make_model({model_name, formulation}, solid.discretization.blocks, solid.discretization.rest_nodes);
  const Eigen::Matrix3Xd& x = solid.discretization.rest_nodes;
  const auto tangent = model->tangent(x, Projection::none);
  const RowMajor matrix = assembled(*tangent, x.cols());
  Eigen::Matrix3Xd free_result;
  Eigen::VectorXd result(3 * x.cols());
  const Eigen::Map<const Eigen::VectorXd> values(x.data(), 3 * x.cols());
  double by_elements = 0, by_matrix = 0;
  for (auto _ : state) {
    by_elements += time_of([&] { tangent->stiffness_product(x, free_result); });
    by_matrix += time_of([&] { result.noalias() = matrix * values; });
  }
  state.counters["assembled_over_matrix_free"] = by_matrix / by_elements;
  state.counters["matrix_free_ms"] = 1e3 * by_elements / static_cast<double>(state.iterations());
  state.counters["assembled_ms"] = 1e3 * by_matrix / static_cast<double>(state.iterations());
}
BENCHMARK_CAPTURE(product, congruent_linear, congruent, Formulation::plain, "linear")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(product, congruent_warped, congruent, Formulation::plain, "warped_stiffness")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(product, painted_linear, painted, Formulation::plain, "linear")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(product, distorted_linear, distorted, Formulation::plain, "linear")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(product, distorted_corotational, distorted, Formulation::plain, "corotational")
    ->Unit(benchmark::kMillisecond);

/// The block of Table 1, held below, pulled above.
class Block {
 public:
  Block(int cells, int level, Space space, const char* model_name)
      : solid_(subdiv::box_grid(cells, cells, cells, {1, 1, 1}), level, k_material, {.space = space}) {
    model_ = make_model({model_name, Formulation::plain}, solid_.discretization.blocks,
                        solid_.discretization.rest_nodes);
    solid_.system.model = model_.get();
    solid_.fix([](const Eigen::Vector3d& x) { return x[2] < 1e-9; });
    loads_.forces = gravity_forces(solid_.discretization, {5, 0, 0});
  }
  static constexpr fem::test::Material k_material{.young_modulus = 1e5, .density = 1000};

  const SimulatedSolid& solid() const { return solid_; }
  double largest() const { return largest_frequency(solid_.system, {}, solid_.rest).value; }
  void damp(double rate) {
    solid_.fields.damping.setConstant(rate);
    static_cast<void>(update_fields(solid_.discretization, solid_.refinement, solid_.fields));
  }
  /// Seconds of computation for one simulated second; the body ends where it then is.
  double simulate(double time_step, Method method) {
    Integrator integrator(solid_.system);
    const auto steps = static_cast<long>(std::ceil(1 / time_step));
    StepOptions options;
    options.method = method;
    solid_.state.positions = solid_.rest;
    return time_of([&] {
      for (long i = 0; i < steps; ++i)
        integrator.step(loads_, solid_.state, 1.0 / static_cast<double>(steps), options);
    });
  }
  void settle() {
    Integrator integrator(solid_.system);
    integrator.solve_static(loads_, solid_.state, {});
  }
  /// How far the middle of the upper side has gone [m].
  double sway() const {
    Eigen::Index best = 0;
    double nearest = 1e300;
    for (Eigen::Index i = 0; i < solid_.rest.cols(); ++i) {
      const double distance = (solid_.rest.col(i) - Eigen::Vector3d(0.5, 0.5, 1)).norm();
      if (distance < nearest) {
        nearest = distance;
        best = i;
      }
    }
    return solid_.state.positions(0, best) - solid_.rest(0, best);
  }

 private:
  SimulatedSolid solid_;
  std::unique_ptr<ForceModel> model_;
  Loads loads_;
};

void simulated_second(benchmark::State& state) {
  Block rest(3, 2, Space::cubic, "corotational");
  rest.settle();
  Block published(3, 2, Space::published, "published"), standard(3, 2, Space::standard, "corotational");
  const double highest = published.largest();
  published.damp(0.1 * highest);  // METHODS §4
  standard.damp(10);              // about critical for the sway
  const double limit = 2 / highest;
  double published_time = 0, standard_time = 0;
  for (auto _ : state) {
    published_time += published.simulate(0.4 * limit, Method::central_difference);
    standard_time += standard.simulate(1.0 / 60, Method::bdf2);
  }
  const double reference = rest.sway();
  state.counters["published_over_default"] = published_time / standard_time;
  state.counters["published_s"] = published_time;
  state.counters["default_s"] = standard_time;
  state.counters["published_steps"] = std::ceil(1 / (0.4 * limit));
  // The published motion creeps, as its damping is far above critical: its error is that of a body still under way.
  published.settle();
  standard.settle();
  state.counters["published_static_error"] = std::abs(published.sway() / reference - 1);
  state.counters["default_static_error"] = std::abs(standard.sway() / reference - 1);
}
BENCHMARK(simulated_second)->Iterations(1)->Unit(benchmark::kSecond);

/// Bytes of distinct 192×192 matrices read in a second by the published forces, against a plain sum over as much
/// memory.
void published_bandwidth(benchmark::State& state) {
  subdiv::Built box = subdiv::box_grid(12, 12, 12, {1, 1, 1});
  std::uint32_t random = 1;
  for (Eigen::Index i = 0; i < box.positions.size(); ++i) {
    random = 1664525u * random + 1013904223u;
    box.positions.data()[i] += 0.004 * (static_cast<double>(random >> 8) / 8388608.0 - 1);
  }
  SimulatedSolid solid(box, 0, {.young_modulus = 1e5}, {.space = Space::published});
  const auto model =
      make_model({"published", Formulation::plain}, solid.discretization.blocks, solid.discretization.rest_nodes);
  const auto tangent = model->tangent(solid.discretization.rest_nodes, Projection::none);
  const std::size_t bytes = solid.discretization.elements.cubic * 192 * 192 * sizeof(double);
  const std::vector<double> plain(bytes / sizeof(double), 1.0);
  Eigen::Matrix3Xd result;
  double product_time = 0, read_time = 0, sum = 0;
  for (auto _ : state) {
    product_time += time_of([&] { tangent->stiffness_product(solid.discretization.rest_nodes, result); });
    read_time += time_of([&] {
      sum += Eigen::Map<const Eigen::VectorXd>(plain.data(), static_cast<Eigen::Index>(plain.size())).sum();
    });
  }
  benchmark::DoNotOptimize(sum);
  state.counters["of_one_thread_read"] = read_time / product_time;
  state.counters["GB_per_s"] =
      1e-9 * static_cast<double>(bytes) * static_cast<double>(state.iterations()) / product_time;
}
BENCHMARK(published_bandwidth)->Unit(benchmark::kMillisecond);

}  // namespace
