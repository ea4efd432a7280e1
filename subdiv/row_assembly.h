#pragma once
// Sums affine combinations into sorted rows, and assembles many rows in parallel in a fixed order.

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <span>
#include <vector>

#include "subdiv/ids.h"
#include "subdiv/parallel.h"
#include "subdiv/progress.h"
#include "subdiv/stencils.h"

namespace argil::subdiv {

/// One row under construction; a dense array of column_count weights is reused from row to row.
class RowBuilder {
 public:
  explicit RowBuilder(std::size_t column_count) : weights_(column_count, 0.0), used_(column_count, 0) {}

  void add(std::uint32_t column, double weight) {
    if (!used_[column]) {
      used_[column] = 1;
      columns_.push_back(column);
    }
    weights_[column] += weight;
  }
  void add(VertexId v, double weight) { add(v.value, weight); }
  /// weight * mean of the vertices.
  void add_mean(std::span<const VertexId> vertices, double weight) {
    const double each = weight / static_cast<double>(vertices.size());
    for (const VertexId v : vertices) add(v.value, each);
  }
  void add(const StencilRow& row, double weight) {
    for (std::size_t i = 0; i < row.columns.size(); ++i) add(row.columns[i], weight * row.weights[i]);
  }

  /// Appends the row to `out` and begins the next one.
  void finish_row(Stencils& out) {
    std::sort(columns_.begin(), columns_.end());
    for (const std::uint32_t column : columns_) {
      out.columns.push_back(column);
      out.weights.push_back(weights_[column]);
      weights_[column] = 0;
      used_[column] = 0;
    }
    out.offsets.push_back(out.columns.size());
    columns_.clear();
  }

 private:
  std::vector<double> weights_;
  std::vector<std::uint8_t> used_;
  std::vector<std::uint32_t> columns_;
};

/// Stencils whose row i is what fill(i, RowBuilder&) adds; fill runs in several threads at once.
template <class Fill>
[[nodiscard]] Stencils assemble_rows(std::size_t row_count, std::size_t column_count, const Fill& fill,
                                     const Progress& progress = {}) {
  constexpr std::size_t k_chunk = 1024, k_slices = 32;
  const std::size_t chunk_count = (row_count + k_chunk - 1) / k_chunk;
  std::vector<Stencils> chunks(chunk_count);
  tbb::enumerable_thread_specific<RowBuilder> builders([&] { return RowBuilder(column_count); });
  const auto assemble_chunk = [&](std::size_t c) {
    RowBuilder& builder = builders.local();
    const std::size_t end = std::min(row_count, (c + 1) * k_chunk);
    chunks[c].offsets.reserve(k_chunk + 1);
    for (std::size_t i = c * k_chunk; i < end; ++i) {
      fill(i, builder);
      builder.finish_row(chunks[c]);
    }
  };
  // In slices where somebody listens, between which it is told.
  const std::size_t slice =
      progress.is_heard() ? std::max<std::size_t>(8, (chunk_count + k_slices - 1) / k_slices) : chunk_count;
  for (std::size_t begin = 0; begin < chunk_count; begin += slice) {
    const std::size_t end = std::min(chunk_count, begin + slice);
    parallel_for(end - begin, 1, [&](std::size_t c) { assemble_chunk(begin + c); });
    progress.at(static_cast<double>(end) / static_cast<double>(chunk_count));
  }

  Stencils result;
  result.column_count = column_count;
  result.offsets.resize(row_count + 1);
  std::vector<std::size_t> first_entry(chunk_count + 1, 0);
  for (std::size_t c = 0; c < chunk_count; ++c) first_entry[c + 1] = first_entry[c] + chunks[c].columns.size();
  result.columns.resize(first_entry[chunk_count]);
  result.weights.resize(first_entry[chunk_count]);
  parallel_for(chunk_count, 1, [&](std::size_t c) {
    const auto to = static_cast<std::ptrdiff_t>(first_entry[c]);
    std::copy(chunks[c].columns.begin(), chunks[c].columns.end(), result.columns.begin() + to);
    std::copy(chunks[c].weights.begin(), chunks[c].weights.end(), result.weights.begin() + to);
    for (std::size_t i = 1; i < chunks[c].offsets.size(); ++i)
      result.offsets[c * k_chunk + i] = first_entry[c] + chunks[c].offsets[i];
    chunks[c] = {};
  });
  return result;
}

}  // namespace argil::subdiv
