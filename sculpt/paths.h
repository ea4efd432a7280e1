#pragma once
// What a session may reach: files beneath one folder, with symbolic links that lead out of it refused.

#include <filesystem>
#include <string>

namespace argil::sculpt {

/// The path of `name` beneath `root`. @throws Error (refused) for an absolute name, one that climbs out with "..",
/// or one whose links lead out; `what` names the root in the message.
[[nodiscard]] std::filesystem::path path_beneath(const std::filesystem::path& root, const std::string& name,
                                                 const std::string& what);

}  // namespace argil::sculpt
