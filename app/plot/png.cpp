#include "app/plot/png.hpp"

#include <filesystem>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/process.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

constexpr const char* converter = "rsvg-convert";

}  // namespace

void require_png() {
  if (find_program(converter).empty())
    throw input_error(
        std::string("PNG files are drawn by the program ") + converter + ", which is not installed",
        "Install it (Debian: apt-get install librsvg2-bin), or name a file that ends in .svg.");
}

void write_png(const std::string& path, const std::string& svg) {
  write_whole(path, [&](const std::string& file) {
    const std::string source = file + ".svg";
    write_whole(source, svg);
    const Ended drawn = run_process({find_program(converter), "--zoom=2", "--output=" + file, source});
    std::filesystem::remove(source);
    if (!drawn.ran || drawn.status != 0)
      throw std::runtime_error(path + ": cannot be drawn: " + converter + " " + drawn.reason);
  });
}

}  // namespace bulbus::inline app
