#include "forming_sim/ros/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace forming_sim {

std_msgs::ColorRGBA scale_colour(double fraction) {
  // Viridis at ninths.
  static constexpr std::array<std::array<float, 3>, 10> points{{{0.267F, 0.005F, 0.329F},
                                                                {0.283F, 0.156F, 0.471F},
                                                                {0.243F, 0.287F, 0.537F},
                                                                {0.191F, 0.407F, 0.556F},
                                                                {0.147F, 0.513F, 0.557F},
                                                                {0.120F, 0.622F, 0.535F},
                                                                {0.208F, 0.719F, 0.473F},
                                                                {0.430F, 0.808F, 0.346F},
                                                                {0.710F, 0.869F, 0.169F},
                                                                {0.993F, 0.906F, 0.144F}}};
  const double place = std::clamp(std::isfinite(fraction) ? fraction : 0.0, 0.0, 1.0) * (points.size() - 1);
  const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(place), points.size() - 2);
  const float t = static_cast<float>(place - static_cast<double>(low));
  std_msgs::ColorRGBA colour;
  colour.r = (1 - t) * points[low][0] + t * points[low + 1][0];
  colour.g = (1 - t) * points[low][1] + t * points[low + 1][1];
  colour.b = (1 - t) * points[low][2] + t * points[low + 1][2];
  colour.a = 1;
  return colour;
}

}  // namespace forming_sim
