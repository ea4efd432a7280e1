#pragma once
// A strict reader of Matrix Market coordinate files, for tests of what is written.

#include <Eigen/SparseCore>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace argil::tests {

struct ReadMatrix {
  Eigen::SparseMatrix<double> matrix;  // both triangles
  bool symmetric = false;
};

inline ReadMatrix read_matrix_market(const std::string& bytes) {
  std::istringstream lines(bytes);
  std::string line, banner, object, format, field, symmetry;
  std::getline(lines, line);
  std::istringstream(line) >> banner >> object >> format >> field >> symmetry;
  if (banner != "%%MatrixMarket" || object != "matrix" || format != "coordinate" || field != "real" ||
      (symmetry != "general" && symmetry != "symmetric"))
    throw std::runtime_error("header: " + line);
  while (std::getline(lines, line) && line.starts_with('%'))
    if (line.starts_with("%%")) throw std::runtime_error("a second header: " + line);
  Eigen::Index rows = 0, columns = 0;
  std::size_t count = 0;
  if (!(std::istringstream(line) >> rows >> columns >> count)) throw std::runtime_error("sizes: " + line);
  ReadMatrix result;
  result.symmetric = symmetry == "symmetric";
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::getline(lines, line)) throw std::runtime_error("too few entries");
    std::istringstream words(line);
    Eigen::Index row = 0, column = 0;
    std::string value, rest;
    if (!(words >> row >> column >> value) || words >> rest || row < 1 || row > rows || column < 1 ||
        column > columns || (result.symmetric && row < column))
      throw std::runtime_error("entry: " + line);
    const double number = std::strtod(value.c_str(), nullptr);  // denormals too
    entries.emplace_back(row - 1, column - 1, number);
    if (result.symmetric && row != column) entries.emplace_back(column - 1, row - 1, number);
  }
  if (std::getline(lines, line)) throw std::runtime_error("more entries than announced: " + line);
  result.matrix.resize(rows, columns);
  result.matrix.setFromTriplets(entries.begin(), entries.end(), [](double, double) -> double {
    throw std::runtime_error("an entry is there twice");
  });
  return result;
}

}  // namespace argil::tests
