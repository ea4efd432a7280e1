#pragma once
// probes.csv: one row a probe, appended as it is made, so that an atlas that was killed goes on where it stopped. A
// row's key is the hash of all that it ran.

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tools/atlas/probe.h"

namespace argil::atlas {

struct ProbeRow {
  std::uint64_t key = 0;
  std::string sweep, model, integrator;
  double swept = 0, searched = 0;  // values of the two parameters
  double time_step = 0;            // [s]
  ProbeResult result;
};

[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string csv_line(const ProbeRow& row);  // with its line end
/// Reads what csv_line() writes; rows that are not whole are left out.
[[nodiscard]] std::vector<ProbeRow> read_rows(const std::string& text);

/// The rows of a folder. Safe to use from several threads.
class ProbeStore {
 public:
  /// Takes what an earlier run left in `file`, mended where it was cut off.
  /// @throws Error (bad_input) if the file is there but of another kind, or cannot be written.
  explicit ProbeStore(std::filesystem::path file);
  /// The row with this key, from `run` if it is not there yet.
  template <class Run>
  ProbeRow find_or_run(std::uint64_t key, const Run& run) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = rows_.find(key); found != rows_.end()) return found->second;
    }
    const ProbeRow row = run();
    append(row);
    return row;
  }
  std::size_t taken_over() const { return taken_over_; }
  std::size_t made() const { return made_; }
  /// Writes the file anew, sorted, so that the order in which threads came does not show.
  void sort_file();

 private:
  void append(const ProbeRow& row);

  std::filesystem::path file_;
  std::mutex mutex_;
  std::map<std::uint64_t, ProbeRow> rows_;
  std::ofstream out_;
  std::size_t taken_over_ = 0, made_ = 0;
};

}  // namespace argil::atlas
