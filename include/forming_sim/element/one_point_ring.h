#pragma once
// The one-point quadrilateral that is turned about the y axis.
//
// Its third edge vector is the hoop of mean radius, x_3 = sum_a o_a r_a with o_a = int N_a dA / A, so that
// at the start 2 pi x_3 A is the exact volume; the mean gradient b_a of one_point.h is weighted by
// the radius, b_a = 1/V0 int grad N_a 2 pi R dA. Then
//   V0 (b_a + o_a/R e_r) = 2 pi int grad(R N_a) dA,
// whose sum over the cells around a node inside is nothing: uniform states are exact on any
// mesh, and a node on the axis, which has no radial motion, needs no rule of its own.
//
// The hoop strain varies across the cell by
//   e_h,i = r_i/x_3 - R_i/X_3,   r_i = 1/4 sum_a xi_i,a r_a,
// which vanishes where all radii are multiplied by one number. With the fibre strain e_d that
// varies with the same coordinate it makes the plane strain tensor of hourglass.h, fibre and hoop.
// This is what a section resists with that turns in its plane.
#include "forming_sim/element/hourglass_strain.h"
#include "forming_sim/element/ring_step.h"
#include "forming_sim/element/time_step.h"

namespace forming_sim {

/// The other coordinate: e_d is a strain along E_d that varies with xi_(1-d).
template <class T> struct HoopStrain {
  using Cell = OnePoint<2, true>;
  T slope[2];      ///< r_i
  T over;          ///< 1/x_3
  T share[4];      ///< o_a

  HoopStrain() = default;
  HoopStrain(const double* constants, const Edges<T, 2, true>& e, const Vector<T, 2>* x, HourglassStrain<T, 2>& strain) : over(e.up[2][0]) {
    for (int a = 0; a < 4; ++a) load(constants, Cell::hoop + a, share[a]);
    for (int d = 0; d < 2; ++d) {
      const int i = 1 - d;
      slope[i] = T(0.25 * kCornerSides[0][i]) * x[0][0];
      for (int a = 1; a < 4; ++a) slope[i] += T(0.25 * kCornerSides[a][i]) * x[a][0];
      T start;
      load(constants, Cell::hoop_start + i, start);
      strain.plane[d].b = slope[i] * over - start;
    }
  }
  /// d e_h,i / d r_a
  T rate(int i, int a) const { return over * (T(0.25 * kCornerSides[a][i]) - slope[i] * over * share[a]); }
};

/// The stable step of such a cell. Its stiffness is the sum of
///   2 mu dev : dev of the mean strains (four of them: see ring_step.h, with the corners' own masses),
///   K J^2 (grad V/V)(grad V/V),
///   1/3 C of the two plane strain tensors that vary, C the moduli of plane stress, of norm E/(1-nu^2) (1+nu),
/// and the largest eigenvalue of a sum is not larger than the sum of theirs. The guard of the corners adds what element/corner_guard.h says.
template <class T> class OnePointRingBound {
  using Cell = OnePoint<2, true>;

 public:
  T omega2;

  OnePointRingBound(const CellGroup& g, const Vector<T, 2>*) : g_(g) {}

  template <class Hourglass>
  void set(const Edges<T, 2, true>& e, const Vector<T, 2>* x, const double* memory, const T& V0, const double* constants, const Vector<T, 2>* sums, const Hourglass& hourglass) {
    const T J = e.volume / V0, rho(g_.density);
    const PlaneModuli moduli(g_.solid);
    Symmetric<T, 3> M;
    for (int i = 0; i < 6; ++i) M[i] = T(0);
    T gram[2][3] = {{T(0), T(0), T(0)}, {T(0), T(0), T(0)}}, mixed[4] = {T(0), T(0), T(0), T(0)};  // of (fibre, hoop): 11 22 12
    sum_ = T(0);
    for (int a = 0; a < 4; ++a) {
      T mass, w[2];
      load(constants, Cell::share + a, mass);
      const T axial = T(1) / mass, radial = select(x[a][0] > T(0), axial, T(0));
      for (int m = 0; m < 2; ++m) w[m] = corner_weight<T, 2>(constants, a, m);
      const T gr = w[0] * e.up[0][0] + w[1] * e.up[1][0], gz = w[0] * e.up[0][1] + w[1] * e.up[1][1];
      T share;
      load(constants, Cell::hoop + a, share);
      const T hoop = share * e.up[2][0];
      add_deviatoric(M, radial, axial, gr, gz, hoop);
      sum_ += radial * (gr + hoop) * (gr + hoop) + axial * gz * gz;
      const Vector<T, 2> fibre[2] = {hourglass.fibre_rate(e, sums, 0, a), hourglass.fibre_rate(e, sums, 1, a)};
      const T turn[2] = {hourglass.hoop_rate(1, a), hourglass.hoop_rate(0, a)};
      for (int d = 0; d < 2; ++d) {
        gram[d][0] += radial * fibre[d][0] * fibre[d][0] + axial * fibre[d][1] * fibre[d][1];
        gram[d][1] += radial * turn[d] * turn[d];
        gram[d][2] += radial * fibre[d][0] * turn[d];
      }
      mixed[0] += radial * fibre[0][0] * fibre[1][0] + axial * fibre[0][1] * fibre[1][1];
      mixed[1] += radial * fibre[0][0] * turn[1];
      mixed[2] += radial * turn[0] * fibre[1][0];
      mixed[3] += radial * turn[0] * turn[1];
    }
    T own[2];
    for (int d = 0; d < 2; ++d) {
      const T trace = gram[d][0] + gram[d][1] + T(2 * moduli.nu) * gram[d][2];
      const T det = T(1 - moduli.nu * moduli.nu) * (gram[d][0] * gram[d][1] - gram[d][2] * gram[d][2]);
      own[d] = T(0.5) * (trace + sqrt(larger(trace * trace - T(4) * det, T(0))));
    }
    const T cross2 = T((1 + moduli.nu) * (1 + moduli.nu)) * (mixed[0] * mixed[0] + mixed[1] * mixed[1] + mixed[2] * mixed[2] + mixed[3] * mixed[3]);
    const T half = T(0.5) * (own[0] - own[1]), varied = T(0.5) * (own[0] + own[1]) + sqrt(half * half + cross2);
    const T tangent = point_tangent(g_.solid, e, J, memory);
    const T volumetric = T(g_.solid.K) * pressure_tangent(g_.solid, J) * sum_;
    omega2 = (T(2 * g_.solid.mu) * tangent * largest_eigenvalue(M) + volumetric + T(moduli.plane / 3) * varied) / rho;
    sum_ = sum_ * e.volume * e.volume / (rho * V0);
    V_ = e.volume;
    extent_ = extent(e);
  }
  StepRates<T> rates(const T& rate) const { return {omega2, viscous_damping<T, 2>(g_, sum_, V_, extent_, rate)}; }

 private:
  const CellGroup& g_;
  T sum_, V_, extent_;
};

}  // namespace forming_sim
