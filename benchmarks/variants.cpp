#include "benchmarks/variants.hpp"

#include <sstream>
#include <stdexcept>

#include "core/solve/direct/libraries.hpp"

namespace bulbus::bench {
namespace {

// The direct solvers in all their orderings, alone and as a preconditioner of GMRES; UMFPACK where it is
// built in.
const std::vector<std::string> every_variant{"iterative",
                                             "iterative+displacement=hybrid",
                                             "iterative+displacement=boomeramg_nodal",
                                             "iterative+ranks=2",
                                             "direct",
                                             "direct+ordering=metis",
                                             "direct+ordering=amd",
                                             "direct+ordering=qamd",
                                             "direct+ordering=pord",
                                             "direct+ordering=auto",
                                             "direct+ranks=2",
                                             "direct+refinement=gmres",
                                             "direct+library=superlu_dist",
                                             "direct+library=superlu_dist+ranks=2",
                                             "direct+library=umfpack",
                                             "direct+library=eigen"};

void set(SolverVariant& v, const std::string& key, const std::string& value) {
  LinearSettings& l = v.settings.linear;
  if (key == "library")
    l.direct = from_word<Direct>(value);
  else if (key == "ordering")
    l.ordering = from_word<Ordering>(value);
  else if (key == "refinement")
    l.refinement = from_word<Refinement>(value);
  else if (key == "displacement")
    l.displacement = from_word<Displacement>(value);
  else if (key == "ranks")
    v.ranks = std::stoi(value);
  else if (key == "threads")
    v.threads = std::stoi(value);
  else
    throw std::invalid_argument("a variant has no key " + key);
}

}  // namespace

SolverVariant solver_variant(const std::string& name, double memory_mb) {
  SolverVariant v{.name = name};
  std::istringstream words(name);
  std::string word;
  std::getline(words, word, '+');
  v.settings.linear.method = from_word<Method>(word);
  while (std::getline(words, word, '+')) {
    const auto equals = word.find('=');
    if (equals == std::string::npos) throw std::invalid_argument("KEY=VALUE is expected, not " + word);
    set(v, word.substr(0, equals), word.substr(equals + 1));
  }
  if (memory_mb > 0) v.settings.linear.memory_limit = memory_mb;
  if (v.direct()) v.settings.linear.gamma = 0;  // the direct solver takes the system as it is
  return v;
}

std::vector<std::string> variants_in(const std::string& list) {
  std::vector<std::string> names;
  if (list == "all") {
    names = every_variant;
    if (!has_umfpack())
      std::erase_if(names, [](const std::string& n) { return n.find("umfpack") != n.npos; });
    return names;
  }
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');) names.push_back(solver_variant(name, 0).name);
  return names;
}

}  // namespace bulbus::bench
