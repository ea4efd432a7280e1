#include "io/matrix_market.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "subdiv/error.h"
#include "tests/io/matrix_market_reader.h"

namespace argil::io {
namespace {

Eigen::SparseMatrix<double> awkward() {
  Eigen::SparseMatrix<double> matrix(4, 4);
  matrix.insert(0, 0) = std::numbers::pi;
  matrix.insert(3, 0) = -1.0 / 3;
  matrix.insert(0, 3) = -1.0 / 3;
  matrix.insert(2, 1) = std::numeric_limits<double>::denorm_min();
  matrix.insert(1, 2) = std::numeric_limits<double>::denorm_min();
  matrix.insert(3, 3) = std::numeric_limits<double>::max();
  matrix.insert(1, 1) = 0;
  return matrix;
}

TEST(MatrixMarket, DoublesSurviveExactlyAndZerosAreLeftOut) {
  for (const MatrixSymmetry symmetry : {MatrixSymmetry::general, MatrixSymmetry::symmetric}) {
    const std::string bytes = matrix_market_bytes(awkward(), symmetry, "one line\nand another");
    EXPECT_NE(bytes.find("\n% one line\n% and another\n4 4 "), std::string::npos) << bytes;
    const auto read = tests::read_matrix_market(bytes);
    EXPECT_EQ(read.symmetric, symmetry == MatrixSymmetry::symmetric);
    EXPECT_EQ(read.matrix.nonZeros(), 6);
    EXPECT_EQ(Eigen::MatrixXd(read.matrix), Eigen::MatrixXd(awkward()));
  }
}

TEST(MatrixMarket, WhatCannotBeWrittenIsRefused) {
  Eigen::SparseMatrix<double> matrix = awkward();
  matrix.coeffRef(3, 0) = std::nan("");
  EXPECT_THROW(static_cast<void>(matrix_market_bytes(matrix, MatrixSymmetry::general, "")), Error);
  EXPECT_THROW(
      static_cast<void>(matrix_market_bytes(Eigen::SparseMatrix<double>(2, 3), MatrixSymmetry::symmetric, "")),
      Error);
}

}  // namespace
}  // namespace argil::io
