#pragma once
// The XML of a VTU file and its arrays in every encoding, with the place of every fault. The XML is parsed without
// entities or document types; appended data, which may be raw bytes, is kept from the parser.

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/number_type.h"
#include "io/text_cursor.h"

namespace argil::io {

class VtuDocument {
 public:
  struct Integers {
    std::vector<std::int64_t> values;
    std::function<std::string(std::size_t)> where;  // of a value; valid as long as the document
  };

  /// `bytes` must outlive the document. @throws Error (bad_input, unsupported) as all that follow.
  VtuDocument(std::string_view bytes, std::string_view name);
  VtuDocument(const VtuDocument&) = delete;
  VtuDocument& operator=(const VtuDocument&) = delete;

  pugi::xml_node root() const { return root_; }
  /// The one child element of that name.
  pugi::xml_node only_child(pugi::xml_node parent, const char* name) const;
  /// The DataArray of that name, or none.
  pugi::xml_node named_array(pugi::xml_node parent, std::string_view name) const;
  /// An attribute that is a number ≥ 0.
  std::size_t size_attribute(pugi::xml_node node, const char* name) const;
  std::size_t components_of(pugi::xml_node array) const;

  /// The items × components numbers of a DataArray, neither more nor fewer.
  std::vector<double> doubles(pugi::xml_node array, std::size_t items, std::size_t components);
  Integers integers(pugi::xml_node array, std::size_t count);
  /// Fails if bytes of the appended data follow the last array that was read.
  void finish_appended_data() const;

  [[noreturn]] void fail(pugi::xml_node node, const std::string& message,
                         ErrorCode code = ErrorCode::bad_input) const;

 private:
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message,
                            ErrorCode code = ErrorCode::bad_input) const;
  std::size_t offset_of(const char* in_buffer) const;
  std::size_t offset_of(pugi::xml_node node) const;
  void split_off_appended_data();
  pugi::xml_node parse();
  void read_header(pugi::xml_node file);
  std::string_view expect_attribute(pugi::xml_node node, const char* name,
                                    std::initializer_list<std::string_view> allowed,
                                    ErrorCode code = ErrorCode::bad_input) const;
  NumberType type_of(pugi::xml_node array) const;
  TextCursor text_of(pugi::xml_node array) const;
  std::size_t checked_count(pugi::xml_node array, std::size_t items, std::size_t components,
                            const TextCursor& text);
  bool is_ascii(pugi::xml_node array) const;
  std::string binary(pugi::xml_node array, std::size_t size, const TextCursor& text);
  NumberFault number_fault(pugi::xml_node array) const;

  std::string_view bytes_, appended_;
  TextCursor positions_;
  std::string buffer_;  // the XML, which the parser changes in place
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::size_t appended_begin_ = 0, appended_used_ = 0, unpacked_used_ = 0, header_bytes_ = 4;
  bool big_endian_ = false, compressed_ = false, appended_base64_ = false;
};

}  // namespace argil::io
