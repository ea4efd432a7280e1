#include "live_bytes.h"

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstdint>

#if defined(__SANITIZE_ADDRESS__)
extern "C" {  // of sanitizer/allocator_interface.h, which not every compiler ships
int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                              void (*on_free)(const volatile void*));
std::size_t __sanitizer_get_allocated_size(const volatile void* memory);
}
#endif

namespace argil::io::test {
namespace {

constinit std::atomic<std::int64_t> live{0}, highest{0}, start{0};

[[maybe_unused]] void take(std::size_t bytes) {
  const std::int64_t now = live.fetch_add(static_cast<std::int64_t>(bytes)) + static_cast<std::int64_t>(bytes);
  std::int64_t seen = highest.load();
  while (now > seen && !highest.compare_exchange_weak(seen, now)) {
  }
}
[[maybe_unused]] void give_back(std::size_t bytes) {
  live.fetch_sub(static_cast<std::int64_t>(bytes));
}

#if defined(__SANITIZE_ADDRESS__)
void on_malloc(const volatile void*, std::size_t bytes) {
  take(bytes);
}
void on_free(const volatile void* memory) {
  if (memory) give_back(__sanitizer_get_allocated_size(memory));
}
const bool k_counts = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) != 0;
#elif defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
const bool k_counts = false;
#else
const bool k_counts = true;
#endif

}  // namespace

bool counts_bytes() {
  return k_counts;
}
void start_counting() {
  start = live.load();
  highest = live.load();
}
std::size_t peak_bytes() {
  return static_cast<std::size_t>(highest.load() - start.load());
}

}  // namespace argil::io::test

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace {
void* counted(void* memory) {
  if (memory) argil::io::test::take(malloc_usable_size(memory));
  return memory;
}
}  // namespace

extern "C" {
void* malloc(std::size_t size) noexcept {
  return counted(__libc_malloc(size));
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  return counted(__libc_calloc(count, size));
}
void* realloc(void* memory, std::size_t size) noexcept {
  const std::size_t before = memory ? malloc_usable_size(memory) : 0;
  void* moved = __libc_realloc(memory, size);
  if (moved || size == 0) argil::io::test::give_back(before);
  return counted(moved);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return counted(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return counted(__libc_memalign(alignment, size));
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  *memory = counted(__libc_memalign(alignment, size));
  return *memory ? 0 : ENOMEM;
}
void free(void* memory) noexcept {
  if (memory) argil::io::test::give_back(malloc_usable_size(memory));
  __libc_free(memory);
}
}

#endif
