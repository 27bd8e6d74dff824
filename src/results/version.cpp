#include "forming_sim/results/version.h"

namespace forming_sim {

const char* package_version() { return FORMING_SIM_VERSION; }

}  // namespace forming_sim
