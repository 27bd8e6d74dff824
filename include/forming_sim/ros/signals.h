#pragma once
// What asks a program to stop, signals and rosnode kill, as a flag, so that it ends its work before ROS goes.

namespace forming_sim {

/// ros::init without its handler of SIGINT, with more `options`. Words NAME:=VALUE that are no names of ROS are told on stderr; false then.
bool init_node(int& argc, char** argv, const char* program, unsigned options = 0);
/// Call it after init_node(). A limit of file sizes is a full disk from then on: the write says so.
void catch_stop_signals();
/// The shutdown that rosnode kill asks for, or the master when another node takes the name, is such a signal from now on, and its reason is told. Call it while a
/// ros::NodeHandle lives: ROS itself would close the topics at once, and no result went out.
void catch_shutdown_requests();
/// True once one of them has come.
bool stop_requested();
/// How often they have come.
int stops_requested();
/// Waits for the ROS master, at most so long; says so on stderr when it is not
/// there at once. False where it did not come, or a signal came first.
bool wait_for_master(const char* program, double wait_s = 1e9);

}  // namespace forming_sim
