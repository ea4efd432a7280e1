#pragma once
// A folder for what the tests of files write.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace argil::io::test {

inline std::filesystem::path scratch(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "argil_io";
  std::filesystem::create_directories(folder);
  return folder / name;
}

}  // namespace argil::io::test
