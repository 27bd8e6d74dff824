#pragma once
// The version that is written into every file of a run.
namespace forming_sim {

/// "0.1.0": the version of package.xml and CMakeLists.txt.
const char* package_version();

}  // namespace forming_sim
