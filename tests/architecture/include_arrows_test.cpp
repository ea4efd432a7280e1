// The arrows of DESIGN.md, read from the #include lines: rooms include only rooms below them, and large third-party
// libraries stay behind the one door that each has.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace argil {
namespace {

constexpr std::array<std::string_view, 5> k_rooms = {"subdiv", "fem", "io", "sculpt",
                                                     "tools"};  // from the ground up

struct Include {
  std::string from;  // file, relative to the source folder
  std::string what;  // between the quotes or angle brackets
  bool quoted = false;
};

std::string_view room_of(std::string_view path) {
  return path.substr(0, path.find('/'));
}

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> starts) {
  return std::any_of(starts.begin(), starts.end(), [&](std::string_view start) { return text.starts_with(start); });
}

/// What is wrong with an include, or nothing.
std::string fault_of(const Include& include) {
  const std::string_view from = include.from, what = include.what;
  const auto rank = [](std::string_view room) {
    return std::find(k_rooms.begin(), k_rooms.end(), room) - k_rooms.begin();
  };
  if (rank(room_of(what)) < static_cast<std::ptrdiff_t>(k_rooms.size()) && what.find('/') != what.npos) {
    if (rank(room_of(what)) > rank(room_of(from))) return "points upwards";
    if (from.starts_with("tools/view/") && what.starts_with("tools/") && !what.starts_with("tools/view/"))
      return "tools/view serves the other tools and must not know them";
    if (from.starts_with("tools/studio/") && what.starts_with("tools/") && !what.starts_with("tools/studio/") &&
        !what.starts_with("tools/view/"))
      return "tools/studio is built on tools/view alone";
    if (what.starts_with("tools/studio/") &&
        !starts_with_any(from, {"tools/studio/", "tools/argil/studio.cpp", "tools/argil/bench_studio.cpp"}))
      return "only the program opens the studio";
  } else if (include.quoted) {
    return "must be \"room/file.h\" from the source folder, or in <> if it is of others";
  }
  const bool in_tools = from.starts_with("tools/");
  if (starts_with_any(what, {"GLFW/", "imgui"}) && in_tools && !from.starts_with("tools/studio/"))
    return "belongs to tools/studio/ only";
  if (starts_with_any(what, {"GL/", "GLES", "GLFW/", "EGL/", "imgui", "CLI/"}) && !in_tools)
    return "belongs to tools/ only";
  if (what.starts_with("CGAL/") && !from.starts_with("subdiv/query/")) return "belongs to subdiv/query/ only";
  if (starts_with_any(what, {"gtest/", "gmock/", "benchmark/"})) return "belongs to tests and benchmarks only";
  return {};
}

std::vector<Include> includes_of(const std::filesystem::path& file, const std::string& name) {
  std::vector<Include> includes;
  std::ifstream source(file);
  for (std::string line; std::getline(source, line);) {
    const auto hash = line.find_first_not_of(" \t");
    if (hash == line.npos || line[hash] != '#') continue;
    const auto word = line.find_first_not_of(" \t", hash + 1);
    if (word == line.npos || line.compare(word, 7, "include") != 0) continue;
    const auto open = line.find_first_of("<\"", word + 7);
    if (open == line.npos) continue;
    const auto close = line.find_first_of(">\"", open + 1);
    includes.push_back({name, line.substr(open + 1, close - open - 1), line[open] == '"'});
  }
  return includes;
}

TEST(Architecture, IncludesPointDownwards) {
  const std::filesystem::path root = ARGIL_SOURCE_DIR;
  std::size_t seen = 0;
  for (const std::string_view room : k_rooms)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / room)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string name = entry.path().lexically_relative(root).generic_string();
      for (const Include& include : includes_of(entry.path(), name)) {
        ++seen;
        const std::string fault = fault_of(include);
        EXPECT_TRUE(fault.empty()) << name << ": include of " << include.what << ' ' << fault;
      }
    }
  EXPECT_GT(seen, 100U);  // else the search looked in the wrong place
}

TEST(Architecture, HeadersAreIncludedOnce) {
  const std::filesystem::path root = ARGIL_SOURCE_DIR;
  for (const std::string_view room : k_rooms)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / room)) {
      if (entry.path().extension() != ".h") continue;
      std::string first;
      std::ifstream header(entry.path());
      std::getline(header, first);
      EXPECT_EQ(first, "#pragma once") << entry.path();
    }
}

TEST(Architecture, TheRulesRefuseWhatTheyShould) {
  const auto refused = [](const char* from, const char* what, bool quoted = false) {
    return !fault_of({from, what, quoted}).empty();
  };
  EXPECT_TRUE(refused("subdiv/solid.h", "fem/material.h", true));
  EXPECT_TRUE(refused("fem/system.h", "io/image.h", true));
  EXPECT_TRUE(refused("io/image.h", "sculpt/document.h", true));
  EXPECT_TRUE(refused("sculpt/document.h", "tools/view/view.h", true));
  EXPECT_TRUE(refused("tools/view/view.h", "tools/argil/main.h", true));
  EXPECT_TRUE(refused("fem/system.cpp", "system.h", true));
  EXPECT_TRUE(refused("sculpt/scene.h", "GL/gl.h"));
  EXPECT_TRUE(refused("io/image.cpp", "GLFW/glfw3.h"));
  EXPECT_TRUE(refused("subdiv/boundary.cpp", "CGAL/AABB_tree.h"));
  EXPECT_FALSE(refused("subdiv/query/inside.cpp", "CGAL/AABB_tree.h"));
  EXPECT_FALSE(refused("tools/view/view.cpp", "GL/gl.h"));
  EXPECT_TRUE(refused("tools/view/view.cpp", "imgui.h"));
  EXPECT_FALSE(refused("tools/studio/window.cpp", "GLFW/glfw3.h"));
  EXPECT_TRUE(refused("tools/studio/desk.h", "tools/chart/table.h", true));
  EXPECT_TRUE(refused("tools/chart/table.cpp", "tools/studio/desk.h", true));
  EXPECT_FALSE(refused("sculpt/document.h", "subdiv/solid.h", true));
  EXPECT_FALSE(refused("tools/argil/main.cpp", "tools/view/view.h", true));
  EXPECT_FALSE(refused("fem/system.h", "Eigen/Core"));
}

}  // namespace
}  // namespace argil
