#include <cstdio>

int main() {
  std::puts("argil " ARGIL_VERSION);
  return 0;
}
