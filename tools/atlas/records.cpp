#include "tools/atlas/records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "io/file_bytes.h"
#include "subdiv/error.h"

namespace argil::atlas {

namespace {

constexpr std::size_t k_columns = 13;

std::string number(double value) {
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

bool parse(const std::string& text, double& value) {
  if (text.empty()) {
    value = std::nan("");
    return true;
  }
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return *end == 0;
}

bool parse(const std::string& text, Outcome& outcome) {
  for (const Outcome each : {Outcome::stable, Outcome::inaccurate, Outcome::diverged, Outcome::refused})
    if (word(each) == text) {
      outcome = each;
      return true;
    }
  return false;
}

bool parse(const std::string& line, ProbeRow& row) {
  std::array<std::string, k_columns> cells;
  std::size_t column = 0;
  for (const char c : line) {
    if (c != ',')
      cells[column] += c;
    else if (++column == k_columns)
      return false;
  }
  if (column + 1 != k_columns || cells[0].size() != 16) return false;
  char* end = nullptr;
  row.key = std::strtoull(cells[0].c_str(), &end, 16);
  if (*end != 0) return false;
  row.sweep = cells[1];
  row.model = cells[2];
  row.integrator = cells[3];
  double steps = 0;
  if (!parse(cells[4], row.swept) || !parse(cells[5], row.searched) || !parse(cells[6], row.time_step) ||
      !parse(cells[7], row.result.outcome) || !parse(cells[8], row.result.error) ||
      !parse(cells[9], row.result.energy_ratio) || !parse(cells[10], steps) ||
      !parse(cells[11], row.result.largest_stable_step))
    return false;
  row.result.steps = static_cast<int>(steps);
  row.result.note = cells[12];
  return true;
}

}  // namespace

std::string csv_header() {
  return "key,sweep,model,integrator,swept,searched,time_step,outcome,error,energy_ratio,steps,largest_stable_step,"
         "note\n";
}

std::string csv_line(const ProbeRow& row) {
  return fmt::format("{:016x},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.key, row.sweep, row.model, row.integrator,
                     row.swept, row.searched, row.time_step, word(row.result.outcome), number(row.result.error),
                     number(row.result.energy_ratio), row.result.steps, number(row.result.largest_stable_step),
                     row.result.note);
}

std::vector<ProbeRow> read_rows(const std::string& text) {
  std::vector<ProbeRow> rows;
  std::size_t begin = text.find('\n') + 1;
  for (std::size_t end; begin > 0 && (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
    ProbeRow row;
    if (parse(text.substr(begin, end - begin), row)) rows.push_back(std::move(row));
  }
  return rows;
}

ProbeStore::ProbeStore(std::filesystem::path file) : file_(std::move(file)) {
  if (std::filesystem::exists(file_)) {
    const std::string text = io::read_file(file_);
    if (!text.empty() && !text.starts_with(csv_header()) && !csv_header().starts_with(text))
      throw Error(ErrorCode::bad_input,
                  "this is not a list of probes of this version; name another folder with --out", file_.string());
    for (ProbeRow& row : read_rows(text)) rows_[row.key] = std::move(row);
  }
  taken_over_ = rows_.size();
  sort_file();
  out_.open(file_, std::ios::app);
  if (!out_)
    throw Error(ErrorCode::bad_input, "the list of probes cannot be written; name another folder with --out",
                file_.string());
}

void ProbeStore::append(const ProbeRow& row) {
  const std::lock_guard lock(mutex_);
  ++made_;
  if (rows_.emplace(row.key, row).second) out_ << csv_line(row) << std::flush;
}

void ProbeStore::sort_file() {
  const std::lock_guard lock(mutex_);
  std::vector<const ProbeRow*> order;
  for (const auto& [key, row] : rows_) order.push_back(&row);
  const auto place = [](const ProbeRow* row) {
    return std::tie(row->sweep, row->model, row->integrator, row->swept, row->searched, row->key);
  };
  std::sort(order.begin(), order.end(), [&](const ProbeRow* a, const ProbeRow* b) { return place(a) < place(b); });
  std::string text = csv_header();
  for (const ProbeRow* row : order) text += csv_line(*row);
  if (out_.is_open()) out_.close();
  io::write_file(file_, text);
}

}  // namespace argil::atlas
