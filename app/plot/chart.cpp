#include "app/plot/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "app/plot/svg.hpp"

namespace bulbus::inline app {
namespace {

using namespace svg;

constexpr double plot_width = 240, plot_height = 170, left = 64, right = 16, above = 30, below = 50;
constexpr double cell_width = left + plot_width + right, cell_height = above + plot_height + below;
constexpr double margin = 12, letter = 7;  // mean width of a letter of the small text

double length_of(const std::string& text) { return letter * static_cast<double>(text.size()); }

// Spans what is solid; hollow marks widen it to its double at most on either side.
std::vector<Chart::Tick> y_ticks(std::span<const Chart::Panel> panels) {
  double low = INFINITY, high = -INFINITY;
  const auto each = [&](bool solid, auto take) {
    for (const auto& panel : panels)
      for (const auto& series : panel.series)
        for (const auto& m : series.marks)
          if (m.solid == solid) take(m.y);
  };
  each(true, [&](double y) { low = std::min(low, y), high = std::max(high, y); });
  const double wide = std::max(high - low, std::max(std::abs(low), std::abs(high)) / 2);
  const bool bounded = low <= high;
  const double least = bounded ? low - wide : -INFINITY, most = bounded ? high + wide : INFINITY;
  each(false, [&](double y) {
    if (y >= least && y <= most) low = std::min(low, y), high = std::max(high, y);
  });
  if (low > high) return {};
  return panels[0].decades ? percent_ticks(low, high) : round_ticks(low, high);
}

/// Maps one panel's values to the page.
class Axes {
 public:
  Axes(const Chart::Panel& panel, std::vector<Chart::Tick> ticks, double x, double y)
      : x_(x + left), y_(y + above + plot_height), ticks_(std::move(ticks)) {
    first_ = panel.x_ticks.front().at, last_ = panel.x_ticks.back().at;
    const double pad = last_ > first_ ? .06 * (last_ - first_) : 1;
    first_ -= pad, last_ += pad;
  }
  double x(double v) const { return x_ + plot_width * (v - first_) / (last_ - first_); }
  double y(double v) const { return y_ - plot_height * (v - low()) / (high() - low()); }
  double low() const { return ticks_.front().at; }
  double high() const { return ticks_.back().at; }
  double left_edge() const { return x_; }
  double bottom() const { return y_; }
  const std::vector<Chart::Tick>& ticks() const { return ticks_; }

 private:
  double x_, y_, first_, last_;
  std::vector<Chart::Tick> ticks_;
};

std::string frame(const Chart::Panel& panel, const Axes& axes) {
  const double x0 = axes.left_edge(), x1 = x0 + plot_width, y0 = axes.bottom(), y1 = y0 - plot_height;
  std::string out = text(x0, y1 - 10, panel.title, "start", " font-weight=\"bold\"");
  for (const auto& tick : axes.ticks()) {
    out += line(x0, axes.y(tick.at), x1, axes.y(tick.at), "stroke=\"#e2e2e2\"");
    out += text(x0 - 8, axes.y(tick.at) + 4, tick.text, "end");
  }
  double free = -INFINITY;  // where the last label ends
  for (const auto& tick : panel.x_ticks) {
    const double x = axes.x(tick.at), half = length_of(tick.text) / 2;
    out += line(x, y0, x, y0 + 5, "stroke=\"#444\"");
    if (x - half < free + letter) continue;
    out += text(x, y0 + 18, tick.text, "middle");
    free = x + half;
  }
  out += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\" fill=\"none\" stroke=\"#444\"/>\n", x0, y1, y0,
                     x1);
  return out + text((x0 + x1) / 2, y0 + 36, panel.x_label, "middle");
}

std::string curve(const Chart::Series& series, std::size_t number, const Axes& axes) {
  std::string points, marks;
  if (series.background) number = grey;
  for (const auto& m : series.marks) {
    if (m.solid) points += fmt::format("{:.1f},{:.1f} ", axes.x(m.x), axes.y(m.y));
    marks += m.y > axes.high()  ? arrow(axes.x(m.x), axes.y(axes.high()), -1, number)
             : m.y < axes.low() ? arrow(axes.x(m.x), axes.y(axes.low()), 1, number)
                                : circle(axes.x(m.x), axes.y(m.y), number, m.solid);
  }
  if (series.background) return marks;
  return fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", points, stroke_of(number)) + marks;
}

std::string panel_of(const Chart::Panel& panel, const std::vector<Chart::Tick>& ticks, double x, double y) {
  const Axes axes(panel, ticks, x, y);
  std::string out = frame(panel, axes);
  for (bool background : {true, false})
    for (std::size_t s = 0; s < panel.series.size(); ++s)
      if (panel.series[s].background == background) out += curve(panel.series[s], s, axes);
  return out;
}

// Has the series in no panel a solid mark, but hollow ones?
bool is_hollow(const std::vector<Chart::Panel>& panels, std::size_t series) {
  bool any = false;
  for (const auto& panel : panels)
    if (series < panel.series.size())
      for (const auto& m : panel.series[series].marks) {
        if (m.solid) return false;
        any = true;
      }
  return any;
}

// Moves y below itself.
std::string legend(const std::vector<Chart::Panel>& panels, double width, double& y) {
  const std::vector<Chart::Series>& series = panels.front().series;
  std::string out;
  double x = margin;
  for (std::size_t s = 0; s < series.size(); ++s) {
    const double wide = 52 + length_of(series[s].name);
    const bool background = series[s].background, hollow = is_hollow(panels, s);
    if (x > margin && x + wide > width) x = margin, y += 20;
    if (!background && !hollow) out += line(x, y, x + 26, y, stroke_of(s));
    out += circle(x + 13, y, background ? grey : s, !hollow) + text(x + 32, y + 4, series[s].name, "start");
    x += wide;
  }
  y += 16;
  return out;
}

}  // namespace

std::string svg_of(const Chart& chart) {
  const int panels = static_cast<int>(chart.panels.size()),
            columns = std::max(1, std::min(chart.columns, panels));
  const double width =
      2 * margin + std::max({columns * cell_width, 1.35 * length_of(chart.title), length_of(chart.note)});
  double y = 28;
  std::string body = text(margin, y, chart.title, "start", " font-size=\"15\" font-weight=\"bold\"");
  if (!chart.note.empty()) body += text(margin, y += 20, chart.note, "start", " fill=\"#555\"");
  y += 22;
  if (panels && chart.panels[0].series.size() > 1) body += legend(chart.panels, width, y);
  for (int p = 0; p < panels; ++p) {
    const std::span<const Chart::Panel> all = chart.panels,
                                        row = all.subspan(p - p % columns,
                                                          std::min(columns, panels - p + p % columns));
    body += panel_of(chart.panels[p], y_ticks(chart.rows_share_y ? row : all.subspan(p, 1)),
                     margin + p % columns * cell_width, y + p / columns * cell_height);
  }
  const double height = y + (panels + columns - 1) / columns * cell_height + margin;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
      width, height, body);
}

}  // namespace bulbus::inline app
