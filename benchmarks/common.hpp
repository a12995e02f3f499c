#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bulbus::bench {

using json = nlohmann::json;

/// What every benchmark's command line says.
struct Options {
  std::vector<int> sizes;
  int repetitions = 0;
  int refine = 0;      ///< times that the meshes are refined
  std::string out;     ///< JSON file; empty: none
  bool smoke = false;  ///< seconds-long run that only shows that the program works
  std::vector<std::string> rest;
};

/// `-n 14,28`, `-r REPETITIONS`, `--refine TIMES`, `-o FILE`, `--smoke`; anything else is handed over in
/// `rest`. `sizes` and `smoke_sizes` are used where the command line gives none.
Options parse(int argc, char** argv, std::vector<int> sizes, std::vector<int> smoke_sizes, int repetitions);

/// Makes BLAS and OpenMP single-threaded. They read the environment before main, so the program starts itself
/// anew. A child is left as it was started.
void single_threaded(char** argv);

/// Lets the peak that core/base/memory.hpp tells begin anew with what is resident now (Linux; elsewhere it
/// stays).
void reset_peak_resident();

/// Seconds of processor time of this process: what a machine shared with others leaves comparable.
double cpu_seconds();

double median(std::vector<double> values);

/// Every benchmark's JSON: program, commit, compiler, flags, processor, ranks, parameters; figures go to
/// "rows".
json new_report(const std::string& program, const Options& options, int ranks = 1);

/// Columns by the keys of the rows, aligned; numbers to four digits.
void print_table(const json& rows, const std::vector<std::string>& columns);

/// Prints the rows and writes the file that the options name.
void finish(const json& report, const std::vector<std::string>& columns, const Options& options);

}  // namespace bulbus::bench
