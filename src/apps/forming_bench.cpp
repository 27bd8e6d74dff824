// Figures of the package, each printed by a command: forming_bench COMMAND --output DIR
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <string>

#include "rows.h"

int main(int argc, char** argv) {
  using namespace forming_sim::bench;
  const std::map<std::string, std::vector<Row> (*)()> commands{{"bending", bending}, {"costs", costs}, {"impact", impact}};
  const auto command = argc > 1 ? commands.find(argv[1]) : commands.end();
  const bool into = argc == 4 && std::strcmp(argv[2], "--output") == 0;
  if (command == commands.end() || (argc != 2 && !into)) {
    const bool help = argc == 2 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0);
    std::fprintf(help ? stdout : stderr,
                 "usage: forming_bench COMMAND [--output DIR]\n"
                 "  costs    ns per element and step of each stage, contact per pair, gain of a second thread\n"
                 "  bending  moment and springback of a bent sheet, by element family and cells\n"
                 "  impact   a bar against a plane and against another bar\n"
                 "Prints a table; with --output also DIR/COMMAND.json.\n");
    return help ? 0 : 2;
  }
  try {
    const std::vector<Row> rows = command->second();
    print(rows);
    if (into) write(argv[3], command->first, rows);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forming_bench %s: %s\n", command->first.c_str(), error.what());
    return 1;
  }
  return 0;
}
