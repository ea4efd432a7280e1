#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "io/number_type.h"
#include "io/set_fields.h"
#include "io/text_cursor.h"
#include "io/vtk.h"
#include "io/vtk_cells.h"

namespace argil::io {
namespace {

using Kind = NumberType::Kind;

struct TypeName {
  std::string_view name;
  NumberType type;
};
constexpr std::array k_types{
    TypeName{"unsigned_char", {Kind::unsigned_integer, 1}}, TypeName{"char", {Kind::signed_integer, 1}},
    TypeName{"unsigned_short", {Kind::unsigned_integer, 2}}, TypeName{"short", {Kind::signed_integer, 2}},
    TypeName{"unsigned_int", {Kind::unsigned_integer, 4}}, TypeName{"int", {Kind::signed_integer, 4}},
    TypeName{"unsigned_long", {Kind::unsigned_integer, 8}}, TypeName{"long", {Kind::signed_integer, 8}},
    TypeName{"vtktypeint64", {Kind::signed_integer, 8}}, TypeName{"vtktypeuint64", {Kind::unsigned_integer, 8}},
    TypeName{"vtktypeint32", {Kind::signed_integer, 4}}, TypeName{"vtktypeuint32", {Kind::unsigned_integer, 4}},
    // VTK's own index type goes to files with 32 bits.
    TypeName{"vtkidtype", {Kind::signed_integer, 4}}, TypeName{"float", {Kind::floating, 4}},
    TypeName{"double", {Kind::floating, 8}}};

std::string lowered(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char low = static_cast<char>(c | 0x20);
  return low >= 'a' && low <= 'f' ? low - 'a' + 10 : -1;
}

// Names of arrays are words in which VTK writes blanks and the like as %XX.
std::string decoded(std::string_view word) {
  std::string name;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word[i] == '%' && i + 2 < word.size() && hex_digit(word[i + 1]) >= 0 && hex_digit(word[i + 2]) >= 0) {
      name += static_cast<char>(16 * hex_digit(word[i + 1]) + hex_digit(word[i + 2]));
      i += 2;
    } else {
      name += word[i];
    }
  }
  return name;
}

class Reader {
 public:
  Reader(std::string_view bytes, std::string_view name) : cursor_(bytes, name) {}

  VolumeMesh read() {
    read_header();
    while (!cursor_.at_end()) {
      const std::string keyword = lowered(cursor_.word("a section"));
      if (keyword == "points") {
        read_points();
      } else if (keyword == "cells") {
        read_cells();
      } else if (keyword == "cell_types") {
        read_cell_types();
      } else if (keyword == "field" && !have_points_) {
        read_field(passed_over_, std::nullopt);
      } else if (keyword == "metadata") {
        skip_metadata();
      } else if (keyword == "point_data") {
        if (!have_points_) cursor_.fail("expected POINTS before POINT_DATA");
        read_attributes(mesh_.point_fields, static_cast<std::size_t>(mesh_.cells.positions.cols()), "points");
      } else if (keyword == "cell_data") {
        if (!have_types_) cursor_.fail("expected CELLS and CELL_TYPES before CELL_DATA");
        read_attributes(mesh_.cell_fields, cells_.types.size(), "cells");
      } else {
        cursor_.mismatch("POINTS, CELLS, CELL_TYPES, POINT_DATA, CELL_DATA or METADATA");
      }
    }
    if (!have_points_ || !have_types_ || cells_.types.empty()) {
      throw Error(ErrorCode::bad_input,
                  "expected POINTS, CELLS and CELL_TYPES with at least one cell; was the file cut short?",
                  cursor_.where(cursor_.offset()));
    }
    append_vtk_cells(cells_, mesh_.cells);
    take_sets_from_fields(mesh_);
    return std::move(mesh_);
  }

 private:
  using NamedFields = std::vector<NamedField>;

  struct Integers {
    std::vector<std::int64_t> values;
    std::function<std::string(std::size_t)> where;
  };

