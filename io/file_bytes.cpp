#include "io/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "subdiv/error.h"

namespace argil::io {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason() {
  return std::generic_category().message(errno);
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::error_code fault;
  const auto status = std::filesystem::status(path, fault);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw Error(ErrorCode::not_found, "there is no such file; check the name and the folder", path.string());
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw Error(ErrorCode::bad_input, "expected a regular file that can be read", path.string());
  }
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw Error(ErrorCode::bad_input, "cannot read the file: " + reason(), path.string());
  std::string bytes;
  const auto size = std::filesystem::file_size(path, fault);
  if (!fault) bytes.resize(size);
  const std::size_t got = bytes.empty() ? 0 : std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (fault || got != bytes.size()) {
    throw Error(ErrorCode::bad_input, "the file could not be read to its end; try again", path.string());
  }
  return bytes;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  write_file(path, [&](const std::function<void(std::string_view)>& write) { write(bytes); });
}

void write_file(const std::filesystem::path& path,
                const std::function<void(const std::function<void(std::string_view)>& write)>& give) {
  // "x" refuses a name that exists, so neither a stranger's file nor the target of a link is overwritten.
  std::filesystem::path partial;
  File file;
  for (int attempt = 0; !file && attempt < 100; ++attempt) {
    partial = path;
    partial += ".partial" + std::to_string(attempt);
    file.reset(std::fopen(partial.c_str(), "wbx"));
    if (!file && errno != EEXIST) break;
  }
  if (!file) {
    throw Error(ErrorCode::bad_input,
                "cannot write here: " + reason() + "; choose a folder that exists and is writable", path.string());
  }
  std::error_code fault;
  bool written = true;
  std::string why;
  try {
    give([&](std::string_view bytes) {
      if (!written || bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size())
        return;
      written = false;
      why = reason();
    });
  } catch (...) {
    std::filesystem::remove(partial, fault);
    throw;
  }
  if (std::fclose(file.release()) != 0 && written) {
    written = false;
    why = reason();
  }
  if (written) {
    std::filesystem::rename(partial, path, fault);
    if (!fault) return;
    why = fault.message();
  }
  std::error_code ignored;  // the first fault is the one to report
  std::filesystem::remove(partial, ignored);
  throw Error(ErrorCode::bad_input, "cannot write the file: " + why + "; nothing was changed", path.string());
}

}  // namespace argil::io
