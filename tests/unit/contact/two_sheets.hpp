#pragma once
#include "tests/support/sheets.hpp"
#include "tests/support/term_tangent.hpp"

namespace bulbus {

/// A slave sheet looking down on a master sheet looking up; their nodes do not match. Both are bent; the
/// slave is `sunk` into it.
struct TwoSheets {
  Sheets sheets;
  std::vector<Quad> slave, master;
  double area = .8 * .8;

  explicit TwoSheets(double sunk, double bend = .05) {
    const auto height = [=](double x, double y) { return bend * (std::sin(3 * x) + x * y); };
    slave = sheets.add(5, 4, [=](double u, double v) {
      return Vec3<double>{.1 + .8 * v, .1 + .8 * u, height(.1 + .8 * v, .1 + .8 * u) - sunk};
    });
    master = sheets.add(7, 6, [=](double u, double v) { return Vec3<double>{u, v, height(u, v)}; });
  }
  int slaves() const { return 30; }
  ContactTerm term(const ContactSpec& spec, int owned = -1) const {
    return ContactTerm(spec, {.penalty = 0, .depth = 0, .reach = .3},
                       {sheets.X, owned < 0 ? sheets.nodes() : owned, slave, Master(split(master)), {}},
                       Comm());
  }
};

inline std::vector<double> force(const ContactTerm& term, const State& state) {
  std::vector<double> f(state.x.size());
  term.add_residual(state, f, {});
  return f;
}

/// As after a Newton step that found the pressures of this state.
inline void settle(ContactTerm& term, const State& state) {
  step_from(state, std::vector<double>(state.x.size()), term);
}

}  // namespace bulbus
