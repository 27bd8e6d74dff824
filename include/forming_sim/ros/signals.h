#pragma once
// SIGINT and SIGTERM as a flag, so that a program ends its work before ROS goes.

namespace forming_sim {

/// Call it after ros::init with ros::init_options::NoSigintHandler.
void catch_stop_signals();
/// True once either signal has come.
bool stop_requested();

}  // namespace forming_sim
