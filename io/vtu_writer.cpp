#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

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

// The two halves of the file grow together.
class Writer {
 public:
  std::string write(const VolumeMesh& mesh) {
    const auto& cells = mesh.cells;
    line(0, "<?xml version=\"1.0\"?>");
    line(0, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">",
         std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    line(1, "<UnstructuredGrid>");
    line(2, "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", cells.positions.cols(), cells.cell_count());
    fields("PointData", mesh.point_fields);
    fields("CellData", mesh.cell_fields);
    line(3, "<Points>");
    array("Points", 3, cells.positions.data(), static_cast<std::size_t>(cells.positions.size()));
    line(3, "</Points>");
    write_cells(cells);
    line(2, "</Piece>");
    line(1, "</UnstructuredGrid>");
    line(1, "<AppendedData encoding=\"raw\">");
    xml_ += "_" + appended_;
    line(0, "");
    line(1, "</AppendedData>");
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
    line(4, "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>",
         type_name<T>(), escaped(name), components, appended_.size());
    const std::uint64_t size = count * sizeof(T);
    const std::size_t at = appended_.size();
    appended_.resize(at + sizeof size + size);
    std::memcpy(appended_.data() + at, &size, sizeof size);
    if (size > 0) std::memcpy(appended_.data() + at + sizeof size, values, size);
  }
  template <class T>
  void array(std::string_view name, const std::vector<T>& values) {
    array(name, 1, values.data(), values.size());
  }

  void fields(std::string_view element, const std::vector<NamedField>& list) {
    if (list.empty()) return;
    line(3, "<{}>", element);
    for (const NamedField& field : list)
      array(field.name, field.components, field.values.data(), field.values.size());
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

  std::string xml_, appended_;
};

}  // namespace

std::string vtu_bytes(const VolumeMesh& mesh) {
  return Writer().write(mesh);
}

}  // namespace argil::io
