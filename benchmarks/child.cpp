#include "benchmarks/child.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/base/parallel.hpp"
#include "core/base/process.hpp"
#include "core/io/json_file.hpp"

namespace bulbus::bench {

// The child writes its row to a file: its standard output belongs to the libraries.
json row_of_child(const std::vector<std::string>& words, int ranks, int threads) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("bulbus_" + std::to_string(getpid()) + ".json");
  const std::string start = ranks > 1 ? "mpirun --oversubscribe -n " + std::to_string(ranks) + " " : "";
  std::string command = "OMP_NUM_THREADS=" + std::to_string(threads) + " " + start + "'" + this_program() +
                        "' --child '" + file.string() + "'";
  for (const std::string& word : words) command += " '" + word + "'";
  const int status = std::system(command.c_str());
  std::ifstream in(file);
  json row = json::parse(in, nullptr, false);
  std::filesystem::remove(file);
  if (status != 0 || row.is_discarded())
    row = {{"reason", "the process ended with status " + std::to_string(status)}};
  return row;
}

bool ran_as_child(int& argc, char**& argv,
                  const std::function<json(const std::vector<std::string>&)>& measure) {
  if (argc < 3 || argv[1] != std::string("--child")) return false;
  const std::string file = argv[2];
  const std::vector<std::string> words(argv + 3, argv + argc);
  Session session(argc, argv);
  const json row = measure(words);
  if (Comm().rank() == 0) write_json(file, row);
  return true;
}

}  // namespace bulbus::bench
