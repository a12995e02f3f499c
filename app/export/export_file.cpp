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
  const double size = std::abs(x);
  if (size < 1e18) {
    std::string text = fixed(x, -1);
    if (text.size() <= widest) return text;
    if (size >= 1e-4) return fixed(x, 18).substr(0, widest);
  }
  std::string text = fmt::format("{:.13e}", x);
  return text.size() <= widest ? text : fmt::format("{:.12e}", x);  // three digits of the exponent
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
