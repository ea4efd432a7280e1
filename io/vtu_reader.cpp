#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <pugixml.hpp>

#include "io/number_type.h"
#include "io/text_cursor.h"
#include "io/vtk_cells.h"
#include "io/vtu.h"
#include "io/vtu_blocks.h"

namespace argil::io {
namespace {

using Kind = NumberType::Kind;
using pugi::xml_node;

struct TypeName {
  std::string_view name;
  NumberType type;
};
constexpr std::array k_types{
    TypeName{"Int8", {Kind::signed_integer, 1}},  TypeName{"UInt8", {Kind::unsigned_integer, 1}},
    TypeName{"Int16", {Kind::signed_integer, 2}}, TypeName{"UInt16", {Kind::unsigned_integer, 2}},
    TypeName{"Int32", {Kind::signed_integer, 4}}, TypeName{"UInt32", {Kind::unsigned_integer, 4}},
    TypeName{"Int64", {Kind::signed_integer, 8}}, TypeName{"UInt64", {Kind::unsigned_integer, 8}},
    TypeName{"Float32", {Kind::floating, 4}},     TypeName{"Float64", {Kind::floating, 8}}};
constexpr std::string_view k_open_appended = "<AppendedData", k_close_appended = "</AppendedData>",
                           k_close_file = "</VTKFile>";
constexpr std::string_view k_blanks = " \t\r\n";

class Reader {
 public:
  Reader(std::string_view bytes, std::string_view name) : bytes_(bytes), positions_(bytes, name) {}

  VolumeMesh read() {
    split_off_appended_data();
    const xml_node file = parse();
    read_header(file);
    const xml_node grid = only_child(file, "UnstructuredGrid");
    const xml_node piece = only_child(grid, "Piece");
    const std::size_t points = size_attribute(piece, "NumberOfPoints");
    const std::size_t cells = size_attribute(piece, "NumberOfCells");
    for (const xml_node node : piece.children()) {
      const std::string_view name = node.name();
      if (name != "Points" && name != "Cells" && name != "PointData" && name != "CellData" && name != "FieldData") {
        fail(node,
             fmt::format("expected Points, Cells, PointData or CellData in a Piece, found {}", in_quotes(name)));
      }
    }
    read_points(only_child(piece, "Points"), points);
    read_cells(only_child(piece, "Cells"), cells);
    read_fields(piece, "PointData", points, mesh_.point_fields);
    read_fields(piece, "CellData", cells, mesh_.cell_fields);
    // FieldData, which is passed over, may have its own share of the appended data.
    if (!file.child("FieldData") && !grid.child("FieldData") && !piece.child("FieldData") &&
        appended_.find_first_not_of(k_blanks, appended_used_) != std::string_view::npos) {
      fail_at(appended_begin_ + appended_used_, "expected the end of the appended data, found more bytes");
    }
    if (cells == 0) fail(piece, "the file has no cells; expected at least one");
    return std::move(mesh_);
  }

 private:
  struct Integers {
    std::vector<std::int64_t> values;
    std::function<std::string(std::size_t)> where;
  };

  [[noreturn]] void fail_at(std::size_t offset, const std::string& message,
                            ErrorCode code = ErrorCode::bad_input) const {
    throw Error(code, message, positions_.where(offset));
  }
  std::size_t offset_of(const char* in_buffer) const {
    return static_cast<std::size_t>(in_buffer - buffer_.data());
  }
  // Nodes that this reader knows have names; the name stands in the buffer.
  std::size_t offset_of(xml_node node) const {
    return node.name()[0] != '\0' ? offset_of(node.name()) : offset_of(node.value());
  }
  [[noreturn]] void fail(xml_node node, const std::string& message, ErrorCode code = ErrorCode::bad_input) const {
    fail_at(offset_of(node), message, code);
  }

