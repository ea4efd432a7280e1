#pragma once
// What tests of whole programs need: a folder that goes away, and a program run in it as a user would, with what it
// printed and its exit status.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace argil::tests {

/// A new, empty folder, removed with everything in it at the end of its life.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  /// Writes a file, with the folders on its way.
  std::filesystem::path write(const std::filesystem::path& name, const std::string& bytes) const;
  /// All files beneath it, as sorted relative paths.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

std::string read_bytes(const std::filesystem::path& path);
nlohmann::json read_json(const std::filesystem::path& path);

struct Finished {
  int status = -1;  // exit status; 128 + the signal where one ended it
  std::string out, err;
};

/// Runs a program to its end in `folder`, its input closed.
Finished run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& folder);
/// Starts it likewise and kills it (SIGKILL) as soon as `file` holds `bytes` bytes and `turns` turns of a loop have
/// passed, or lets it end. Returns whether it was killed.
bool run_and_kill(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  const std::filesystem::path& folder, const std::filesystem::path& file, std::size_t bytes,
                  unsigned turns);
/// Runs the argil that was built with these tests.
Finished run_argil(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// Calls of argil in a folder of their own.
class ArgilCalls : public testing::Test {
 protected:
  Finished argil(const std::vector<std::string>& arguments) { return run_argil(arguments, folder_.path()); }
  /// What it printed as JSON; it must have ended well.
  nlohmann::json answer(const std::vector<std::string>& arguments) {
    const Finished finished = argil(arguments);
    EXPECT_EQ(finished.status, 0) << finished.err;
    return nlohmann::json::parse(finished.out);
  }
  TemporaryFolder folder_;
};

}  // namespace argil::tests
