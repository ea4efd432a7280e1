#include "tests/tools/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>

namespace argil::tests {

namespace fs = std::filesystem;

namespace {

void check(int failure, const char* what) {
  if (failure != 0) throw std::system_error(failure, std::generic_category(), what);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::path(testing::TempDir()) / "argil_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) check(errno, "mkdtemp");
  path_ = fs::canonical(name);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const fs::path& name, const std::string& bytes) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::vector<std::string> TemporaryFolder::files() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_))
    if (!entry.is_directory() || entry.is_symlink()) names.push_back(fs::relative(entry.path(), path_).string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << "cannot read " << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

nlohmann::json read_json(const fs::path& path) {
  return nlohmann::json::parse(read_bytes(path));
}

namespace {

// Files, not pipes, so that a program that prints much on both never waits for us.
pid_t start(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& folder,
            const fs::path& out, const fs::path& err) {
  posix_spawn_file_actions_t actions;
  check(posix_spawn_file_actions_init(&actions), "posix_spawn");
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int failure = posix_spawn(&child, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  check(failure, program.c_str());
  return child;
}

int end_of(pid_t child) {
  int ended = 0;
  while (waitpid(child, &ended, 0) < 0)
    if (errno != EINTR) check(errno, "waitpid");
  return ended;
}

}  // namespace

Finished run_program(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& folder) {
  const TemporaryFolder captured;
  const int ended = end_of(start(program, arguments, folder, captured / "out", captured / "err"));
  return {.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended),
          .out = read_bytes(captured / "out"),
          .err = read_bytes(captured / "err")};
}

bool run_and_kill(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& folder,
                  const fs::path& file, std::size_t bytes, unsigned turns) {
  const TemporaryFolder captured;
  const pid_t child = start(program, arguments, folder, captured / "out", captured / "err");
  std::error_code none;
  int ended = 0;
  while (waitpid(child, &ended, WNOHANG) == 0) {
    const auto size = fs::file_size(file, none);
    if (!none && size >= bytes) {
      for (unsigned i = 0; i < turns; ++i) asm volatile("");
      kill(child, SIGKILL);
      ended = end_of(child);
      return WIFSIGNALED(ended);
    }
    sched_yield();
  }
  return false;
}

Finished run_argil(const std::vector<std::string>& arguments, const fs::path& folder) {
  return run_program(ARGIL_PROGRAM, arguments, folder);
}

}  // namespace argil::tests