  // Appended data may be raw bytes and so no XML; the parser sees the element empty.
  void split_off_appended_data() {
    const std::size_t file_end = bytes_.rfind(k_close_file);
    const std::size_t last = bytes_.find_last_not_of(k_blanks);
    if (file_end == std::string_view::npos)
      fail_at(bytes_.size(), "expected </VTKFile>, found none; was the file cut short?");
    if (last != file_end + k_close_file.size() - 1) {
      fail_at(file_end + k_close_file.size(), "expected nothing after </VTKFile>");
    }
    const std::size_t open = bytes_.find(k_open_appended);
    if (open == std::string_view::npos) {
      buffer_ = bytes_;
      return;
    }
    const std::size_t start = bytes_.find('>', open), stop = bytes_.rfind(k_close_appended);
    if (stop == std::string_view::npos || start > stop)
      fail_at(open, "expected </AppendedData>, found none; was the file cut short?");
    if (bytes_.find_first_not_of(k_blanks, stop + k_close_appended.size()) != file_end) {
      fail_at(stop, "expected </VTKFile> after </AppendedData>");
    }
    const std::size_t mark = bytes_.find_first_not_of(k_blanks, start + 1);
    if (bytes_[mark] != '_') fail_at(mark, "expected the mark _ before the appended data");
    appended_begin_ = mark + 1;
    appended_ = bytes_.substr(mark + 1, stop - mark - 1);
    buffer_ = std::string(bytes_.substr(0, start + 1)) + std::string(k_close_appended) + std::string(k_close_file);
  }

  xml_node parse() {
    for (const std::string_view banned : {std::string_view("<!DOCTYPE"), std::string_view("\0", 1)}) {
      const std::size_t at = buffer_.find(banned);
      if (at != std::string::npos) fail_at(at, "expected plain XML, found a document type or a zero byte");
    }
    const auto result = document_.load_buffer_inplace(
        buffer_.data(), buffer_.size(), pugi::parse_minimal | pugi::parse_escapes | pugi::parse_fragment,
        pugi::encoding_utf8);
    if (!result) {
      fail_at(static_cast<std::size_t>(result.offset),
              fmt::format("expected well-formed XML: {}", result.description()));
    }
    return only_child(document_, "VTKFile");
  }

  void read_header(xml_node file) {
    expect_attribute(file, "type", {"UnstructuredGrid"});
    big_endian_ = expect_attribute(file, "byte_order", {"LittleEndian", "BigEndian"}) == "BigEndian";
    if (file.attribute("header_type")) {
      header_bytes_ = expect_attribute(file, "header_type", {"UInt32", "UInt64"}) == "UInt64" ? 8 : 4;
    }
    if (file.attribute("compressor")) {
      expect_attribute(file, "compressor", {"vtkZLibDataCompressor"}, ErrorCode::unsupported);
      compressed_ = true;
    }
    for (const xml_node node : file.children()) {
      const std::string_view name = node.name();
      if (name == "AppendedData") {
        appended_base64_ = expect_attribute(node, "encoding", {"raw", "base64"}) == "base64";
      } else if (name != "UnstructuredGrid" && name != "FieldData") {
        fail(node, fmt::format("expected UnstructuredGrid or AppendedData, found {}", in_quotes(name)));
      }
    }
  }

  xml_node only_child(xml_node parent, const char* name) const {
    xml_node found;
    for (const xml_node node : parent.children()) {
      const bool same = std::string_view(node.name()) == name;
      // Within the document itself nothing else may stand.
      if (node.type() != pugi::node_element || (parent == document_ && !same)) {
        fail(node, fmt::format("expected the element {}, found something else", name));
      }
      if (!same) continue;
      if (found) fail(node, fmt::format("expected one {}, found several; join them into one", name));
      found = node;
    }
    if (found) return found;
    if (parent == document_) fail_at(0, fmt::format("expected the element {}, found none", name));
    fail(parent, fmt::format("expected the element {} within {}, found none", name, parent.name()));
  }

  std::string_view expect_attribute(xml_node node, const char* name,
                                    std::initializer_list<std::string_view> allowed,
                                    ErrorCode code = ErrorCode::bad_input) const {
    const pugi::xml_attribute attribute = node.attribute(name);
    const std::string_view value = attribute.value();
    if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
    std::string list;
    for (const std::string_view one : allowed) list += (list.empty() ? "" : " or ") + std::string(one);
    const std::string message =
        fmt::format("expected {}=\"{}\", found {}", name, list, attribute ? in_quotes(value) : "none");
    if (attribute && !value.empty()) fail_at(offset_of(attribute.value()), message, code);
    fail(node, message, code);
  }

