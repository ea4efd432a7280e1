#include "tools/chart/table.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "io/file_bytes.h"
#include "subdiv/error.h"

namespace argil::chart {

namespace {

constexpr std::array k_columns{"key",
                               "problem",
                               "method",
                               "model",
                               "formulation",
                               "integrator",
                               "space",
                               "resolution",
                               "unknowns",
                               "elements",
                               "dt",
                               "steps",
                               "error",
                               "signed_error",
                               "same_law",
                               "ms",
                               "ms_per_step",
                               "ms_per_simulated_second",
                               "peak_resident_bytes",
                               "threads",
                               "version",
                               "commit",
                               "status",
                               "message",
                               "state_hash"};
constexpr std::array k_statuses{Status::ok, Status::diverged, Status::refused, Status::not_converged,
                                Status::over_time};

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c == '\n' || c == '\r' ? ' ' : c;  // a row is a line
  }
  return result + '"';
}

// The shortest digits that give the same double again.
std::string number(double value) {
  return std::isnan(value) ? std::string{} : fmt::format("{}", value);
}

struct Line {
  std::vector<std::string> cells;
  bool whole = true;  // quotes closed
};

Line split(std::string_view text) {
  Line line;
  std::string cell;
  bool inside = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (inside && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += '"';
      ++i;
    } else if (text[i] == '"') {
      inside = !inside;
    } else if (text[i] == ',' && !inside) {
      line.cells.push_back(std::move(cell));
      cell.clear();
    } else {
      cell += text[i];
    }
  }
  line.cells.push_back(std::move(cell));
  line.whole = !inside;
  return line;
}

template <class Number>
Number parsed(const std::string& cell, int base = 10) {
  Number value{};
  std::from_chars_result result{};
  if constexpr (std::is_floating_point_v<Number>) {
    if (cell.empty()) return static_cast<Number>(k_nothing);
    result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  } else {
    result = std::from_chars(cell.data(), cell.data() + cell.size(), value, base);
  }
  if (result.ec != std::errc{} || result.ptr != cell.data() + cell.size())
    throw Error(ErrorCode::bad_input, fmt::format("expected a number, found '{}'", cell));
  return value;
}

Row row_of(const std::vector<std::string>& cells) {
  if (cells.size() != k_columns.size())
    throw Error(ErrorCode::bad_input, fmt::format("expected {} columns, found {}", k_columns.size(), cells.size()));
  std::size_t i = 0;
  const auto next = [&]() -> const std::string& { return cells[i++]; };
  Row row;
  row.key = parsed<std::uint64_t>(next(), 16);
  row.problem = next();
  (void)next();  // method, made of the next three
  row.model = next();
  row.formulation = next();
  row.integrator = next();
  row.space = next();
  row.resolution = parsed<int>(next());
  row.unknowns = parsed<std::size_t>(next());
  row.elements = parsed<std::size_t>(next());
  row.time_step = parsed<double>(next());
  row.steps = parsed<std::size_t>(next());
  row.error = parsed<double>(next());
  row.signed_error = parsed<double>(next());
  row.same_law = next() == "yes";
  row.ms = parsed<double>(next());
  row.ms_per_step = parsed<double>(next());
  row.ms_per_simulated_second = parsed<double>(next());
  row.peak_bytes = parsed<double>(next());
  row.threads = parsed<int>(next());
  row.version = next();
  row.commit = next();
  const std::string& status = next();
  bool known = false;
  for (const Status s : k_statuses)
    if (status == word(s)) {
      row.status = s;
      known = true;
    }
  if (!known) throw Error(ErrorCode::bad_input, fmt::format("'{}' is not a status", status));
  row.message = next();
  row.state_hash = parsed<std::uint64_t>(next(), 16);
  return row;
}

}  // namespace

const char* word(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::diverged:
      return "diverged";
    case Status::refused:
      return "refused";
    case Status::not_converged:
      return "not_converged";
    case Status::over_time:
      return "over_time";
  }
  return "";
}

