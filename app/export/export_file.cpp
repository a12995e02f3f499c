#include "app/export/export_file.hpp"

#include <charconv>
#include <cmath>

namespace bulbus::inline app {
namespace {

constexpr std::size_t widest = 20;

// Without the zero before the point; "." is "0.".
std::string fixed(double x, int digits_behind_point) {
  char buffer[64];
  const auto end =
      digits_behind_point < 0
          ? std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::fixed)
          : std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::fixed, digits_behind_point);
  if (end.ec != std::errc()) return std::string(widest + 1, '0');  // too long
  std::string text(buffer, end.ptr);
  if (text.find('.') == std::string::npos) text += '.';
  if (const std::size_t zero = text[0] == '-' ? 1 : 0; text.size() > widest && text[zero] == '0')
    text.erase(zero, 1);
  return text;
}

}  // namespace

std::string decimal(double x) {
  if (std::abs(x) >= 1e18) return fmt::format("{:.12e}", x);
  std::string text = fixed(x, -1);
  if (text.size() <= widest) return text;
  text = fixed(x, 18);
  if (text.size() > widest) text.resize(widest);
  return text.find_first_of("123456789") == std::string::npos ? "0." : text;
}

std::vector<Run> runs_of(std::span<const int> sorted) {
  std::vector<Run> runs;
  for (int n : sorted)
    if (!runs.empty() && n == runs.back().last + 1)
      runs.back().last = n;
    else
      runs.push_back({n, n});
  return runs;
}

}  // namespace bulbus::inline app
