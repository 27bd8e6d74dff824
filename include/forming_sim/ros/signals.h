#pragma once
// SIGINT, SIGTERM and SIGHUP as a flag, so that a program ends its work before ROS goes.

namespace forming_sim {

/// Call it after ros::init with ros::init_options::NoSigintHandler. A limit of file sizes is a full disk from then on: the write says so.
void catch_stop_signals();
/// True once one of the signals has come.
bool stop_requested();
/// How often they have come.
int stops_requested();
/// Waits for the ROS master, at most so long; says so on stderr when it is not
/// there at once. False where it did not come, or a signal came first.
bool wait_for_master(const char* program, double wait_s = 1e9);

}  // namespace forming_sim