  std::size_t size_attribute(xml_node node, const char* name) const {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) fail(node, fmt::format("expected the attribute {}, found none", name));
    const std::string_view value = attribute.value();
    if (value.empty()) fail(node, fmt::format("expected a number for {}, found nothing", name));
    const std::size_t begin = offset_of(attribute.value());
    TextCursor cursor(bytes_, positions_.file(), begin, begin + value.size());
    const auto number = cursor.integer(name, 0, std::numeric_limits<std::int64_t>::max());
    cursor.finish();
    return static_cast<std::size_t>(number);
  }

  NumberType type_of(xml_node array) const {
    const std::string_view name = array.attribute("type").value();
    for (const TypeName& known : k_types) {
      if (known.name == name) return known.type;
    }
    fail(array,
         fmt::format("arrays of type {} are not held; expected Int8 … UInt64, Float32 or Float64", in_quotes(name)),
         ErrorCode::unsupported);
  }

  std::size_t components_of(xml_node array) const {
    if (!array.attribute("NumberOfComponents")) return 1;
    const std::size_t components = size_attribute(array, "NumberOfComponents");
    if (components < 1 || components > 1 << 20) {
      fail(array, fmt::format("expected NumberOfComponents from 1 to {}, found {}", 1 << 20, components));
    }
    return components;
  }

  // The array's own text, which may stand beside InformationKey elements.
  TextCursor text_of(xml_node array) const {
    std::size_t begin = offset_of(array), end = begin;
    for (const xml_node node : array.children()) {
      if (node.type() == pugi::node_element) {
        if (std::string_view(node.name()) == "InformationKey") continue;
        fail(node, fmt::format("expected numbers, found the element {}", in_quotes(node.name())));
      }
      if (end != begin) fail(node, "the numbers of the array are interrupted");
      begin = offset_of(node.value());
      end = begin + std::string_view(node.value()).size();
    }
    return {bytes_, positions_.file(), begin, end};
  }

  std::size_t checked_count(xml_node array, std::size_t items, std::size_t components,
                            const TextCursor& text) const {
    const bool ascii = is_ascii(array);
    const std::size_t growth = compressed_ ? 1032 : 1;
    const std::size_t most = ascii ? text.remaining() / 2 + 1 : bytes_.size() * growth / type_of(array).bytes;
    if (items > most / components) {
      fail(array, fmt::format("{} × {} numbers cannot be in this file; was it cut short?", items, components));
    }
    return items * components;
  }

  bool is_ascii(xml_node array) const {
    return expect_attribute(array, "format", {"ascii", "binary", "appended"}) == "ascii";
  }

  std::string binary(xml_node array, std::size_t size, const TextCursor& text) {
    const auto fault = [&](const std::string& message) { fail(array, message); };
    VtuEncoding encoding{true, compressed_, big_endian_, header_bytes_};
    if (std::string_view(array.attribute("format").value()) == "appended") {
      encoding.base64 = appended_base64_;
      const std::size_t offset = size_attribute(array, "offset");
      if (offset > appended_.size()) {
        fail(array, fmt::format("the offset {} is beyond the {} bytes of appended data", offset, appended_.size()));
      }
      VtuBlock block = decode_vtu_block(appended_.substr(offset), encoding, size, fault);
      appended_used_ = std::max(appended_used_, offset + block.consumed);
      return std::move(block.bytes);
    }
    const std::string_view encoded = bytes_.substr(text.offset(), text.remaining());
    if (size == 0 && encoded.find_first_not_of(k_blanks) == std::string_view::npos) return {};
    VtuBlock block = decode_vtu_block(encoded, encoding, size, fault);
    if (encoded.find_first_not_of(k_blanks, block.consumed) != std::string_view::npos) {
      fail(array, "the array holds more bytes than expected");
    }
    return std::move(block.bytes);
  }

  NumberFault number_fault(xml_node array) const {
    return [this, array](std::size_t index, const std::string& message) {
      fail(array, fmt::format("number {} of the array: {}", index, message));
    };
  }

