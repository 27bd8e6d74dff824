#pragma once
// What the files of a run must remember from its earlier parts: it goes into
// the checkpoint, so that a resumed run ends with the same summary.
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/simulation/observer.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A greatest value and the element where it was found.
struct Peak {
  double value = 0;
  int element = -1;                 ///< -1: nothing found yet
  Vec3 position = Vec3::Zero();     ///< centre of the element or facet, m
  double time = 0;                  ///< s
  /// The greater of this and another, of two that are equal the one that was there; what is no number is none.
  void rise_to(const Peak& other) {
    if (other.element >= 0 && !std::isnan(other.value) && (element < 0 || other.value > value)) *this = other;
  }
};

/// A face of a body that spans a corner of a tool (results/spanned_corner.h).
struct SpannedCorner {
  Peak peak;          ///< how far it stands off, over its length
  std::string tool;
  double length = 0;  ///< of the face, m
  double share = 0;   ///< of the force of the tool that is borne by such corners of it
  void rise_to(const SpannedCorner& other) {
    if (other.peak.element >= 0 && (peak.element < 0 || other.peak.value > peak.value)) *this = other;
  }
};

/// The largest kinetic over internal energy of a stage, of the times at which the internal energy
/// was at least kMeaningful of what it was at the stage's end: before a tool has done any work the
/// ratio is large and says nothing. What the end will be is not known on the way, so the largest
/// ratio of each level of internal energy is kept, levels 1 % apart.
class KineticPeak {
 public:
  static constexpr double kMeaningful = 0.01;
  void look(double kinetic, double internal);
  /// least: of the internal energy at the end, from which on it is looked at. NaN where there was no internal energy.
  double at_end(double internal, double least = kMeaningful) const;
  std::map<int, double> levels;  ///< ln(internal)/ln(1.01), rounded down; largest ratio there
};

/// A stage that has ended.
struct StageRecord {
  std::string name, kind;
  double end_time = 0;                           ///< s
  double kinetic = 0, elastic = 0, plastic = 0;  ///< J (J/m in plane strain)
  double kinetic_over_internal_peak = std::numeric_limits<double>::quiet_NaN();  ///< KineticPeak
  double kinetic_over_internal() const;          ///< kinetic / (elastic + plastic); NaN where that is 0
};

/// What a tool or a set has felt so far, and where it is.
struct FeltAt {
  Reaction felt;
  Vec3 position = Vec3::Zero();  ///< m
};

struct RunRecord {
  std::optional<double> thickness_initial, thickness_min;  ///< m; absent without sets top and bottom
  Peak surface_strain, thinning;                           ///< over all times of the history
  std::vector<Peak> limit_ratio;                           ///< of the bodies with a forming limit, over all times of the history
  Peak pressed;                                            ///< -tr sigma/3 over the bulk modulus, of metals, over all frames
  Peak pressed_cells;                                      ///< how many there were, over all frames
  SpannedCorner spanned;                                   ///< over all frames
  std::optional<Peak> surface_strain_formed;               ///< at the end of the last form stage so far
  std::optional<double> angle_formed_deg;                  ///< likewise
  std::optional<double> kinetic_over_internal_formed;      ///< likewise
  std::optional<double> kinetic_over_internal_forming;     ///< largest peak of the form stages so far
  KineticPeak kinetic_peak;                                ///< of the running stage
  std::vector<StageRecord> stages;
  std::vector<std::string> notes;                          ///< said in the summary's warnings
  double history_time = 0;                                 ///< of the last row, s
  std::vector<FeltAt> history_tools;                       ///< what the tools had felt then
  std::vector<FeltAt> history_reactions;                   ///< on the probes then

  std::string to_json() const;
  /// Throws Error(resume_error) where the text is not such a record.
  static RunRecord from_json(const std::string& text);
};

}  // namespace forming_sim
