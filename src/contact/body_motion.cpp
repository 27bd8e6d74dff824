#include "forming_sim/contact/body_motion.h"

#include <Eigen/Dense>
#include <algorithm>

#include "forming_sim/tensor/repeat.h"

namespace forming_sim {

namespace {
constexpr double kHold = 1e6;      ///< K, of the masses: what is held counts so much more
constexpr double kRest = .6;       ///< of all holds
constexpr int kRounds = 64;        ///< with them kRest/kRounds of all holds lead halfway, some times as many to rounding
constexpr double kDisagreed = .1;  ///< of the squares of what is told, beside the motion of the masses, which no rigid motion has: it tells nothing

constexpr double kRounding = 1e-12; ///< of the squares of what is told: of a body that goes exactly as it is told nothing else is left

/// So many of `count` that no more than `most` are asked; the nodes of structured cells repeat, and a prime stride does not fall in with them.
std::size_t stride_of(std::size_t count, std::size_t most) {
  const auto is_prime = [](std::size_t n) {
    for (std::size_t d = 2; d * d <= n; ++d)
      if (n % d == 0) return false;
    return true;
  };
  std::size_t stride = (count + most - 1) / most;
  while (stride > 1 && !is_prime(stride)) ++stride;
  return std::max<std::size_t>(stride, 1);
}

// The modes: along y alone; along x, y and about z; along all and about all. B at r is the unit vector e of the axis, or of a turn e x r.
constexpr int kTurn = 3;  ///< what is added to the axis of a turn
template <int modes> constexpr int kMode[6] = {0, 1, 2, kTurn, kTurn + 1, kTurn + 2};
template <> constexpr int kMode<1>[1] = {1};
template <> constexpr int kMode<3>[3] = {0, 1, kTurn + 2};

/// B . u of a mode at r.
double along_mode(int mode, const Node& r, const Node& u) {
  if (mode < kTurn) return u[mode];
  const int i = (mode - kTurn + 1) % 3, j = (mode - kTurn + 2) % 3;
  return r[i] * u[j] - r[j] * u[i];
}
/// A^-1 b of a symmetric A; 0 where A is.
template <class Square, class Right> Right solved(const Square& A, const Right& b) {
  if constexpr (Square::RowsAtCompileTime == 1) return A(0, 0) != 0 ? Right(b / A(0, 0)) : Right(Right::Zero());
  else return A.ldlt().solve(b);
}
}  // namespace

MovingBody::MovingBody(int first_node, int nodes, int modes) : first_node_(first_node), nodes_(nodes), modes_(modes) {}

bool MovingBody::hold(const std::vector<double>& inverse_mass, const std::vector<HeldNode>& held) {
  std::vector<double> mass(nodes_);
  for (int n = 0; n < nodes_; ++n) {
    const double inverse = inverse_mass[first_node_ + n];
    mass[n] = inverse > 0 ? 1 / inverse : 0;
  }
  const bool changed = mass != mass_;
  mass_.swap(mass);
  std::vector<const HeldNode*> own;
  for (const HeldNode& h : held)
    if (h.node >= first_node_ && h.node < first_node_ + nodes_) own.push_back(&h);
  held_.clear();
  held_points_ = 0;
  for (std::size_t i = 0, stride = stride_of(own.size(), kHeldAsked); i < own.size(); i += stride, ++held_points_) {
    // I - P has the eigenvalue 1 along what is held
    const Eigen::SelfAdjointEigenSolver<Mat3> directions(Mat3(Mat3::Identity() - own[i]->projector));
    for (int k = 0; k < 3; ++k)
      if (directions.eigenvalues()[k] > 0.5) held_.push_back({own[i]->node, node(directions.eigenvectors().col(k))});
  }
  return changed;
}

// p: of the modes, of six (V, w); the velocity B p at r = x - c, of six B = (1, -r x); M = sum m B^T B about the masses' centre c, b = B^T n, G = sum b b^T, g = sum b n.v.
template <int modes> BodyMotion MovingBody::of(const MassSums& masses, const std::vector<Hold>& holds, double points) {
  using Vector = Eigen::Matrix<double, modes, 1>;
  using Square = Eigen::Matrix<double, modes, modes>;
  const auto rigid = [](const Node& c, const Vector& p) {
    WholeMotion motion;
    motion.c = c;
    if constexpr (modes == 1) {
      motion.v[1] = p[0];
    } else if constexpr (modes == 3) {
      motion.v = node(p[0], p[1], 0);
      motion.w[2] = p[2];
    } else {
      motion.v = node(p[0], p[1], p[2]);
      motion.w = p.template tail<3>();
    }
    return motion;
  };
  const double mass = masses.mass;
  const Node momentum(masses.momentum), first(masses.first);
  Node from_c = Node::Zero(), c(masses.from);  // the centre from where the sums begin
  if (mass > 0) from_c = first / mass, c += from_c;
  else if (!holds.empty()) c = holds[0].x;
  c[3] = 0;
  // About c: sum m r_i r_j, and L = sum m r x v
  const Node square = Node(masses.square) - from_c.cwiseProduct(first);
  const Vec3 L(masses.behind[1] - masses.ahead[1] - from_c[1] * momentum[2] + from_c[2] * momentum[1], masses.behind[2] - masses.ahead[2] - from_c[2] * momentum[0] + from_c[0] * momentum[2],
               masses.behind[0] - masses.ahead[0] - from_c[0] * momentum[1] + from_c[1] * momentum[0]);

  constexpr int ways = modes == 6 ? 3 : modes == 3 ? 2 : 1;  // the modes without a turn
  constexpr double kLine = 1e-12;  // what lies on a line does not turn about it, nor what lies in a point
  Square M = Square::Zero();
  Vector Mp = Vector::Zero();
  double size2 = 0;  // m2, of the body or its holds: what turns by 1/s moves as what moves by 1/s times its root
  M.template topLeftCorner<ways, ways>().diagonal().setConstant(mass);
  if constexpr (modes == 1) {
    Mp[0] = momentum[1];
  } else if constexpr (modes == 3) {
    const double J = square[0] + square[1];
    if (mass > 0) size2 = J / mass;
    Mp << momentum[0], momentum[1], L[2];
    M(2, 2) = J;
  } else {
    Mat3 J;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      J(i, i) = square.head<3>().sum() - square[i];
      J(i, j) = J(j, i) = from_c[j] * first[i] - masses.mixed[i];
    }
    if (mass > 0) size2 = J.trace() / (2 * mass);
    Mp << vec3(momentum), L;
    M.template bottomRightCorner<3, 3>() = J;
  }
  for (const Hold& h : holds) size2 = std::max(size2, (h.x - c).squaredNorm());
  for (int i = ways; i < modes; ++i) M(i, i) += kLine * mass * size2;
  BodyMotion motion;
  motion.own.c = motion.told.c = c;
  if (holds.empty()) {
    motion.own = rigid(c, mass > 0 ? solved(M, Mp) : Vector(Vector::Zero()));
    return motion;
  }
  Square G = Square::Zero();
  Vector g = Vector::Zero();
  double told2 = 0, beside2 = 0;
  const Vector of_masses = mass > 0 ? solved(M, Mp) : Vector(Vector::Zero());
  for (const Hold& h : holds) {
    const Node r = h.x - c;
    double b[modes];
    repeat<modes>([&](auto k) { b[k] = along_mode(kMode<modes>[k], r, h.along); });
    repeat<modes>([&](auto k) {
      repeat<modes>([&](auto l) { G(int{l}, int{k}) += b[l] * b[k]; });
      g[int{k}] += h.speed * b[k];
    });
    double beside = h.speed;
    repeat<modes>([&](auto k) { beside -= b[k] * of_masses[int{k}]; });
    told2 += h.speed * h.speed;
    beside2 += beside * beside;
  }
  if (mass > 0) motion.own = rigid(c, solved(Square(M + kHold * mass * G), Mp));
  if (told2 == 0) return motion;

