#include "forming_sim/config/fault.h"

namespace forming_sim {

const char* name_of(Code code) {
  switch (code) {
    case Code::none: return "none";
    case Code::success: return "success";
    case Code::invalid_scene: return "invalid_scene";
    case Code::busy: return "busy";
    case Code::cancelled: return "cancelled";
    case Code::mesh_error: return "mesh_error";
    case Code::initial_penetration: return "initial_penetration";
    case Code::contact_error: return "contact_error";
    case Code::output_error: return "output_error";
    case Code::resume_error: return "resume_error";
    case Code::internal_error: return "internal_error";
    case Code::limit_reached: return "limit_reached";
  }
  return "unknown";
}

namespace {

std::string all_sentences(const std::vector<Fault>& faults) {
  std::string text = faults.size() == 1 ? "The scene has a fault."
                                        : "The scene has " + std::to_string(faults.size()) + " faults.";
  for (const Fault& fault : faults) text += "\n" + fault.sentence();
  return text;
}

/// The code of all faults, where they agree.
Code common_code(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    if (fault.code != faults.front().code) return Code::invalid_scene;
  }
  return faults.empty() ? Code::invalid_scene : faults.front().code;
}

}  // namespace

SceneError::SceneError(std::vector<Fault> faults)
    : Error(common_code(faults), all_sentences(faults)),
      faults_(std::move(faults)) {}

}  // namespace forming_sim
