#include "tests/fuzz/bytes.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>

namespace bulbus::fuzz {
namespace {

struct Range {
  std::size_t first, size;
};

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

Range word_at(const std::string& text, std::size_t at) {
  std::size_t first = at, last = at;
  while (first > 0 && !is_space(text[first - 1])) --first;
  while (last < text.size() && !is_space(text[last])) ++last;
  return {first, last - first};
}

Range line_at(const std::string& text, std::size_t at) {
  const auto before = at == 0 ? std::string::npos : text.rfind('\n', at - 1), end = text.find('\n', at);
  const std::size_t first = before == std::string::npos ? 0 : before + 1,
                    last = end == std::string::npos ? text.size() : end + 1;
  return {first, last - first};
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  at -= at % alignof(T);
  if (at + sizeof value <= bytes.size()) std::memcpy(bytes.data() + at, &value, sizeof value);
}

void put_number(std::string& bytes, std::size_t at, Random& random) {
  constexpr auto inf = std::numeric_limits<double>::infinity();
  static const std::vector<double> reals{
      std::numeric_limits<double>::quiet_NaN(), inf, -inf, 1e308, -1e300, 1e-300, 0, -1, 1e5};
  static const std::vector<long long> wholes{-1,
                                             0,
                                             1,
                                             2,
                                             255,
                                             65536,
                                             1LL << 31,
                                             (1LL << 32) - 1,
                                             1LL << 40,
                                             std::numeric_limits<long long>::max(),
                                             std::numeric_limits<long long>::min()};
  switch (random.below(4)) {
    case 0:
      return put(bytes, at, random.of(reals));
    case 1:
      return put(bytes, at, static_cast<float>(random.of(reals)));
    case 2:
      return put(bytes, at, random.of(wholes));
    default:
      return put(bytes, at, static_cast<int>(random.of(wholes)));
  }
}

void copy(std::string& text, const Range& from, std::size_t to) {
  const std::string part = text.substr(from.first, std::min<std::size_t>(from.size, 4096));
  text.insert(std::min(to, text.size()), part);
}

void add_fault(std::string& text, bool binary, Random& random) {
  if (text.empty()) text = " ";
  const std::size_t at = random.below(text.size());
  if (binary && random.one_in(2)) return put_number(text, at, random);
  switch (random.below(11)) {
    case 0:
      text[at] ^= static_cast<char>(1 << random.below(8));
      return;
    case 1:
      text[at] = static_cast<char>(random.below(256));
      return;
    case 2:
      text.erase(at, 1 + random.below(8));
      return;
    case 3:
      text.insert(at, 1, "\t \n:-[]{}#&*!|>'\"%@,.0"[random.below(22)]);
      return;
    case 4:
      if (random.one_in(4)) text.resize(at);
      return;
    case 5: {
      const Range line = line_at(text, at);
      text.erase(line.first, line.size);
      return;
    }
    case 6:
      return copy(text, line_at(text, at), line_at(text, random.below(text.size())).first);
    case 7:
      return copy(text, {at, 1 + random.below(64)}, random.below(text.size()));
    case 8: {
      const Range word = word_at(text, at);
      copy(text, word_at(text, random.below(text.size())), word.first);
      return;
    }
    default: {
      const Range word = word_at(text, at);
      text.replace(word.first, word.size, random.of(awkward_words()));
    }
  }
}

}  // namespace

const std::vector<std::string>& awkward_words() {
  static const std::vector<std::string> words{"nan",
                                              ".nan",
                                              "inf",
                                              ".inf",
                                              "-.inf",
                                              "1e308",
                                              "-1e308",
                                              "1e-308",
                                              "1e999",
                                              "0",
                                              "-0.0",
                                              "-1",
                                              "1",
                                              "2",
                                              "3",
                                              "7",
                                              "0.5",
                                              "1e5",
                                              "1e-9",
                                              "100000",
                                              "1000000",
                                              "2147483647",
                                              "2147483648",
                                              "-2147483648",
                                              "4294967296",
                                              "9223372036854775807",
                                              "99999999999999999999",
                                              "0x7f",
                                              "1_000",
                                              "",
                                              "~",
                                              "null",
                                              "true",
                                              "no",
                                              "[]",
                                              "{}",
                                              "[1, 2]",
                                              "x",
                                              "X",
                                              "s",
                                              "xyz",
                                              "αβγ",
                                              "1/0",
                                              "sqrt(-1)",
                                              "log(s)",
                                              "s/0",
                                              "X*1e300",
                                              "t^99999",
                                              "((((1))))",
                                              "0,1",
                                              "1 mmHg",
                                              "15 mmhg",
                                              "5 kg",
                                              "3 deg",
                                              "90",
                                              "-5 MPa",
                                              "2 m",
                                              "%s%n",
                                              "../../x",
                                              "/dev/null",
                                              "*a",
                                              "&a",
                                              "!!binary x",
                                              std::string(5000, 'a'),
                                              std::string("a\0b", 3),
                                              "\"",
                                              "'",
                                              "|",
                                              "- -",
                                              "? :"};
  return words;
}

std::string with_faults(std::string bytes, bool binary, Random& random) {
  for (int faults = random.one_in(3) ? random.between(2, 4) : 1; faults > 0; --faults)
    add_fault(bytes, binary, random);
  return bytes;
}

}  // namespace bulbus::fuzz
