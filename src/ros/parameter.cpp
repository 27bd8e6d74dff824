#include "forming_sim/ros/parameter.h"

#include <algorithm>

#include "forming_sim/config/words.h"
#include "forming_sim/ros/publisher.h"

namespace forming_sim {

void warn_of_unknown_parameters(const ros::NodeHandle& node, std::vector<std::string> known) {
  const std::vector<std::string>& published = PublishOptions::parameters();
  known.insert(known.end(), published.begin(), published.end());
  std::vector<std::string> all;
  if (!node.getParamNames(all)) return;
  const std::string own = node.getNamespace() + "/";
  for (const std::string& name : all) {
    if (name.rfind(own, 0) != 0) continue;
    const std::string rest = name.substr(own.size());
    if (rest.find('/') != std::string::npos || std::find(known.begin(), known.end(), rest) != known.end()) continue;  // deeper ones are of actionlib and rosconsole
    ROS_WARN("parameter %s is not known and does nothing%s; the parameters are %s", name.c_str(), did_you_mean(rest, known).c_str(), one_of(known, ", ").c_str());
  }
}

}  // namespace forming_sim