  void read_header() {
    for (const std::string_view word : {"#", "vtk", "DataFile", "Version"}) {
      if (cursor_.word("a first line") != word) cursor_.mismatch("a first line \"# vtk DataFile Version ...\"");
    }
    const std::string_view version = cursor_.word("a version");
    int minor = 0;
    const char* const end = version.data() + version.size();
    auto result = std::from_chars(version.data(), end, version_);
    if (result.ec != std::errc{} || result.ptr == end || *result.ptr != '.')
      cursor_.mismatch("a version such as 4.2");
    result = std::from_chars(result.ptr + 1, end, minor);
    if (result.ec != std::errc{} || result.ptr != end) cursor_.mismatch("a version such as 4.2");
    if (version_ < 2 || version_ > 5 || (version_ == 5 && minor > 1)) {
      cursor_.fail(fmt::format("version {} is not held; expected 2.0 to 5.1", version), ErrorCode::unsupported);
    }
    cursor_.end_of_line();
    cursor_.rest_of_line();  // the title
    const std::string form = lowered(cursor_.word("ASCII or BINARY"));
    if (form != "ascii" && form != "binary") cursor_.mismatch("ASCII or BINARY");
    binary_ = form == "binary";
    if (lowered(cursor_.word("DATASET")) != "dataset") cursor_.mismatch("DATASET");
    const std::string_view set = cursor_.word("UNSTRUCTURED_GRID");
    if (lowered(set) != "unstructured_grid") {
      cursor_.fail(fmt::format("the data set {} is not held; convert it to UNSTRUCTURED_GRID", in_quotes(set)),
                   ErrorCode::unsupported);
    }
  }

  NumberType number_type() {
    const std::string name = lowered(cursor_.word("a type of number"));
    for (const TypeName& known : k_types) {
      if (known.name == name) return known.type;
    }
    if (name == "bit" || name == "string" || name == "utf8_string" || name == "variant") {
      cursor_.fail(fmt::format("arrays of {} are not held; remove the array or write it as numbers", name),
                   ErrorCode::unsupported);
    }
    cursor_.mismatch("a type of number (float, double, int …)");
  }

  // Number of values in `items` items, known to fit into what is left of the file.
  std::size_t values_left(std::size_t items, std::size_t components, NumberType type) const {
    const std::size_t most = binary_ ? cursor_.remaining() / type.bytes : (cursor_.remaining() + 1) / 2;
    if (components != 0 && items > most / components) {
      cursor_.fail(fmt::format("expected {} × {} values, but only {} bytes are left in the file; was it cut short?",
                               items, components, cursor_.remaining()));
    }
    return items * components;
  }

  std::string_view raw(std::size_t count, NumberType type) {
    cursor_.end_of_line();
    raw_at_ = cursor_.offset();
    return cursor_.bytes(count * type.bytes, "binary numbers");
  }

  NumberFault raw_fault(NumberType type) const {
    return [this, type](std::size_t index, const std::string& message) {
      throw Error(ErrorCode::bad_input, message,
                  fmt::format("{}: byte {}", cursor_.file(), raw_at_ + index * type.bytes));
    };
  }

  std::vector<double> doubles(std::size_t items, std::size_t components, NumberType type) {
    const std::size_t count = values_left(items, components, type);
    if (binary_) return decode_doubles(raw(count, type), type, true, raw_fault(type));
    std::vector<double> values(count);
    for (double& value : values) value = cursor_.number("a number");
    return values;
  }

  Integers integers(std::size_t items, NumberType type, std::string_view expected) {
    const std::size_t count = values_left(items, 1, type);
    if (binary_) {
      Integers out{decode_integers(raw(count, type), type, true, raw_fault(type)), {}};
      out.where = [this, at = raw_at_, type](std::size_t i) {
        return fmt::format("{}: byte {}", cursor_.file(), at + i * type.bytes);
      };
      return out;
    }
    Integers out{std::vector<std::int64_t>(count), {}};
    out.where = [this, at = cursor_.offset()](std::size_t i) { return cursor_.where_word(at, i); };
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    for (auto& value : out.values) value = cursor_.integer(expected, -most, most);
    return out;
  }

  void once(bool& seen, std::string_view section) {
    if (seen) cursor_.fail(fmt::format("the section {} stands twice", section));
    seen = true;
  }

