// Figures of the package, each printed by a command: forming_bench COMMAND [ARGUMENT...] [--output DIR]
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <string>

#include "rows.h"

namespace {

using namespace forming_sim::bench;

struct Command {
  std::vector<Row> (*run)(const Request&);
  std::size_t most_arguments;
  void (*print)(const std::vector<Row>&) = forming_sim::bench::print;
};
void printed_as_it_ran(const std::vector<Row>&) {}

const std::map<std::string, Command> kCommands{{"calibrate", {calibrate, 3}}, {"contact", {contact, 16, printed_as_it_ran}}, {"costs", {costs, 0}},
                                               {"material", {material, 2}},   {"paper", {paper, 1}},     {"speed", {speed, 1, printed_as_it_ran}}, {"speed-error", {speed_error, 16, printed_as_it_ran}},
                                               {"stability", {stability, 16}}};

int refuse(const std::string& why) {
  std::fprintf(stderr, "forming_bench: %s; see forming_bench --help\n", why.c_str());
  return 2;
}

int usage(std::FILE* to) {
  std::fprintf(to,
               "usage: forming_bench COMMAND [ARGUMENT...] [--output DIR]\n"
               "  costs    ns per element and step of each stage, contact per pair, gain of a second thread\n"
               "  contact  two blocks meet, by speed, layer and mesh: crossings, halvings, momentum, energy, cost\n"
               "  contact shaken  a sheet between two tools that shake, for a million steps\n"
               "  contact exact [PROBLEM ...]  error against mesh, layer and wall time where the answer of contact is known:\n"
               "           bounce, bars, hertz, hertz-sphere, patch, capstan, incline, or all of these (some minutes);\n"
               "           writes DIR/contact-exact.csv and plots of each problem too\n"
               "  material  layered laws against a measured tension-compression-tension curve\n"
               "  material LAW.yaml HISTORY.csv  a law (the fields of a scene's material) at a point, driven by the\n"
               "           columns F11, F12, ... F33 or e11, e22, e33 (true strain), and time; a diagonal component\n"
               "           without a column is free of stress; writes DIR/material.csv\n"
               "  calibrate [CURVE.csv E=70.5e9 nu=0.34]  layers from a measured curve, columns true_strain and\n"
               "           true_stress_Pa or true_stress_MPa from the elastic limit on; writes DIR/layers.yaml\n"
               "  paper [FIGURE]  the figures and claims of the paper: 3 to 11, 14 to 20, section-2.2, section-2.4,\n"
               "           section-3.1, section-3.3, or all of these (some minutes: 19 and 20 are forming\n"
               "           runs); and long-runs, a million steps by each method\n"
               "  speed [large | short]  ns of every stage of a step an element, on 1 and 2 threads, by family, motion, layers\n"
               "           and size; beside the bytes it moves and its operations, and this machine's bandwidth and\n"
               "           arithmetic peak (some minutes); writes DIR/speed.csv and a plot too\n"
               "  speed-error [PROBLEM ...]  error against wall time of elements, meshes, time steps, mass scaling and\n"
               "           layers on problems whose answer is known, and of CalculiX (ccx) where it is installed:\n"
               "           bending, cook, taylor, cube, sphere, torsion, impact, flange, flange-time, slivers, layers,\n"
               "           release, or all of these (some minutes); writes DIR/speed-error.csv and a plot of each problem too\n"
               "  stability [CASE ...]  hard cases and what must hold in them: incompressible, large-strain, shapes,\n"
               "           steps, spin, impact, swings, sudden, or all of these; and ten-million-steps\n"
               "Prints a table; with --output also DIR/COMMAND.json, and the figures of a command as CSV and PNG.\n");
  return to == stdout ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0)) return usage(stdout);
  const auto command = argc > 1 ? kCommands.find(argv[1]) : kCommands.end();
  if (argc < 2) return usage(stderr);
  if (command == kCommands.end()) {
    std::string names;
    for (const auto& [name, unused] : kCommands) names += (names.empty() ? "" : ", ") + name;
    return refuse(std::string("there is no command ") + argv[1] + "; the commands are " + names);
  }
  Request request;
  for (int i = 2; i < argc; ++i) {
    const bool output = std::strcmp(argv[i], "--output") == 0;
    if (output && i + 1 == argc) return refuse("--output needs a directory");
    if (output) request.directory = argv[++i];
    else if (argv[i][0] == '-') return refuse(std::string("the option ") + argv[i] + " does not exist");
    else request.arguments.emplace_back(argv[i]);
  }
  if (const std::size_t most = command->second.most_arguments; request.arguments.size() > most)
    return refuse(command->first + " takes " + (most == 0 ? "no arguments" : "at most " + std::to_string(most)) + ", given " + request.arguments[most] + " beyond them");
  try {
    if (!request.directory.empty()) std::filesystem::create_directories(request.directory);  // what cannot be kept is not begun
    const std::vector<Row> rows = command->second.run(request);
    command->second.print(rows);
    if (!request.directory.empty()) write(request.directory, command->first, rows);
    if (std::fflush(stdout) != 0) throw std::runtime_error("the table could not be written");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forming_bench %s: %s\n", command->first.c_str(), error.what());
    return 1;
  }
  return 0;
}
