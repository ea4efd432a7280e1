#pragma once
// chart.csv: one row a run, appended as runs finish, so that a chart that was killed goes on where it stopped.
// Columns as in k_columns; empty where a run has no such number. RFC 4180 quoting, UTF-8, decimal points.

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace argil::chart {

inline constexpr double k_nothing = std::numeric_limits<double>::quiet_NaN();

enum class Status {
  ok,
  diverged,       // a motion that left all bounds, or met a value that is not finite
  refused,        // the method does not do this, and says why
  not_converged,  // no equilibrium or no frequencies found
  over_time       // stopped at the limit of a run
};
[[nodiscard]] const char* word(Status status);

struct Row {
  std::uint64_t key = 0;  // of what was run: problem, method, space, resolution, time step, threads, version
  std::string problem, model, formulation, integrator, space;
  int resolution = 0;
  std::size_t unknowns = 0, elements = 0, steps = 0;
  double time_step = k_nothing;                        // [s]
  double error = k_nothing, signed_error = k_nothing;  // relative to the reference
  bool same_law = true;                                // the reference is that of this model
  double ms = k_nothing;                               // of the solve, or of all steps
  double ms_per_step = k_nothing, ms_per_simulated_second = k_nothing;
  double peak_bytes = k_nothing;  // growth of the peak of resident memory during the run
  int threads = 0;
  std::string version, commit;  // of argil; a run of another commit is not done again, one of another version is
  Status status = Status::ok;
  std::string message;
  std::uint64_t state_hash = 0;  // of the final positions and velocities

  /// Model, formulation and integrator in one.
  [[nodiscard]] std::string method() const;
};

[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string csv_line(const Row& row);  // without the line's end

/// Whole rows of a file; a last line that was not written to its end is left out, and where it begins is told.
struct ReadTable {
  std::vector<Row> rows;
  std::size_t whole_bytes = 0;
};
/// @throws Error (bad_input; `where` names the line) for another header or a malformed row that is not the last.
[[nodiscard]] ReadTable parse_table(const std::string& text);

/// The file on disk, open for more.
class Table {
 public:
  /// Reads what is there (cutting off a last line that is not whole), or begins a new one.
  /// @throws Error (bad_input) if it is not a table of this program, or cannot be written.
  explicit Table(const std::filesystem::path& path);

  const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] const Row* find(std::uint64_t key) const;
  /// Appends and flushes.
  void add(const Row& row);

 private:
  std::filesystem::path path_;
  std::vector<Row> rows_;
  std::ofstream file_;
};

}  // namespace argil::chart
