#include "core/io/json_file.hpp"

#include <nlohmann/json.hpp>

#include "core/io/text_file.hpp"

namespace bulbus::inline io {

void write_json(const std::string& path, const nlohmann::json& value) {
  // A name that is no UTF-8 must not cost a run its summary.
  write_whole(path, value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace bulbus::inline io
