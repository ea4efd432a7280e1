#pragma once
// Damage to files, drawn from a fixed generator: bits and bytes changed, put in and taken out, numbers replaced by
// hostile ones (as text and as bytes), lines removed and doubled, pieces of other files spliced in, ends cut off.

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace argil::io::test {

class Random {  // SplitMix64
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t bits = state_;
    bits = (bits ^ bits >> 30U) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ bits >> 27U) * 0x94D049BB133111EBU;
    return bits ^ bits >> 31U;
  }
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : static_cast<std::size_t>(next() % bound); }

 private:
  std::uint64_t state_;
};

inline bool in_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.' ||
         c == '+';
}

inline void replace_word(std::string& text, Random& random) {
  constexpr std::array<std::string_view, 26> k_words{"-1",
                                                     "0",
                                                     "1",
                                                     "2",
                                                     "42",
                                                     "1000000000000",
                                                     "18446744073709551615",
                                                     "9223372036854775807",
                                                     "-9223372036854775808",
                                                     "4294967296",
                                                     "4294967295",
                                                     "2147483648",
                                                     "nan",
                                                     "inf",
                                                     "-inf",
                                                     "1e999",
                                                     "1e-999",
                                                     "1e308",
                                                     "-1e308",
                                                     "0x10",
                                                     "1.5",
                                                     "",
                                                     "<",
                                                     "&#0;",
                                                     "\\",
                                                     "#"};
  std::size_t begin = random.below(text.size());
  while (begin < text.size() && !in_word(text[begin])) ++begin;
  std::size_t end = begin;
  while (begin > 0 && in_word(text[begin - 1])) --begin;
  while (end < text.size() && in_word(text[end])) ++end;
  text.replace(begin, end - begin, k_words[random.below(k_words.size())]);
}

inline void replace_binary(std::string& bytes, Random& random) {
  using Single = std::numeric_limits<float>;
  constexpr std::uint32_t k_words[] = {0,
                                       1,
                                       2,
                                       0xffffffff,
                                       0x7fffffff,
                                       0x80000000,
                                       0x01000000,
                                       0xff000000,
                                       0x0000ffff,
                                       std::bit_cast<std::uint32_t>(Single::quiet_NaN()),
                                       std::bit_cast<std::uint32_t>(Single::infinity()),
                                       std::bit_cast<std::uint32_t>(-Single::max()),
                                       0x7ff00000,
                                       0xfff80000};
  const std::uint32_t word = k_words[random.below(std::size(k_words))];
  const std::size_t at = random.below(bytes.size());
  for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) bytes[at + i] = static_cast<char>(word >> (8 * i));
}

inline void change_lines(std::string& text, Random& random) {
  const std::size_t at = random.below(text.size());
  const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  std::size_t end = text.find('\n', at);
  end = end == std::string::npos ? text.size() : end + 1;
  if (end <= begin) return;
  if (random.below(2) == 0) {
    text.erase(begin, end - begin);
  } else {
    text.insert(begin, text.substr(begin, end - begin));
  }
}

inline void put_in_or_take_out(std::string& text, Random& random) {
  const std::size_t at = random.below(text.size()), size = 1 + random.below(8);
  if (random.below(2) == 0) {
    text.erase(at, size);
  } else {
    for (std::size_t i = 0; i < size; ++i)
      text.insert(text.begin() + static_cast<std::ptrdiff_t>(at), static_cast<char>(random.below(256)));
  }
}

inline std::string mutated(const std::string& seed, const std::string& other, Random& random) {
  std::string text = seed;
  const std::size_t changes = 1 + random.below(3);
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    switch (random.below(9)) {
      case 0:
        text[random.below(text.size())] ^= static_cast<char>(1U << random.below(8));
        break;
      case 1:
        text[random.below(text.size())] = static_cast<char>(random.below(256));
        break;
      case 2:
        if (random.below(4) == 0) text.resize(random.below(text.size()));
        break;
      case 3:
      case 4:
        replace_word(text, random);
        break;
      case 5:
        change_lines(text, random);
        break;
      case 6:
        replace_binary(text, random);
        break;
      case 7:
        put_in_or_take_out(text, random);
        break;
      default: {  // a piece of another file, or of this one, put in or written over
        const std::size_t from = random.below(other.size()), size = random.below(64),
                          at = random.below(text.size());
        text.replace(at, random.below(2) == 0 ? 0 : size, other.substr(from, size));
      }
    }
  }
  return text;
}

}  // namespace argil::io::test
