#include "benchmarks/common.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>

#include "core/io/json_file.hpp"

namespace bulbus::bench {
namespace {

std::string output_of(const std::string& command) {
  std::string text;
  if (FILE* pipe = popen(command.c_str(), "r")) {
    char line[256];
    while (std::fgets(line, sizeof line, pipe)) text += line;
    pclose(pipe);
  }
  text.erase(text.find_last_not_of(" \n") + 1);
  return text.empty() ? "unknown" : text;
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::vector<int> numbers(const std::string& list) {
  std::vector<int> n;
  std::stringstream in(list);
  for (std::string item; std::getline(in, item, ',');) n.push_back(std::stoi(item));
  return n;
}

std::string cell(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number_float()) return value.is_null() ? "-" : value.dump();
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value.get<double>());
  return text;
}

}  // namespace

Options parse(int argc, char** argv, std::vector<int> sizes, std::vector<int> smoke_sizes, int repetitions) {
  Options o;
  o.repetitions = repetitions;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    const bool valued = i + 1 < argc;
    if (arg == "--smoke")
      o.smoke = true;
    else if (arg == "-n" && valued)
      o.sizes = numbers(argv[++i]);
    else if (arg == "-r" && valued)
      o.repetitions = std::stoi(argv[++i]);
    else if (arg == "--refine" && valued)
      o.refine = std::stoi(argv[++i]);
    else if (arg == "-o" && valued)
      o.out = argv[++i];
    else
      o.rest.push_back(arg);
  }
  if (o.smoke) o.repetitions = 1;
  if (o.sizes.empty()) o.sizes = o.smoke ? smoke_sizes : sizes;
  return o;
}

void single_threaded(char** argv) {
  if (argv[1] && argv[1] == std::string("--child")) return;  // who started it has said how many
  const char* one = std::getenv("OMP_NUM_THREADS");
  if (one && std::string(one) == "1" && std::getenv("OPENBLAS_NUM_THREADS")) return;
  for (const char* name : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"})
    setenv(name, "1", 1);
  execv("/proc/self/exe", argv);
}

void reset_peak_resident() { std::ofstream("/proc/self/clear_refs") << 5; }

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

double median(std::vector<double> v) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  const std::size_t n = v.size();
  return n % 2 ? v[n / 2] : (v[n / 2 - 1] + v[n / 2]) / 2;
}

json new_report(const std::string& program, const Options& o, int ranks) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  double load[1] = {-1};
  getloadavg(load, 1);
  return {{"program", program},
          {"commit", output_of("git -C " BULBUS_SOURCE " describe --always --dirty --abbrev=12 2>/dev/null")},
          {"compiler", "C++ " __VERSION__},
          {"flags", BULBUS_FLAGS},
          {"processor", processor()},
          {"processors", sysconf(_SC_NPROCESSORS_ONLN)},
          {"load_at_start", load[0]},
          {"threads", 1},
          {"ranks", ranks},
          {"parameters",
           {{"sizes", o.sizes}, {"repetitions", o.repetitions}, {"refine", o.refine}, {"smoke", o.smoke}}},
          {"rows", json::array()}};
}

void print_table(const json& rows, const std::vector<std::string>& columns) {
  std::vector<std::vector<std::string>> text{columns};
  for (const json& row : rows) {
    text.emplace_back();
    for (const auto& c : columns) text.back().push_back(row.contains(c) ? cell(row[c]) : "-");
  }
  for (const auto& line : text) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      std::size_t width = 0;
      for (const auto& l : text) width = std::max(width, l[c].size());
      std::printf("%s%-*s", c ? "  " : "", static_cast<int>(width), line[c].c_str());
    }
    std::printf("\n");
  }
  std::fflush(stdout);
}

void finish(const json& report, const std::vector<std::string>& columns, const Options& options) {
  print_table(report["rows"], columns);
  if (!options.out.empty()) write_json(options.out, report);
}

}  // namespace bulbus::bench