  std::vector<double> doubles(xml_node array, std::size_t items, std::size_t components) {
    TextCursor text = text_of(array);
    const NumberType type = type_of(array);
    const std::size_t count = checked_count(array, items, components, text);
    if (!is_ascii(array)) {
      return decode_doubles(binary(array, count * type.bytes, text), type, big_endian_, number_fault(array));
    }
    std::vector<double> values(count);
    for (double& value : values) value = text.number("a number");
    text.finish();
    return values;
  }

  Integers integers(xml_node array, std::size_t count) {
    TextCursor text = text_of(array);
    const NumberType type = type_of(array);
    checked_count(array, count, 1, text);
    if (!is_ascii(array)) {
      return {decode_integers(binary(array, count * type.bytes, text), type, big_endian_, number_fault(array)),
              [this, array](std::size_t) { return positions_.where(offset_of(array)); }};
    }
    Integers out{std::vector<std::int64_t>(count), {}};
    out.where = [text](std::size_t i) { return text.where_word(text.offset(), i); };
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    for (auto& value : out.values) value = text.integer("an integer", -most, most);
    text.finish();
    return out;
  }

  void read_points(xml_node points, std::size_t count) {
    const xml_node array = only_child(points, "DataArray");
    if (components_of(array) != 3) fail(array, "expected points with NumberOfComponents=\"3\"");
    const std::vector<double> values = doubles(array, count, 3);
    mesh_.cells.positions = Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, static_cast<Eigen::Index>(count));
  }

  xml_node named_array(xml_node parent, std::string_view name) const {
    xml_node found;
    for (const xml_node node : parent.children("DataArray")) {
      if (name != node.attribute("Name").value()) continue;
      if (found) fail(node, fmt::format("two arrays have the name {}", in_quotes(name)));
      found = node;
    }
    return found;
  }
  xml_node needed_array(xml_node parent, std::string_view name) const {
    const xml_node found = named_array(parent, name);
    if (!found) fail(parent, fmt::format("expected an array named {}, found none", name));
    return found;
  }

