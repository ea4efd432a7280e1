#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "io/set_fields.h"
#include "io/text_cursor.h"
#include "io/vtk.h"
#include "io/vtk_cells.h"

namespace argil::io {
namespace {

// Names of arrays are words: everything else is written as %XX, as VTK does.
std::string encoded(std::string_view name) {
  std::string word;
  for (const char c : name) {
    if (c > ' ' && c <= '~' && c != '%' && c != '"') {
      word += c;
    } else {
      fmt::format_to(std::back_inserter(word), "%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return word;
}

class Writer {
 public:
  explicit Writer(bool binary) : binary_(binary) {}

  std::string write(const VolumeMesh& mesh) {
    const auto& cells = mesh.cells;
    text_ = fmt::format("# vtk DataFile Version 4.2\nArgil\n{}\nDATASET UNSTRUCTURED_GRID\n",
                        binary_ ? "BINARY" : "ASCII");
    const auto points = static_cast<std::size_t>(cells.positions.cols());
    append_line(text_, "POINTS {} double", points);
    numbers(cells.positions.data(), 3 * points, 3);
    append_line(text_, "CELLS {} {}", cells.cell_count(), cells.cell_count() + cells.connectivity.size());
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
      const std::size_t size = cells.offsets[c + 1] - cells.offsets[c];
      number(static_cast<std::int32_t>(size));
      for (std::size_t i = cells.offsets[c]; i < cells.offsets[c + 1]; ++i) {
        if (!binary_) text_ += ' ';
        number(static_cast<std::int32_t>(cells.connectivity[i]));
      }
      if (!binary_) text_ += '\n';
    }
    if (binary_) text_ += '\n';
    std::vector<std::int32_t> types;
    for (const auto kind : cells.kinds) types.push_back(vtk_type(kind));
    append_line(text_, "CELL_TYPES {}", types.size());
    numbers(types.data(), types.size(), 1);
    attributes("POINT_DATA", points, mesh.point_fields, mesh.sets, SetKind::points);
    attributes("CELL_DATA", cells.cell_count(), mesh.cell_fields, mesh.sets, SetKind::cells);
    return std::move(text_);
  }

 private:
  template <class T>
  void number(T value) {
    if (binary_) {  // big endian
      char bytes[sizeof value];
      std::memcpy(bytes, &value, sizeof value);
      if constexpr (std::endian::native == std::endian::little) std::reverse(bytes, bytes + sizeof value);
      text_.append(bytes, sizeof value);
    } else if constexpr (std::is_same_v<T, double>) {
      append_number(text_, value);
    } else {
      fmt::format_to(std::back_inserter(text_), "{}", static_cast<int>(value));
    }
  }

  template <class T>
  void numbers(const T* values, std::size_t count, std::size_t on_a_line) {
    for (std::size_t i = 0; i < count; ++i) {
      number(values[i]);
      if (!binary_) text_ += (i + 1) % on_a_line == 0 ? '\n' : ' ';
    }
    if (binary_) text_ += '\n';
  }

  void attributes(std::string_view header, std::size_t items, const std::vector<NamedField>& fields,
                  const std::vector<NamedSet>& sets, SetKind kind) {
    const auto held =
        static_cast<std::size_t>(std::count_if(sets.begin(), sets.end(), [&](auto& s) { return s.kind == kind; }));
    if (fields.empty() && held == 0) return;
    append_line(text_, "{} {}\nFIELD FieldData {}", header, items, fields.size() + held);
    for (const NamedField& field : fields) {
      append_line(text_, "{} {} {} double", encoded(field.name), field.components, items);
      numbers(field.values.data(), field.values.size(), static_cast<std::size_t>(field.components));
    }
    for (const NamedSet& set : sets) {
      if (set.kind != kind) continue;
      append_line(text_, "{} 1 {} unsigned_char", encoded(std::string(k_set_prefix) + set.name), items);
      numbers(membership(set, items).data(), items, 1);
    }
  }

  std::string text_;
  bool binary_;
};

}  // namespace

std::string vtk_text(const VolumeMesh& mesh, const WriteOptions& options) {
  return Writer(options.encoding == Encoding::binary).write(mesh);
}

}  // namespace argil::io
