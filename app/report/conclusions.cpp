#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/records/checkpoints.hpp"
#include "app/records/closed_part.hpp"
#include "app/records/finished.hpp"
#include "app/report/html.hpp"
#include "app/report/probe_words.hpp"
#include "app/report/sections.hpp"

namespace bulbus::inline app {
namespace {

using nlohmann::json;

constexpr std::size_t most_cards = 6;

struct Card {
  std::string title, value, note, tone;
};

// The more of this, the later a figure comes.
int rank_of(const ProbeSpec& p) {
  if (p.kind == "closed_fraction") return 0;
  if (p.kind == "pressure") return 1;
  if (!p.since.empty()) return 2;
  return p.kind == "gap" ? 3 : 4;
}

// "15 after pressurise, 24 after buckle": where it was at the ends of the steps before the last.
std::string course_of(const RunRecord& run, std::size_t probe) {
  std::string words;
  const auto& ends = run.history.ends;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (const auto& value = ends[i].values[probe])
      words += (words.empty() ? "" : ", ") + html::number(*value) + " after " + ends[i].step;
  return words;
}

// 24.0, 0.419, 1230.
std::string three_digits(double value) {
  std::string text = fmt::format("{:#.3g}", value + 0.);
  if (text.ends_with('.')) text.pop_back();
  return value == 0 ? "0" : text;
}

Card closing_card(const ProbeSpec& p, double part) {
  const std::string nodes = p.set.empty() ? "the nodes of the contact" : p.set;
  return {title_of(p.name), part >= 1 ? "yes" : "no",
          fmt::format("{:.0f} % of {} closer than {:g} mm", 100 * part, nodes, p.tolerance),
          part >= 1 ? "good" : "bad"};
}

std::string note_of(const RunRecord& run, const ProbeSpec& p, std::size_t probe) {
  if (p.peak) return p.since.empty() ? "largest so far" : "largest since the end of " + p.since;
  return p.since.empty() ? course_of(run, probe) : "since the end of " + p.since;
}

Card card_of(const RunRecord& run, const ProbeSpec& p, std::size_t probe, double value) {
  if (const auto part = closed_part(p, value)) return closing_card(p, *part);
  const bool change = !p.since.empty() && p.scale > 0;
  const std::string unit = html::unit(run.unit(p.name)), number = three_digits(value);
  return {title_of(p.name), (change && value > 0 ? "+" : "") + number + (unit.empty() ? "" : " " + unit),
          note_of(run, p, probe), ""};
}

std::vector<Card> cards_of(const RunRecord& run) {
  std::vector<std::pair<const ProbeSpec*, std::size_t>> probes;
  for (std::size_t i = 0; i < run.history.probes.size(); ++i)
    if (const ProbeSpec* p = run.probe(run.history.probes[i])) probes.emplace_back(p, i);
  std::ranges::stable_sort(probes, {}, [](const auto& probe) { return rank_of(*probe.first); });
  std::vector<Card> cards;
  for (const auto& [p, i] : probes)
    if (const auto& value = run.history.ends.empty() ? std::nullopt : run.history.ends.back().values[i];
        value && cards.size() < most_cards)
      cards.push_back(card_of(run, *p, i, *value));
  return cards;
}

std::string html_of(const Card& card) {
  return html::element(
      "div", html::text("h3", card.title) + html::text("p", card.value, "value") + html::text("p", card.note),
      card.tone.empty() ? "card" : "card " + card.tone);
}

std::string verdict_of(const RunRecord& run) {
  const json& summary = run.summary;
  if (!summary.contains("converged"))
    return html::text("p", "The run has not come to its end yet.", "verdict bad");
  if (summary.value("converged", false))
    return html::text("p", "The run converged: all steps are done.", "verdict good");
  if (was_interrupted(summary))
    return html::text("p",
                      std::filesystem::exists(checkpoint_in(run.folder))
                          ? "The run was interrupted; 'bulbus run' with --restart goes on."
                          : "The run was interrupted; it has no checkpoint, and 'bulbus run' starts anew.",
                      "verdict bad");
  std::string words =
      "The run did not converge: " + summary.value("reason", std::string("reason unknown")) + ".";
  if (summary.contains("diagnosis")) words += " Diagnosis: " + summary.value("diagnosis", "");
  return html::text("p", words, "verdict bad");
}

std::string warnings_of(const json& summary) {
  std::string items;
  for (const json& warning : summary.value("warnings", json::array()))
    if (warning.is_string()) items += html::text("li", warning.get<std::string>());
  if (items.empty()) return "";
  return html::element("div", html::text("h3", "Warnings") + html::element("ul", items), "warnings");
}

}  // namespace

std::string conclusions_of(const RunRecord& run) {
  std::string cards;
  for (const Card& card : cards_of(run)) cards += html_of(card);
  return verdict_of(run) + html::element("div", cards, "cards") + warnings_of(run.summary);
}

}  // namespace bulbus::inline app