  void read_points() {
    once(have_points_, "POINTS");
    const std::size_t count = cursor_.count("a number of points", 3);
    const NumberType type = number_type();
    const std::vector<double> values = doubles(count, 3, type);
    mesh_.cells.positions = Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, static_cast<Eigen::Index>(count));
  }

  void read_cells() {
    once(have_cells_, "CELLS");
    const std::size_t first = cursor_.count("a number of cells", 1);
    const std::size_t second = cursor_.count("a size of the cell list", 1);
    if (version_ >= 5) {
      read_offsets(first, second);
    } else {
      read_classic(first, second);
    }
  }

  void read_classic(std::size_t cells, std::size_t size) {
    numbers_ = integers(size, {Kind::signed_integer, 4}, "a vertex");
    const auto& raw_numbers = numbers_.values;
    std::size_t at = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      if (at >= size) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("CELLS says {} cells, but its {} numbers end after {}", cells, size, c),
                    numbers_.where(size == 0 ? 0 : size - 1));
      }
      const std::int64_t length = raw_numbers[at];
      if (length < 0 || static_cast<std::size_t>(length) > size - at - 1) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("cell {}: expected a length of at most {}, found {}", c, size - at - 1, length),
                    numbers_.where(at));
      }
      const auto begin = raw_numbers.begin() + static_cast<std::ptrdiff_t>(at + 1);
      cells_.connectivity.insert(cells_.connectivity.end(), begin, begin + length);
      cells_.offsets.push_back(cells_.connectivity.size());
      at += 1 + static_cast<std::size_t>(length);
    }
    if (at != size) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("CELLS says {} numbers, but its {} cells end after {}", size, cells, at),
                  numbers_.where(at));
    }
    // Each cell's length stands before it.
    cells_.where_number = [this](std::size_t i) {
      const auto cell = std::upper_bound(cells_.offsets.begin(), cells_.offsets.end(), i) - cells_.offsets.begin();
      return numbers_.where(i + std::min(static_cast<std::size_t>(cell), cells_.types.size()));
    };
  }

  void read_offsets(std::size_t count, std::size_t size) {
    if (lowered(cursor_.word("OFFSETS")) != "offsets") cursor_.mismatch("OFFSETS");
    const Integers offsets = integers(count, number_type(), "an offset");
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t least = i == 0 ? 0 : offsets.values[i - 1];
      const std::int64_t most = i == 0 ? 0 : static_cast<std::int64_t>(size);
      const std::int64_t value = offsets.values[i];
      if (value < least || value > most || (i + 1 == count && value != most)) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("expected offsets that rise from 0 to {}, found {} after {}", size, value, least),
                    offsets.where(i));
      }
      if (i > 0) cells_.offsets.push_back(static_cast<std::size_t>(value));
    }
    if (lowered(cursor_.word("CONNECTIVITY")) != "connectivity") cursor_.mismatch("CONNECTIVITY");
    if (count == 0 && size > 0) cursor_.fail("expected OFFSETS for the connectivity, found none");
    numbers_ = integers(size, number_type(), "a vertex");
    cells_.connectivity = numbers_.values;
    cells_.where_number = numbers_.where;
  }

  void read_cell_types() {
    once(have_types_, "CELL_TYPES");
    if (!have_cells_) cursor_.fail("expected CELLS before CELL_TYPES");
    const std::size_t count = cursor_.count("a number of cell types", 1);
    if (count != cells_.offsets.size() - 1) {
      cursor_.fail(fmt::format("expected {} cell types, as many as CELLS has cells, found {}",
                               cells_.offsets.size() - 1, count));
    }
    Integers types = integers(count, {Kind::signed_integer, 4}, "a cell type");
    cells_.types = std::move(types.values);
    cells_.where_type = types.where;
  }

  // A block of lines that ends with an empty one.
  void skip_metadata() {
    cursor_.end_of_line();
    while (cursor_.remaining() > 0 && !cursor_.rest_of_line().empty()) {
    }
  }

  void read_attributes(NamedFields& fields, std::size_t items, std::string_view what) {
    const std::size_t count = cursor_.count("a number of items", 0 + 1);
    if (count != items) cursor_.fail(fmt::format("expected {}, the number of {}, found {}", items, what, count));
    while (!cursor_.at_end()) {
      const std::string next = lowered(cursor_.peek());
      if (next == "point_data" || next == "cell_data") return;
      cursor_.word("an attribute");
      if (!read_attribute(next, fields, items)) {
        cursor_.mismatch("SCALARS, VECTORS, NORMALS, TENSORS, TEXTURE_COORDINATES, FIELD or another attribute");
      }
    }
  }

  bool read_attribute(const std::string& keyword, NamedFields& fields, std::size_t items) {
    if (keyword == "metadata") {
      skip_metadata();
    } else if (keyword == "field") {
      read_field(fields, items);
    } else if (keyword == "lookup_table") {
      cursor_.word("a name");
      const std::size_t size = cursor_.count("a size of the table", 4);
      static_cast<void>(doubles(size, 4, {binary_ ? Kind::unsigned_integer : Kind::floating, 1}));
    } else if (keyword == "scalars") {
      std::string name = decoded(cursor_.word("a name"));
      const NumberType type = number_type();
      const int components =
          cursor_.more_on_line() ? static_cast<int>(cursor_.integer("a number of components", 1, 4)) : 1;
      if (lowered(cursor_.word("LOOKUP_TABLE")) != "lookup_table") cursor_.mismatch("LOOKUP_TABLE");
      cursor_.word("a name");
      add_field(fields, std::move(name), components, items, type);
    } else if (keyword == "color_scalars") {
      // Parts of one in text, of 255 in binary.
      std::string name = decoded(cursor_.word("a name"));
      const int components = static_cast<int>(cursor_.integer("a number of components", 1, 4));
      add_field(fields, std::move(name), components, items, {binary_ ? Kind::unsigned_integer : Kind::floating, 1});
      if (binary_) {
        for (double& value : fields.back().values) value /= 255;
      }
    } else if (keyword == "texture_coordinates") {
      std::string name = decoded(cursor_.word("a name"));
      const int components = static_cast<int>(cursor_.integer("a number of components", 1, 3));
      add_field(fields, std::move(name), components, items, number_type());
    } else {
      constexpr std::array<std::pair<std::string_view, int>, 6> k_plain{{{"vectors", 3},
                                                                         {"normals", 3},
                                                                         {"tensors", 9},
                                                                         {"tensors6", 6},
                                                                         {"global_ids", 1},
                                                                         {"pedigree_ids", 1}}};
      const auto found =
          std::find_if(k_plain.begin(), k_plain.end(), [&](const auto& p) { return p.first == keyword; });
      if (found == k_plain.end()) return false;
      std::string name = decoded(cursor_.word("a name"));
      add_field(fields, std::move(name), found->second, items, number_type());
    }
    return true;
  }

  void read_field(NamedFields& fields, std::optional<std::size_t> items) {
    cursor_.word("a name");
    const std::size_t arrays = cursor_.count("a number of arrays", 8);
    for (std::size_t a = 0; a < arrays; ++a) {
      while (lowered(cursor_.peek()) == "metadata") {
        cursor_.word("METADATA");
        skip_metadata();
      }
      std::string name = decoded(cursor_.word("a name"));
      const int components = static_cast<int>(cursor_.integer("a number of components", 1, 1 << 20));
      const std::size_t tuples = cursor_.count("a number of tuples", 1);
      if (items && tuples != *items) {
        cursor_.fail(fmt::format("the array {} has {} tuples; expected {}", in_quotes(name), tuples, *items));
      }
      add_field(fields, std::move(name), components, tuples, number_type());
    }
  }

  void add_field(NamedFields& fields, std::string name, int components, std::size_t items, NumberType type) {
    if (!names_.insert({&fields, name}).second) {
      cursor_.fail(fmt::format("two arrays have the name {}; rename one", in_quotes(name)));
    }
    std::vector<double> values = doubles(items, static_cast<std::size_t>(components), type);
    fields.push_back({std::move(name), components, std::move(values)});
  }

  TextCursor cursor_;
  VolumeMesh mesh_;
  NamedFields passed_over_;  // the data set's own
  VtkCells cells_;
  Integers numbers_;
  std::set<std::pair<const NamedFields*, std::string>> names_;
  std::size_t raw_at_ = 0;
  int version_ = 0;
  bool binary_ = false, have_points_ = false, have_cells_ = false, have_types_ = false;
};

}  // namespace

VolumeMesh read_vtk(std::string_view bytes, std::string_view name) {
  return Reader(bytes, name).read();
}

}  // namespace argil::io
