#include "app/scene/value.hpp"

namespace bulbus::inline app {

Value::Kind Value::kind() const { return type_->kind; }

std::vector<std::string> Value::words() const { return type_->words(); }

std::string Value::word() const { return type_->word(variable_); }

void Value::choose(const std::string& word) const { type_->choose(variable_, word); }

Value::Kind Value::inner_kind() const { return type_->inner->kind; }

void Value::clear() const { type_->clear(variable_); }

Value Value::add(const std::string& key) const { return {type_->add(variable_, key), *type_->inner}; }

std::vector<std::pair<std::string, Value>> Value::items() const {
  std::vector<std::pair<std::string, Value>> items;
  for (const auto& [key, item] : type_->items(variable_)) items.emplace_back(key, Value(item, *type_->inner));
  return items;
}

std::vector<Member> Value::members() const { return type_->members(variable_); }

void Value::validate() const {
  if (type_->validate) type_->validate(variable_);
}

const char* Value::preset_key() const { return type_->preset_key; }

void Value::take_preset() const { type_->take_preset(variable_); }

}  // namespace bulbus::inline app