  void check_offset(const Integers& offsets, std::size_t cell, std::int64_t least) const {
    if (offsets.values[cell] >= least) return;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("cell {}: expected an offset of at least {}, found {}", cell, least, offsets.values[cell]),
        offsets.where(cell));
  }

  void read_cells(xml_node node, std::size_t count) {
    constexpr std::array<std::string_view, 5> k_names{"connectivity", "offsets", "types", "faces", "faceoffsets"};
    for (const xml_node array : node.children()) {
      const std::string_view name = array.attribute("Name").value();
      if (std::find(k_names.begin(), k_names.end(), name) != k_names.end()) continue;
      fail(array,
           fmt::format(
               "the array {} of Cells is not held; expected connectivity, offsets, types, faces or faceoffsets",
               in_quotes(name)),
           ErrorCode::unsupported);
    }
    Integers types = integers(needed_array(node, "types"), count);
    const Integers offsets = integers(needed_array(node, "offsets"), count);
    for (std::size_t c = 0; c < count; ++c) check_offset(offsets, c, c == 0 ? 0 : offsets.values[c - 1]);
    const auto size = static_cast<std::size_t>(count == 0 ? 0 : offsets.values.back());
    const Integers connectivity = integers(needed_array(node, "connectivity"), size);

    const bool polyhedra =
        std::count(types.values.begin(), types.values.end(), vtk_type(subdiv::CellKind::polyhedron)) > 0;
    Integers face_offsets, faces;
    if (polyhedra) {
      face_offsets = integers(needed_array(node, "faceoffsets"), count);
      std::int64_t end = 0;
      for (std::size_t c = 0; c < count; ++c) {
        if (types.values[c] != vtk_type(subdiv::CellKind::polyhedron)) continue;
        check_offset(face_offsets, c, end);
        end = face_offsets.values[c];
      }
      faces = integers(needed_array(node, "faces"), static_cast<std::size_t>(end));
    }
    join_cells(std::move(types), offsets, connectivity, face_offsets, faces);
  }

  void join_cells(Integers types, const Integers& offsets, const Integers& connectivity,
                  const Integers& face_offsets, const Integers& faces) {
    struct Origin {
      const Integers* numbers;
      std::size_t begin;
    };
    VtkCells cells;
    std::vector<Origin> origins;
    std::size_t face_begin = 0;
    for (std::size_t c = 0; c < types.values.size(); ++c) {
      const bool polyhedron = types.values[c] == vtk_type(subdiv::CellKind::polyhedron);
      const Integers& source = polyhedron ? faces : connectivity;
      const std::size_t begin = polyhedron ? face_begin
                                : c == 0   ? 0
                                           : static_cast<std::size_t>(offsets.values[c - 1]);
      const auto end = static_cast<std::size_t>((polyhedron ? face_offsets : offsets).values[c]);
      if (polyhedron) face_begin = end;
      cells.connectivity.insert(cells.connectivity.end(),
                                source.values.begin() + static_cast<std::ptrdiff_t>(begin),
                                source.values.begin() + static_cast<std::ptrdiff_t>(end));
      cells.offsets.push_back(cells.connectivity.size());
      origins.push_back({&source, begin});
    }
    cells.types = std::move(types.values);
    cells.where_type = types.where;
    cells.where_number = [&](std::size_t i) {
      const auto next = std::upper_bound(cells.offsets.begin(), cells.offsets.end(), i) - cells.offsets.begin();
      const std::size_t cell = std::min(static_cast<std::size_t>(next), origins.size()) - 1;
      return origins[cell].numbers->where(origins[cell].begin + i - cells.offsets[cell]);
    };
    append_vtk_cells(cells, mesh_.cells);
    for (std::size_t c = 0; c < cells.types.size(); ++c) {
      if (mesh_.cells.kinds[c] == subdiv::CellKind::polyhedron) check_polyhedron(c, offsets, connectivity);
    }
  }

  // The connectivity of a polyhedron lists the vertices of its faces.
  void check_polyhedron(std::size_t cell, const Integers& offsets, const Integers& connectivity) const {
    const auto begin = cell == 0 ? 0 : offsets.values[cell - 1];
    std::vector<std::int64_t> listed(connectivity.values.begin() + begin,
                                     connectivity.values.begin() + offsets.values[cell]);
    std::vector<std::int64_t> used;
    for (std::size_t at = mesh_.cells.offsets[cell] + 1; at < mesh_.cells.offsets[cell + 1];) {
      const std::size_t corners = mesh_.cells.connectivity[at++];
      for (std::size_t i = 0; i < corners; ++i) used.push_back(mesh_.cells.connectivity[at++]);
    }
    for (auto* list : {&listed, &used}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    if (listed != used) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("polyhedron {}: its vertices in connectivity are not those of its faces", cell),
                  connectivity.where(static_cast<std::size_t>(begin)));
    }
  }

  void read_fields(xml_node piece, const char* name, std::size_t items, std::vector<NamedField>& fields) {
    if (!piece.child(name)) return;
    for (const xml_node array : only_child(piece, name).children()) {
      if (std::string_view(array.name()) != "DataArray") {
        fail(array,
             fmt::format("the element {} is not held in {}; remove it or write it as a numeric DataArray",
                         in_quotes(array.name()), name),
             ErrorCode::unsupported);
      }
      NamedField field;
      field.name = array.attribute("Name").value();
      if (field.name.empty()) fail(array, "expected a Name for the array, found none");
      if (named_array(array.parent(), field.name) != array) fail(array, "two arrays have the same name");
      const std::size_t components = components_of(array);
      field.components = static_cast<int>(components);
      field.values = doubles(array, items, components);
      fields.push_back(std::move(field));
    }
  }

  std::string_view bytes_, appended_;
  TextCursor positions_;
  std::string buffer_;  // the XML, which the parser changes in place
  pugi::xml_document document_;
  VolumeMesh mesh_;
  std::size_t appended_begin_ = 0, appended_used_ = 0, header_bytes_ = 4;
  bool big_endian_ = false, compressed_ = false, appended_base64_ = false;
};

}  // namespace

VolumeMesh read_vtu(std::string_view bytes, std::string_view name) {
  return Reader(bytes, name).read();
}

}  // namespace argil::io
