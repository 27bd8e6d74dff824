#pragma once
// Sends a scene to a server and follows the run on the terminal.
#include <string>

namespace forming_sim {

struct ClientRequest {
  std::string scene_file;
  std::string server = "forming_server";  ///< in the namespace of the client, or with / from the root
  std::string output_directory;  ///< empty: the server chooses
  std::string resume;            ///< checkpoint file; empty: from the start
  int threads = 0;               ///< 0: the server's
  double wait_s = 10;            ///< for the server to appear
};

/// Reads the options of forming_client. Throws std::invalid_argument with a sentence.
ClientRequest read_arguments(int argc, char** argv);
extern const char* const client_usage;

/// Runs the request; prints progress to stdout and faults to stderr. A stop
/// signal cancels the goal. Returns 0 only for a run that succeeded, 1 otherwise,
/// 2 for a scene with faults or a goal that was rejected, 130 where a stop signal cancelled it.
int run_client(const ClientRequest& request);

}  // namespace forming_sim
