#pragma once
// Parameters of a node.
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <ros/ros.h>

#include "forming_sim/config/fault.h"

namespace forming_sim {

/// Throws Error(invalid_scene) that names the parameter, what was given and what would be right.
[[noreturn]] inline void refuse_parameter(const ros::NodeHandle& node, const std::string& name, const std::string& given, const std::string& remedy) {
  throw Error(Code::invalid_scene, "parameter " + node.resolveName(name) + ": given " + given + "; " + remedy);
}

/// The parameter where it is set, else what `value` holds. kind: of the value, for the message ("a number").
/// Refuses one of another kind.
template <class T> void read_parameter(const ros::NodeHandle& node, const std::string& name, const std::string& kind, T& value) {
  XmlRpc::XmlRpcValue given;
  if (!node.getParam(name, given)) return;
  if constexpr (std::is_same_v<T, double>)  // roslaunch knows a number by its point: 3e8 comes as a text
    if (given.getType() == XmlRpc::XmlRpcValue::TypeString) {
      std::istringstream text(static_cast<std::string>(given));
      if (text >> value && text.peek() == std::istringstream::traits_type::eof()) return;
    }
  const bool rounded = std::is_same<T, int>::value && given.getType() == XmlRpc::XmlRpcValue::TypeDouble;
  if (!rounded && node.getParam(name, value)) return;
  std::ostringstream text;
  given.write(text);
  refuse_parameter(node, name, text.str(), "give " + kind);
}

/// Warns of parameters of the node that it does not know: a misspelt one would do nothing.
void warn_of_unknown_parameters(const ros::NodeHandle& node, std::vector<std::string> known);

}  // namespace forming_sim
