#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "io/set_fields.h"
#include "io/text_cursor.h"
#include "io/vtk_cells.h"
#include "io/vtu.h"

namespace argil::io {
namespace {

std::string escaped(std::string_view name) {
  std::string text;
  for (const char c : name) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        if (c >= 0 && c < ' ') {
          fmt::format_to(std::back_inserter(text), "&#{};", static_cast<int>(c));
        } else {
          text += c;
        }
    }
  }
  return text;
}

template <class T>
constexpr std::string_view type_name() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  return "UInt8";
}

constexpr std::size_t k_block = std::size_t{1} << 20;

// The two halves of the file, where it has two, grow together.
class Writer {
 public:
  explicit Writer(Encoding encoding) : encoding_(encoding) {}

  std::string write(const VolumeMesh& mesh) {
    const auto& cells = mesh.cells;
    line(0, "<?xml version=\"1.0\"?>");
    line(0, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\"{}>",
         std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
         encoding_ == Encoding::compressed ? " compressor=\"vtkZLibDataCompressor\"" : "");
    line(1, "<UnstructuredGrid>");
    line(2, "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", cells.positions.cols(), cells.cell_count());
    attributes("PointData", static_cast<std::size_t>(cells.positions.cols()), mesh.point_fields, mesh.sets,
               SetKind::points);
    attributes("CellData", cells.cell_count(), mesh.cell_fields, mesh.sets, SetKind::cells);
    line(3, "<Points>");
    array("Points", 3, cells.positions.data(), static_cast<std::size_t>(cells.positions.size()));
    line(3, "</Points>");
    write_cells(cells);
    line(2, "</Piece>");
    line(1, "</UnstructuredGrid>");
    if (encoding_ != Encoding::ascii) {
      line(1, "<AppendedData encoding=\"raw\">");
      xml_ += '_';
      xml_ += appended_;
      line(0, "");
      line(1, "</AppendedData>");
    }
    line(0, "</VTKFile>");
    return std::move(xml_);
  }

 private:
  template <class... Args>
  void line(std::size_t depth, fmt::format_string<Args...> text, Args&&... args) {
    xml_.append(2 * depth, ' ');
    fmt::format_to(std::back_inserter(xml_), text, std::forward<Args>(args)...);
    xml_ += '\n';
  }

  template <class T>
  void array(std::string_view name, int components, const T* values, std::size_t count) {
    const std::string head = fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"",
                                         type_name<T>(), escaped(name), components);
    if (encoding_ == Encoding::ascii) {
      line(4, "{} format=\"ascii\">", head);
      for (std::size_t i = 0; i < count; ++i) {
        if constexpr (std::is_same_v<T, double>) {
          append_number(xml_, values[i]);
        } else {
          fmt::format_to(std::back_inserter(xml_), "{}", static_cast<std::int64_t>(values[i]));
        }
        xml_ += (i + 1) % 12 == 0 ? '\n' : ' ';
      }
      line(0, "");
      line(4, "</DataArray>");
      return;
    }
    line(4, "{} format=\"appended\" offset=\"{}\"/>", head, appended_.size());
    const std::string_view bytes(reinterpret_cast<const char*>(values), count * sizeof(T));
    if (encoding_ == Encoding::compressed) {
      append_compressed(bytes);
    } else {
      append_word(bytes.size());
      appended_ += bytes;
    }
  }
  void append_word(std::uint64_t value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    appended_.append(bytes, sizeof value);
  }
  // Header: number of blocks, their size, that of a last smaller one (0: none), the packed sizes.
  void append_compressed(std::string_view bytes) {
    const std::size_t blocks = (bytes.size() + k_block - 1) / k_block, header = appended_.size();
    for (const std::uint64_t word : {blocks, k_block, bytes.size() % k_block}) append_word(word);
    appended_.resize(appended_.size() + blocks * sizeof(std::uint64_t));
    std::string packed(compressBound(k_block), '\0');
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::string_view block = bytes.substr(b * k_block, k_block);
      uLongf size = packed.size();
      [[maybe_unused]] const int result = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                                                    reinterpret_cast<const Bytef*>(block.data()), block.size(), 4);
      assert(result == Z_OK);  // the buffer is large enough by compressBound
      const std::uint64_t packed_size = size;
      std::memcpy(appended_.data() + header + (3 + b) * sizeof packed_size, &packed_size, sizeof packed_size);
      appended_.append(packed, 0, size);
    }
  }
  template <class T>
  void array(std::string_view name, const std::vector<T>& values) {
    array(name, 1, values.data(), values.size());
  }

  void attributes(std::string_view element, std::size_t items, const std::vector<NamedField>& fields,
                  const std::vector<NamedSet>& sets, SetKind kind) {
    const bool any_set = std::any_of(sets.begin(), sets.end(), [&](auto& set) { return set.kind == kind; });
    if (fields.empty() && !any_set) return;
    line(3, "<{}>", element);
    for (const NamedField& field : fields)
      array(field.name, field.components, field.values.data(), field.values.size());
    for (const NamedSet& set : sets)
      if (set.kind == kind) array(std::string(k_set_prefix) + set.name, membership(set, items));
    line(3, "</{}>", element);
  }

  void write_cells(const subdiv::CellLists& cells) {
    std::vector<std::int64_t> connectivity, offsets, faces, face_offsets;
    std::vector<std::uint8_t> types;
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
      const auto begin = cells.connectivity.begin() + static_cast<std::ptrdiff_t>(cells.offsets[c]);
      const auto end = cells.connectivity.begin() + static_cast<std::ptrdiff_t>(cells.offsets[c + 1]);
      types.push_back(static_cast<std::uint8_t>(vtk_type(cells.kinds[c])));
      if (cells.kinds[c] == subdiv::CellKind::polyhedron) {
        faces.insert(faces.end(), begin, end);
        face_offsets.push_back(static_cast<std::int64_t>(faces.size()));
        const auto first = static_cast<std::ptrdiff_t>(connectivity.size());
        for (auto at = begin + 1; at < end; at += 1 + static_cast<std::ptrdiff_t>(*at)) {
          connectivity.insert(connectivity.end(), at + 1, at + 1 + static_cast<std::ptrdiff_t>(*at));
        }
        std::sort(connectivity.begin() + first, connectivity.end());
        connectivity.erase(std::unique(connectivity.begin() + first, connectivity.end()), connectivity.end());
      } else {
        face_offsets.push_back(-1);
        connectivity.insert(connectivity.end(), begin, end);
      }
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    line(3, "<Cells>");
    array("connectivity", connectivity);
    array("offsets", offsets);
    array("types", types);
    if (!faces.empty()) {
      array("faces", faces);
      array("faceoffsets", face_offsets);
    }
    line(3, "</Cells>");
  }

  Encoding encoding_;
  std::string xml_, appended_;
};

}  // namespace

std::string vtu_bytes(const VolumeMesh& mesh, const WriteOptions& options) {
  return Writer(options.encoding).write(mesh);
}

}  // namespace argil::io
