#include "sculpt/paths.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/error.h"

namespace argil::sculpt {

namespace fs = std::filesystem;

fs::path path_beneath(const fs::path& root, const std::string& name, const std::string& what) {
  const auto refuse = [&](const char* why) {
    std::string shown = name;
    std::replace(shown.begin(), shown.end(), '\0', '?');  // a message must not end there
    throw Error(ErrorCode::refused,
                fmt::format("'{}' {}; a session reaches only files beneath {}", shown, why, what));
  };
  const fs::path relative(name);
  if (name.empty() || name.find('\0') != std::string::npos) refuse("is not a file name");
  if (relative.is_absolute()) refuse("is an absolute path");
  for (const fs::path& part : relative)
    if (part == "..") refuse("climbs out with '..'");
  std::error_code failure;
  fs::path base = fs::weakly_canonical(root.empty() ? fs::path(".") : root, failure);
  if (failure) refuse("has no folder to stand in");
  if (!base.has_filename() && base.has_relative_path())
    base = base.parent_path();  // "folder/" that is not there yet
  const fs::path path = fs::weakly_canonical(base / relative, failure);
  if (failure) refuse("cannot be followed");
  const auto differs = std::mismatch(base.begin(), base.end(), path.begin(), path.end());
  if (differs.first != base.end()) refuse("leads out through a symbolic link");
  // A link whose target does not exist yet is not followed by weakly_canonical, but opening it for writing would.
  fs::path step = base;
  for (const fs::path& part : relative) {
    step /= part;
    if (fs::is_symlink(fs::symlink_status(step, failure)) && !fs::exists(step, failure))
      refuse("is a dangling link");
  }
  return path;
}

}  // namespace argil::sculpt
