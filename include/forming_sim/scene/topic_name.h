#pragma once
// Names of a scene as parts of ROS names.
#include <cctype>
#include <string>

namespace forming_sim {

/// A name of a tool as a name of a topic: letters, digits and _; others become _. One that begins with a digit has tool_ before it.
inline std::string topic_name(const std::string& name) {
  std::string topic;
  for (const unsigned char c : name) topic += std::isalnum(c) ? static_cast<char>(c) : '_';
  return topic.empty() || std::isdigit(static_cast<unsigned char>(topic.front())) ? "tool_" + topic : topic;
}

}  // namespace forming_sim
