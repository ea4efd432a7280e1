#include "io/vtu_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

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
}  // namespace

VtuDocument::VtuDocument(std::string_view bytes, std::string_view name) : bytes_(bytes), positions_(bytes, name) {
  split_off_appended_data();
  root_ = parse();
  read_header(root_);
}

void VtuDocument::finish_appended_data() const {
  if (appended_.find_first_not_of(k_blanks, appended_used_) == std::string_view::npos) return;
  fail_at(appended_begin_ + appended_used_, "expected the end of the appended data, found more bytes");
}

void VtuDocument::fail_at(std::size_t offset, const std::string& message, ErrorCode code) const {
  throw Error(code, message, positions_.where(offset));
}

std::size_t VtuDocument::offset_of(const char* in_buffer) const {
  return static_cast<std::size_t>(in_buffer - buffer_.data());
}

// Nodes that this reader knows have names; the name stands in the buffer.
std::size_t VtuDocument::offset_of(xml_node node) const {
  return node.name()[0] != '\0' ? offset_of(node.name()) : offset_of(node.value());
}

void VtuDocument::fail(xml_node node, const std::string& message, ErrorCode code) const {
  fail_at(offset_of(node), message, code);
}

// Appended data may be raw bytes and so no XML; the parser sees the element empty.
void VtuDocument::split_off_appended_data() {
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

xml_node VtuDocument::parse() {
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

void VtuDocument::read_header(xml_node file) {
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

xml_node VtuDocument::only_child(xml_node parent, const char* name) const {
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

std::string_view VtuDocument::expect_attribute(xml_node node, const char* name,
                                               std::initializer_list<std::string_view> allowed,
                                               ErrorCode code) const {
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

std::size_t VtuDocument::size_attribute(xml_node node, const char* name) const {
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

NumberType VtuDocument::type_of(xml_node array) const {
  const std::string_view name = array.attribute("type").value();
  for (const TypeName& known : k_types) {
    if (known.name == name) return known.type;
  }
  fail(array,
       fmt::format("arrays of type {} are not held; expected Int8 … UInt64, Float32 or Float64", in_quotes(name)),
       ErrorCode::unsupported);
}

std::size_t VtuDocument::components_of(xml_node array) const {
  if (!array.attribute("NumberOfComponents")) return 1;
  const std::size_t components = size_attribute(array, "NumberOfComponents");
  if (components < 1 || components > 1 << 20) {
    fail(array, fmt::format("expected NumberOfComponents from 1 to {}, found {}", 1 << 20, components));
  }
  return components;
}

// The array's own text, which may stand beside InformationKey elements.
TextCursor VtuDocument::text_of(xml_node array) const {
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

std::size_t VtuDocument::checked_count(xml_node array, std::size_t items, std::size_t components,
                                       const TextCursor& text) {
  const bool ascii = is_ascii(array);
  const std::size_t bytes = type_of(array).bytes;
  // Arrays that share appended data must not multiply it: all together are held to what the file can unpack to.
  const std::size_t unpacked = bytes_.size() * (compressed_ ? k_deflate_growth : 1);
  const std::size_t most = ascii ? text.remaining() / 2 + 1 : (unpacked - unpacked_used_) / bytes;
  if (items > most / components) {
    fail(array, fmt::format("expected {} × {} numbers, more than the array can hold; was the file cut short?",
                            items, components));
  }
  if (!ascii) unpacked_used_ += items * components * bytes;
  return items * components;
}

bool VtuDocument::is_ascii(xml_node array) const {
  return expect_attribute(array, "format", {"ascii", "binary", "appended"}) == "ascii";
}

std::string VtuDocument::binary(xml_node array, std::size_t size, const TextCursor& text) {
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

NumberFault VtuDocument::number_fault(xml_node array) const {
  return [this, array](std::size_t index, const std::string& message) {
    fail(array, fmt::format("number {} of the array: {}", index, message));
  };
}

std::vector<double> VtuDocument::doubles(xml_node array, std::size_t items, std::size_t components) {
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

VtuDocument::Integers VtuDocument::integers(xml_node array, std::size_t count) {
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

xml_node VtuDocument::named_array(xml_node parent, std::string_view name) const {
  xml_node found;
  for (const xml_node node : parent.children("DataArray")) {
    if (name != node.attribute("Name").value()) continue;
    if (found) fail(node, fmt::format("two arrays have the name {}", in_quotes(name)));
    found = node;
  }
  return found;
}

}  // namespace argil::io
