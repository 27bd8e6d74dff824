#include "forming_sim/material/forming_limit.h"

#include <algorithm>

namespace forming_sim {

double limit_strain(const FormingLimitConfig& curve, double minor) {
  const std::vector<double>&e2 = curve.minor_strains, &e1 = curve.major_strains;
  const std::size_t next = std::upper_bound(e2.begin(), e2.end(), minor) - e2.begin();
  if (next == 0) return e1.front();
  if (next == e2.size()) return e1.back();
  return e1[next - 1] + (e1[next] - e1[next - 1]) * (minor - e2[next - 1]) / (e2[next] - e2[next - 1]);
}

double limit_ratio(const FormingLimitConfig& curve, double major, double minor) { return major / limit_strain(curve, minor); }

}  // namespace forming_sim