std::string Row::method() const {
  std::string name = model;
  if (formulation != "plain" && !formulation.empty()) name += " " + formulation;
  if (!integrator.empty()) name += ", " + integrator;
  return name;
}

std::string csv_header() {
  std::string header;
  for (const char* column : k_columns) header += (header.empty() ? "" : ",") + std::string(column);
  return header;
}

std::string csv_line(const Row& row) {
  const std::array cells{fmt::format("{:016x}", row.key),
                         quoted(row.problem),
                         quoted(row.method()),
                         quoted(row.model),
                         quoted(row.formulation),
                         quoted(row.integrator),
                         quoted(row.space),
                         fmt::format("{}", row.resolution),
                         fmt::format("{}", row.unknowns),
                         fmt::format("{}", row.elements),
                         number(row.time_step),
                         fmt::format("{}", row.steps),
                         number(row.error),
                         number(row.signed_error),
                         std::string(row.same_law ? "yes" : "no"),
                         number(row.ms),
                         number(row.ms_per_step),
                         number(row.ms_per_simulated_second),
                         number(row.peak_bytes),
                         fmt::format("{}", row.threads),
                         quoted(row.version),
                         quoted(row.commit),
                         std::string(word(row.status)),
                         quoted(row.message),
                         fmt::format("{:016x}", row.state_hash)};
  static_assert(std::tuple_size_v<decltype(cells)> == k_columns.size());
  std::string line = cells[0];
  for (std::size_t i = 1; i < cells.size(); ++i) line += "," + cells[i];
  return line;
}

ReadTable parse_table(const std::string& text) {
  ReadTable result;
  std::size_t begin = 0, number_of_line = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // not written to its end
    const std::string_view bytes(text.data() + begin, end - begin);
    const Line line = split(bytes);
    ++number_of_line;
    const std::string where = fmt::format("line {}", number_of_line);
    if (number_of_line == 1) {
      if (bytes != csv_header())
        throw Error(ErrorCode::bad_input,
                    "this is not a chart.csv of this version of argil; choose another folder with --out", where);
    } else {
      if (!line.whole) throw Error(ErrorCode::bad_input, "a quotation mark is not closed; remove the line", where);
      try {
        result.rows.push_back(row_of(line.cells));
      } catch (const Error& error) {
        throw Error(error.code(), std::string(error.what()) + "; remove the line, and its run is done again",
                    where);
      }
    }
    begin = end + 1;
    result.whole_bytes = begin;
  }
  return result;
}

Table::Table(const std::filesystem::path& path) : path_(path) {
  std::error_code failure;
  if (std::filesystem::exists(path, failure)) {
    try {
      const std::string text = io::read_file(path);
      ReadTable read = parse_table(text);
      rows_ = std::move(read.rows);
      if (read.whole_bytes != text.size()) io::write_file(path, text.substr(0, read.whole_bytes));
    } catch (const Error& error) {
      throw Error(error.code(), error.what(), path.string() + (error.where().empty() ? "" : ", " + error.where()));
    }
  }
  const bool fresh = !std::filesystem::exists(path, failure) || std::filesystem::file_size(path, failure) == 0;
  file_.open(path, std::ios::app | std::ios::binary);
  if (fresh) file_ << csv_header() << '\n' << std::flush;
  if (!file_)
    throw Error(ErrorCode::bad_input,
                fmt::format("'{}' cannot be written; choose another folder with --out", path.string()));
}

const Row* Table::find(std::uint64_t key) const {
  for (const Row& row : rows_)
    if (row.key == key) return &row;
  return nullptr;
}

void Table::add(const Row& row) {
  file_ << csv_line(row) << '\n' << std::flush;
  if (!file_)
    throw Error(
        ErrorCode::bad_input,
        fmt::format("'{}' cannot be written (is the disk full?); the rows up to here are safe", path_.string()));
  rows_.push_back(row);
}

}  // namespace argil::chart
