#pragma once
// Matrix Market coordinate files (.mtx): sparse real matrices as text that numerical tools read. Entries are
// written column by column with the shortest decimals that read back as the same bits, entries equal to zero left
// out.

#include <Eigen/SparseCore>
#include <string>
#include <string_view>

namespace argil::io {

enum class MatrixSymmetry { general, symmetric };

/// `symmetric` reads the lower triangle alone, and says so in the header. `comment` may have several lines.
/// @throws Error (bad_input) naming an entry that is not finite, or for a symmetric matrix that is not square.
[[nodiscard]] std::string matrix_market_bytes(const Eigen::SparseMatrix<double>& matrix, MatrixSymmetry symmetry,
                                              std::string_view comment);

}  // namespace argil::io
