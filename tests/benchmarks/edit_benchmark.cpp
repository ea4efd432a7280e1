#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

#include "sculpt/session.h"
#include "subdiv/edit/extrude.h"
#include "subdiv/primitives.h"
#include "subdiv/transaction.h"

namespace {

using namespace argil;

// A bar of n cells, 10 x 10 in section.
std::array<int, 3> bar(std::int64_t cells) {
  return {static_cast<int>(cells) / 100, 10, 10};
}

// One cell grown and taken back, topology alone.
void edit_topology_of_one_cell(benchmark::State& state) {
  const auto n = bar(state.range(0));
  subdiv::Solid solid = subdiv::box_grid(n[0], n[1], n[2], {1, 1, 1}).solid;
  (void)solid.topology_hash();
  subdiv::FaceId face;
  for (const subdiv::FaceId f : solid.faces())
    if (solid.is_boundary(f)) face = f;
  for (auto _ : state) {
    subdiv::Transaction transaction(solid);
    (void)subdiv::extrude(transaction, std::array{face}, 1);
    const subdiv::Delta delta = transaction.commit();
    benchmark::DoNotOptimize(solid.topology_hash());
    subdiv::undo(solid, delta);
  }
}
BENCHMARK(edit_topology_of_one_cell)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

// The same as the two commands of a session, `extrude` and `undo`, with positions, fields, selection, a named set
// and the journal's record in memory.
void edit_command_of_one_cell(benchmark::State& state) {
  const auto n = bar(state.range(0));
  sculpt::SessionOptions options;
  options.out = std::filesystem::temp_directory_path() / ("argil_benchmark_" + std::to_string(getpid()));
  options.write_journal = false;
  sculpt::Session session(options);
  session.run_line("new box " + std::to_string(n[0]) + " 10 10 size " + std::to_string(n[0]) + " 10 10");
  session.run_line("select faces as end where x < 0.1 and y < 1 and z < 1");
  for (auto _ : state) {
    session.run_line("extrude 0.5");
    session.run_line("undo");
  }
  std::filesystem::remove_all(options.out);
}
BENCHMARK(edit_command_of_one_cell)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
