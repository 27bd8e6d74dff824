#pragma once
// What is wrong with an input, said so that its author can mend it.
#include <stdexcept>
#include <string>
#include <vector>

namespace forming_sim {

/// Outcome codes of a run: those of msg/ResultCode.msg, where they are explained.
enum class Code : int {
  none = 0,               ///< not set; never reported as an outcome
  success = 1,
  invalid_scene = 2,
  busy = 3,
  cancelled = 4,
  mesh_error = 5,         ///< an element inverted or a mesh cannot be used
  initial_penetration = 6,
  contact_error = 7,      ///< a step could not be made free of crossings
  output_error = 8,       ///< a file could not be written or read
  resume_error = 9,
  internal_error = 10,
  limit_reached = 11      ///< a settle stage ended at its limit before coming to rest
};
const char* name_of(Code code);

/// One fault of a scene: the field's path ("bodies[0].material.density"), what
/// was given and what would be right.
struct Fault {
  Code code = Code::invalid_scene;
  std::string field;
  std::string given;
  std::string remedy;
  std::string sentence() const { return field + ": given " + given + "; " + remedy; }
};

/// Thrown by whatever cannot go on; carries its code.
class Error : public std::runtime_error {
 public:
  Error(Code code, const std::string& what) : std::runtime_error(what), code_(code) {}
  Code code() const { return code_; }

 private:
  Code code_;
};

/// Thrown when a scene is refused: all its faults at once.
class SceneError : public Error {
 public:
  explicit SceneError(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

}  // namespace forming_sim
