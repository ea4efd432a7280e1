#pragma once
// The one exception type for what a user, a file or a session can cause. What only our own bug can cause is an
// assert.

#include <stdexcept>
#include <string>
#include <utility>

namespace argil {

enum class ErrorCode {
  bad_input,       // a malformed file, session or argument
  not_found,       // a file, name, command or element that is not there
  bad_topology,    // cells that do not make a solid
  bad_geometry,    // inverted or degenerate cells, non-finite coordinates
  unsupported,     // something that a format or method cannot hold or do
  limit_exceeded,  // beyond --max-cells, --max-steps, --max-memory
  not_converged,   // a solver stopped short
  refused          // outside what a session may reach
};

/// `message` says what was expected, what was found and what to do; `where` the place ("file:line:column", "cell
/// 12").
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, std::string where = {})
      : std::runtime_error(message), code_(code), where_(std::move(where)) {}
  ErrorCode code() const { return code_; }
  const std::string& where() const { return where_; }

 private:
  ErrorCode code_;
  std::string where_;
};

}  // namespace argil
