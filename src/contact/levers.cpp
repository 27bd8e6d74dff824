#include "forming_sim/contact/levers.h"

#include <Eigen/Eigenvalues>

namespace forming_sim {

Vec3 closed_part(const Workspace& work, const ContactPair& pair, const Vec3& vector) {
  Mat3 W = Mat3::Zero();  // inverse mass of the pair, 1/kg
  double free = 0;        // were nothing held
  for (int k = 0; k < pair.nodes; ++k) {
    const double b2m = pair.weight[k] * pair.weight[k] * work.share[pair.node[k]].inverse_mass;
    const Mat3* projector = work.projector[pair.node[k]];
    W += b2m * (projector ? *projector : Mat3(Mat3::Identity()));
    free += b2m;
  }
  Eigen::SelfAdjointEigenSolver<Mat3> along;
  along.computeDirect(W);
  Vec3 closed = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (along.eigenvalues()[i] < kLever * kLever * free) closed += along.eigenvectors().col(i).dot(vector) * along.eigenvectors().col(i);
  return closed;
}

Node moving_part(const Workspace& work, const ContactPair& pair, const Node& impulse) { return impulse - node(closed_part(work, pair, vec3(impulse))); }

void straighten(const Workspace& work, ContactPair& pair) {
  constexpr double kNearly = 0.2;
  const Vec3 normal = vec3(pair.normal), closed = closed_part(work, pair, normal);
  if (closed.norm() < kNearly) pair.normal = node(Vec3((normal - closed).normalized()));
}

}  // namespace forming_sim
