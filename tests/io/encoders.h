#pragma once
// Files as other programs write them: legacy VTK in binary and with the cells of 5.1, and VTU in every encoding.
// They are written here anew, from the description of the formats, so that the readers have a second opinion.

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "io/volume_mesh.h"

namespace argil::io::test {

template <class T>
std::string bytes_of(const std::vector<T>& values, bool big_endian) {
  std::string bytes;
  for (const T value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);  // this machine is little endian
    if (big_endian) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

template <class T>
std::string text_of(const std::vector<T>& values) {
  std::string text;
  for (const T value : values) {
    if constexpr (std::is_floating_point_v<T>) {
      text += fmt::format("{:.17g} ", static_cast<double>(value));
    } else {
      text += fmt::format("{} ", static_cast<std::int64_t>(value));
    }
  }
  return text;
}

inline int type_number(subdiv::CellKind kind) {
  constexpr int k_types[] = {10, 14, 13, 12, 42};
  return k_types[static_cast<int>(kind)];
}

inline std::vector<double> flat_positions(const VolumeMesh& mesh) {
  return {mesh.cells.positions.data(), mesh.cells.positions.data() + mesh.cells.positions.size()};
}

/// Legacy VTK with the fields as SCALARS, VECTORS or FIELD by their width.
inline std::string encode_vtk(const VolumeMesh& mesh, bool binary, bool version_5) {
  std::string out = fmt::format("# vtk DataFile Version {}\nby another hand\n{}\nDATASET UNSTRUCTURED_GRID\n",
                                version_5 ? "5.1" : "3.0", binary ? "BINARY" : "ASCII");
  const auto put = [&](const auto& values) { out += (binary ? bytes_of(values, true) : text_of(values)) + "\n"; };
  const auto& cells = mesh.cells;
  out += fmt::format("POINTS {} double\n", cells.positions.cols());
  put(flat_positions(mesh));
  out += "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 3\n\n";
  if (version_5) {
    out += fmt::format("CELLS {} {}\nOFFSETS vtktypeint64\n", cells.offsets.size(), cells.connectivity.size());
    put(std::vector<std::int64_t>(cells.offsets.begin(), cells.offsets.end()));
    out += "CONNECTIVITY vtktypeint64\n";
    put(std::vector<std::int64_t>(cells.connectivity.begin(), cells.connectivity.end()));
  } else {
    std::vector<std::int32_t> numbers;
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
      numbers.push_back(static_cast<std::int32_t>(cells.offsets[c + 1] - cells.offsets[c]));
      for (std::size_t i = cells.offsets[c]; i < cells.offsets[c + 1]; ++i) {
        numbers.push_back(static_cast<std::int32_t>(cells.connectivity[i]));
      }
    }
    out += fmt::format("CELLS {} {}\n", cells.cell_count(), numbers.size());
    put(numbers);
  }
  std::vector<std::int32_t> types;
  for (const auto kind : cells.kinds) types.push_back(type_number(kind));
  out += fmt::format("CELL_TYPES {}\n", types.size());
  put(types);
  const auto put_fields = [&](const std::vector<NamedField>& fields, std::string_view header, std::size_t items) {
    if (fields.empty()) return;
    out += fmt::format("{} {}\n", header, items);
    for (const NamedField& field : fields) {
      if (field.components == 1) {
        out += fmt::format("SCALARS {} double\nLOOKUP_TABLE default\n", field.name);
      } else if (field.components == 3) {
        out += fmt::format("VECTORS {} double\n", field.name);
      } else {
        out += fmt::format("FIELD FieldData 1\n{} {} {} double\n", field.name, field.components, items);
      }
      put(field.values);
    }
  };
  put_fields(mesh.point_fields, "POINT_DATA", static_cast<std::size_t>(cells.positions.cols()));
  put_fields(mesh.cell_fields, "CELL_DATA", cells.cell_count());
  return out;
}

inline std::string base64(const std::string& bytes) {
  constexpr const char* k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits * 256 + (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? k_digits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

struct VtuStyle {
  enum class Place { ascii, inline_base64, appended_raw, appended_base64 } place = Place::ascii;
  bool compressed = false;
  bool big_endian = false;
  bool wide_headers = false;
  bool narrow_numbers = false;  // Int32 instead of Int64
  std::size_t block = 64;       // small, so that arrays take several blocks
};

/// VTU as `style` says. Fields are written as Float64.
class VtuEncoder {
 public:
  explicit VtuEncoder(VtuStyle style) : style_(style) {}

  std::string encode(const VolumeMesh& mesh) {
    const auto& cells = mesh.cells;
    xml_ = fmt::format(
        "<?xml version=\"1.0\"?>\n<!-- by another hand -->\n<VTKFile type=\"UnstructuredGrid\" version=\"{}\" "
        "byte_order=\"{}\"{}{}>\n"
        "<UnstructuredGrid><Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        style_.wide_headers ? "1.0" : "0.1", style_.big_endian ? "BigEndian" : "LittleEndian",
        style_.wide_headers ? " header_type=\"UInt64\"" : "",
        style_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "", cells.positions.cols(),
        cells.cell_count());
    const auto put_fields = [&](const char* name, const std::vector<NamedField>& fields) {
      xml_ += fmt::format("<{}>\n", name);
      for (const NamedField& field : fields) array(field.name, "Float64", field.components, field.values);
      xml_ += fmt::format("</{}>\n", name);
    };
    put_fields("PointData", mesh.point_fields);
    put_fields("CellData", mesh.cell_fields);
    xml_ += "<Points>\n";
    array("Points", "Float64", 3, flat_positions(mesh));
    xml_ += "</Points>\n<Cells>\n";
    std::vector<std::int64_t> connectivity, offsets, faces, face_offsets;
    std::vector<std::uint8_t> types;
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
      const bool polyhedron = cells.kinds[c] == subdiv::CellKind::polyhedron;
      auto& target = polyhedron ? faces : connectivity;
      for (std::size_t i = cells.offsets[c]; i < cells.offsets[c + 1]; ++i) target.push_back(cells.connectivity[i]);
      if (polyhedron) {
        std::vector<std::int64_t> used;
        for (std::size_t i = cells.offsets[c] + 1; i < cells.offsets[c + 1]; i += 1 + cells.connectivity[i]) {
          for (std::size_t k = 1; k <= cells.connectivity[i]; ++k) used.push_back(cells.connectivity[i + k]);
        }
        std::sort(used.begin(), used.end());
        connectivity.insert(connectivity.end(), used.begin(), std::unique(used.begin(), used.end()));
      }
      face_offsets.push_back(polyhedron ? static_cast<std::int64_t>(faces.size()) : -1);
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      types.push_back(static_cast<std::uint8_t>(type_number(cells.kinds[c])));
    }
    integers("connectivity", connectivity);
    integers("offsets", offsets);
    array("types", "UInt8", 1, types);
    if (!faces.empty()) {
      integers("faces", faces);
      integers("faceoffsets", face_offsets);
    }
    xml_ += "</Cells>\n</Piece></UnstructuredGrid>\n";
    if (!appended_.empty()) {
      const bool raw = style_.place == VtuStyle::Place::appended_raw;
      xml_ += fmt::format("<AppendedData encoding=\"{}\">\n _", raw ? "raw" : "base64") + appended_ +
              "\n</AppendedData>\n";
    }
    return xml_ + "</VTKFile>\n";
  }

 private:
  void integers(const char* name, const std::vector<std::int64_t>& values) {
    if (style_.narrow_numbers) {
      array(name, "Int32", 1, std::vector<std::int32_t>(values.begin(), values.end()));
    } else {
      array(name, "Int64", 1, values);
    }
  }

  template <class T>
  void array(const std::string& name, const char* type, int components, const std::vector<T>& values) {
    using Place = VtuStyle::Place;
    const bool appended = style_.place == Place::appended_raw || style_.place == Place::appended_base64;
    xml_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"{}\"", type, name,
                        components,
                        style_.place == Place::ascii ? "ascii"
                        : appended                   ? "appended"
                                                     : "binary");
    if (appended) {
      xml_ += fmt::format(" offset=\"{}\"/>\n", appended_.size());
      appended_ += block(bytes_of(values, style_.big_endian));
    } else {
      xml_ +=
          ">\n  " + (style_.place == Place::ascii ? text_of(values) : block(bytes_of(values, style_.big_endian)));
      xml_ += "\n  <InformationKey name=\"L2\" location=\"x\"/>\n</DataArray>\n";
    }
  }

  std::string header(const std::vector<std::uint64_t>& words) const {
    if (style_.wide_headers) return bytes_of(words, style_.big_endian);
    return bytes_of(std::vector<std::uint32_t>(words.begin(), words.end()), style_.big_endian);
  }

  std::string block(const std::string& bytes) const {
    const bool raw = style_.place == VtuStyle::Place::appended_raw;
    if (!style_.compressed) {
      const std::string all = header({bytes.size()}) + bytes;
      return raw ? all : base64(all);
    }
    std::vector<std::uint64_t> words{(bytes.size() + style_.block - 1) / style_.block, style_.block,
                                     bytes.size() % style_.block};
    std::string packed;
    for (std::size_t at = 0; at < bytes.size(); at += style_.block) {
      const std::string part = bytes.substr(at, style_.block);
      uLongf size = compressBound(part.size());
      std::string one(size, '\0');
      compress(reinterpret_cast<Bytef*>(one.data()), &size, reinterpret_cast<const Bytef*>(part.data()),
               part.size());
      packed += one.substr(0, size);
      words.push_back(size);
    }
    return raw ? header(words) + packed : base64(header(words)) + base64(packed);
  }

  VtuStyle style_;
  std::string xml_, appended_;
};

}  // namespace argil::io::test
