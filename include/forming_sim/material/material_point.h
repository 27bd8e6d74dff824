#pragma once
// A law at a single point, driven through a history of deformation: the same formulas
// that the elements run, for one tetrahedron whose initial edges are the unit
// vectors, x_m = F e_m.
#include <array>
#include <memory>
#include <vector>

#include "forming_sim/material/constants.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class MaterialPoint {
 public:
  explicit MaterialPoint(const MaterialConfig& config);
  /// The tables of its curves must outlive the point.
  explicit MaterialPoint(const SolidConstants& solid);

  struct Answer {
    Mat3 stress;    ///< Cauchy, Pa
    double energy;  ///< stored, per initial volume, J/m3
  };

  /// The time of each of the following steps, s, of laws that ask for it; 1 at first.
  void set_step(double dt) { forming_sim::set_step(solid_, dt); }
  /// The step from the last deformation gradient to F; without `keep` it is only tried.
  Answer step(const Mat3& F, bool keep = true);

  /// The step to a deformation gradient of which the diagonal components marked free
  /// are found such that their normal stresses vanish; they start from the last ones.
  /// Throws Error(invalid_scene) where none is found.
  Answer step_with_free(Mat3 F, const std::array<bool, 3>& free);

  /// Axial stretch along x with free sides; the axial stress, Pa.
  double uniaxial(double stretch) { return step_with_free(Vec3(stretch, 1, 1).asDiagonal().toDenseMatrix(), {false, true, true}).stress(0, 0); }

  const SolidConstants& solid() const { return solid_; }
  const Mat3& deformation() const { return F_; }          ///< the last that was kept
  double plastic_strain() const;                          ///< the weighted mean of the layers'
  double dissipated() const { return dissipated_; }       ///< per initial volume so far, J/m3
  const std::vector<double>& memory() const { return memory_; }  ///< as material/law.h lays it out

 private:
  void start();

  std::shared_ptr<CurveTables> tables_ = std::make_shared<CurveTables>();  ///< solid_ points into them, also that of a copy
  SolidConstants solid_;
  std::vector<double> memory_;
  Mat3 F_ = Mat3::Identity();
  double dissipated_ = 0;
};

}  // namespace forming_sim
