#include "core/problem/probes/probe_record.hpp"

#include <algorithm>
#include <limits>

namespace bulbus::inline problem {

double ProbeRecord::value(std::size_t i, Snapshot& s, const Start& start) const {
  const auto origin = s.origin;
  s.origin = start.x;
  const double value = probes_.value(i, s);
  s.origin = origin;
  return value;
}

void ProbeRecord::step_ended(int step, Snapshot& s) {
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    if (probes_.since(i) != step) continue;
    Start& start = starts_[step];
    start.x = s.state.x;
    start.values[i] = value(i, s, start);
  }
}

ProbeValues ProbeRecord::increment_ended(Snapshot& s) {
  ProbeValues now = values(s);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (probes_.peak(i) && now[i]) {
      double& peak = peaks_.try_emplace(i, *now[i]).first->second;
      now[i] = peak = std::max(peak, *now[i]);
    }
  return now;
}

// A peak that has not begun is kept as what any value exceeds.
void ProbeRecord::serialize(Archive& archive, int ended) {
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    if (!probes_.peak(i)) continue;
    const Archive::Group group(archive, "probe " + probes_.name(i));
    archive.scalars("peak", peaks_.try_emplace(i, -std::numeric_limits<double>::infinity()).first->second);
  }
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    if (probes_.since(i) < 0 || probes_.since(i) >= ended) continue;
    Start& start = starts_[probes_.since(i)];
    const Archive::Group group(archive, "probe " + probes_.name(i));
    archive.nodes("x", start.x);
    archive.scalars("value", start.values[i]);
  }
}

ProbeValues ProbeRecord::values(Snapshot& s) const {
  ProbeValues values(probes_.size());
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    const auto start = starts_.find(probes_.since(i));
    if (probes_.since(i) < 0)
      values[i] = probes_.value(i, s);
    else if (start != starts_.end())
      values[i] = value(i, s, start->second) - start->second.values.at(i);
  }
  return values;
}

}  // namespace bulbus::inline problem