  // Least squares with kRest as many holds more that keep it at rest, A = G + kRest n, again for what is left of g: after k rounds p is G^-1 g but for
  // E^k of it, E = 1 - A^-1 G, and k doubles in each turn of the loop.
  Square A = G;
  for (int i = 0; i < modes; ++i) A(i, i) += kRest * points * (i < ways ? 1 : size2);
  Eigen::Matrix<double, modes, modes + 1> g_and_G;
  g_and_G << g, G;
  g_and_G = solved(A, g_and_G);
  Vector p = g_and_G.col(0);
  Square E = Square::Identity() - g_and_G.template rightCols<modes>();
  for (int k = 1; k < kRounds; k *= 2) {
    p += E * p;
    E = Square(E * E);
  }
  motion.told = rigid(c, p);
  double left = 0;  // of the squares
  for (const Hold& h : holds) {
    const Node r = h.x - c;
    double missed = h.speed;
    repeat<modes>([&](auto k) { missed -= along_mode(kMode<modes>[k], r, h.along) * p[int{k}]; });
    left += missed * missed;
  }
  motion.agreed = std::max(1 - left / (kDisagreed * beside2 + kRounding * told2), 0.0);
  return motion;
}

template BodyMotion MovingBody::of<1>(const MassSums&, const std::vector<Hold>&, double);
template BodyMotion MovingBody::of<3>(const MassSums&, const std::vector<Hold>&, double);
template BodyMotion MovingBody::of<6>(const MassSums&, const std::vector<Hold>&, double);

}  // namespace forming_sim
