#include "tests/fuzz/tree.hpp"

#include <algorithm>
#include <cmath>

#include "app/scene/text_format.hpp"
#include "tests/fuzz/bytes.hpp"

namespace bulbus::fuzz {
namespace {

using Kind = YamlNode::Kind;

void collect(YamlNode& at, std::vector<YamlNode*>& all) {
  all.push_back(&at);
  for (YamlNode& item : at.items) collect(item, all);
}

template <class Wanted>
YamlNode* any(YamlNode& root, Random& random, Wanted wanted) {
  std::vector<YamlNode*> all;
  collect(root, all);
  std::erase_if(all, [&](YamlNode* e) { return !wanted(*e); });
  return all.empty() ? nullptr : random.of(all);
}

bool is_word(const YamlNode& e) { return e.is(Kind::word); }
bool is_full_map(const YamlNode& e) { return e.is(Kind::map) && !e.items.empty(); }
bool is_full_list(const YamlNode& e) { return e.is(Kind::list) && !e.items.empty(); }

void change_number(YamlNode& e, Random& random) {
  char* rest = nullptr;
  const double value = std::strtod(e.text.c_str(), &rest);
  if (rest == e.text.c_str()) {
    e.text = random.of(awkward_words());
    return;
  }
  static const std::vector<double> factors{-1, 0, .1, .5, .99, 1.01, 2, 10, 1000, 1e-3, 1e9};
  const double changed = value * random.of(factors);
  const std::string unit = rest;
  e.text = (changed == std::floor(changed) && std::abs(changed) < 1e15
                ? std::to_string(static_cast<long long>(changed))
                : number_text(changed)) +
           unit;
}

void erase(YamlNode& map, std::size_t i) {
  map.keys.erase(map.keys.begin() + i);
  map.key_places.erase(map.key_places.begin() + i);
  map.items.erase(map.items.begin() + i);
}

void change_map(YamlNode& map, const Pool& pool, Random& random) {
  const std::size_t i = random.below(map.items.size());
  switch (random.below(6)) {
    case 0:
      return erase(map, i);
    case 1:
      map.insert(map.keys[i], {}, map.items[i]);
      return;
    case 2:
      map.keys[i] = random.of(pool.keys);
      return;
    case 3:
      map.keys[i] += "x";
      return;
    case 4: {
      const auto& [key, value] = random.of(pool.values);
      map.insert(key, {}, value);
      return;
    }
    default:
      for (const auto& [key, value] : pool.values)
        if (key == map.keys[i] && random.one_in(3)) {
          map.items[i] = value;
          return;
        }
  }
}

void change_list(YamlNode& list, Random& random) {
  const std::size_t i = random.below(list.items.size());
  switch (random.below(4)) {
    case 0:
      list.items.erase(list.items.begin() + i);
      return;
    case 1:
      list.items.insert(list.items.begin() + i, YamlNode(list.items[i]));
      return;
    case 2:
      std::ranges::reverse(list.items);
      return;
    default:
      list.items.clear();
  }
}

void wrap(YamlNode& e, Random& random) {
  YamlNode outer = YamlNode::empty(random.one_in(2) ? Kind::list : Kind::map);
  if (outer.is(Kind::list))
    outer.items.push_back(e);
  else
    outer.insert("x", {}, e);
  e = outer;
}

void add_fault(YamlNode& root, const Pool& pool, Random& random) {
  const auto all = [](const YamlNode&) { return true; };
  const std::size_t what = random.below(12);
  if (what < 3) {
    if (YamlNode* e = any(root, random, is_word)) e->text = random.of(awkward_words());
  } else if (what < 6) {
    if (YamlNode* e = any(root, random, is_word)) change_number(*e, random);
  } else if (what < 8) {
    if (YamlNode* e = any(root, random, is_full_map)) change_map(*e, pool, random);
  } else if (what < 9) {
    if (YamlNode* e = any(root, random, is_full_list)) change_list(*e, random);
  } else if (what < 10) {
    YamlNode *a = any(root, random, is_word), *b = any(root, random, is_word);
    if (a && b) std::swap(a->text, b->text);
  } else if (what < 11) {
    *any(root, random, all) = random.of(pool.branches);
  } else {
    YamlNode& e = *any(root, random, all);
    if (random.one_in(2))
      wrap(e, random);
    else
      e = YamlNode::empty(random.one_in(2) ? Kind::nothing : Kind::map);
  }
}

}  // namespace

void Pool::add(const YamlNode& root) {
  branches.push_back(root);
  for (std::size_t i = 0; i < root.items.size(); ++i) {
    if (root.is(Kind::map)) {
      keys.push_back(root.keys[i]);
      values.emplace_back(root.keys[i], root.items[i]);
    }
    add(root.items[i]);
  }
}

YamlNode with_faults(YamlNode root, const Pool& pool, Random& random) {
  for (int faults = random.one_in(3) ? random.between(2, 4) : 1; faults > 0; --faults)
    add_fault(root, pool, random);
  return root;
}

}  // namespace bulbus::fuzz
