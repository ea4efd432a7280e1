#include "io/matrix_market.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "subdiv/error.h"

namespace argil::io {

std::string matrix_market_bytes(const Eigen::SparseMatrix<double>& matrix, MatrixSymmetry symmetry,
                                std::string_view comment) {
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  const bool symmetric = symmetry == MatrixSymmetry::symmetric;
  if (symmetric && matrix.rows() != matrix.cols())
    throw Error(ErrorCode::bad_input, fmt::format("a symmetric matrix is square, and this one has {} rows and {} "
                                                  "columns; write it as a general one",
                                                  matrix.rows(), matrix.cols()));
  const auto written = [&](const Entry& entry) {
    return entry.value() != 0 && !(symmetric && entry.row() < entry.col());
  };
  std::size_t count = 0;
  for (Eigen::Index c = 0; c < matrix.outerSize(); ++c)
    for (Entry entry(matrix, c); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        throw Error(
            ErrorCode::bad_input,
            fmt::format("the entry in row {} and column {} is not finite; look for values that are not in the "
                        "fields",
                        entry.row() + 1, entry.col() + 1));
      count += written(entry) ? 1 : 0;
    }
  fmt::memory_buffer bytes;
  const auto out = std::back_inserter(bytes);
  fmt::format_to(out, "%%MatrixMarket matrix coordinate real {}\n", symmetric ? "symmetric" : "general");
  for (std::size_t begin = 0; begin < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', begin), comment.size());
    fmt::format_to(out, "% {}\n", comment.substr(begin, end - begin));
    begin = end + 1;
  }
  fmt::format_to(out, "{} {} {}\n", matrix.rows(), matrix.cols(), count);
  for (Eigen::Index c = 0; c < matrix.outerSize(); ++c)
    for (Entry entry(matrix, c); entry; ++entry)
      if (written(entry)) fmt::format_to(out, "{} {} {}\n", entry.row() + 1, c + 1, entry.value());
  return fmt::to_string(bytes);
}

}  // namespace argil::io
