#pragma once
// Counts the bytes that this program holds on its heap, by malloc and so by new alike: with hooks of the address
// sanitizer where there is one, else by taking the place of the C library's functions.

#include <cstddef>

namespace argil::io::test {

/// Whether bytes are counted in this build (not under the thread sanitizer).
bool counts_bytes();
/// The most bytes held at once since then are counted from what is held now.
void start_counting();
/// Beyond what was held at the start.
std::size_t peak_bytes();

}  // namespace argil::io::test
