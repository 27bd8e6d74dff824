// Closest points against sampling, the continuous check against dense sampling,
// the list against all pairs.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "contact/point_bodies.h"
#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/closest_pack.h"
#include "forming_sim/contact/constants.h"
#include "forming_sim/contact/continuous.h"
#include "forming_sim/contact/crossing.h"
#include "forming_sim/contact/narrow.h"

using namespace forming_sim;
using contact_test::World;

namespace {

std::mt19937 engine(7);
Node random_node(int dimension, double size = 1) {
  std::uniform_real_distribution<double> u(-size, size);
  const double a = u(engine), b = u(engine), c = u(engine);
  return Node(a, b, dimension == 3 ? c : 0, 0);
}

}  // namespace

TEST(ContactGrid, NearestAgainstAllBoxes) {
  for (const double part : {2.0, .4}) {  // a region of all boxes, and one that some boxes reach beyond, or are outside of
    Box region = Box::of(Node(-part, -part, -part, 0), Node(part, part, part, 0));
    std::vector<Box> boxes;
    std::vector<Node> centres;
    for (int b = 0; b < 400; ++b) {
      const Node at = random_node(3), half = .05 * random_node(3).cwiseAbs();
      boxes.push_back(Box::of(Node(at - half), Node(at + half)));
      centres.push_back(at);
    }
    const Grid grid(boxes, region, .1);
    long asked = 0;
    for (int i = 0; i < 500; ++i) {
      const Node p = random_node(3, 1.3);
      const double bound = i % 3 ? 3 : .2;
      double expected = bound;
      for (std::size_t b = 0; b < boxes.size(); ++b)
        if (boxes[b].overlaps(region)) expected = std::min(expected, (centres[b] - p).norm());
      EXPECT_EQ(grid.nearest(p, bound, [&](int b) { return ++asked, (centres[b] - p).norm(); }), expected);
    }
    EXPECT_LT(asked, 500 * 400 / 4);
  }
}

TEST(ContactClosest, TriangleAgainstSampling) {
  for (int i = 0; i < 300; ++i) {
    Node p = random_node(3), c[3] = {random_node(3), random_node(3), random_node(3)};
    if (i % 5 == 0) c[2] = c[0] + (i % 10 ? .3 : 1.4) * (c[1] - c[0]);  // no area
    const Closest q = closest_on_triangle(p, c[0], c[1], c[2]);
    Node at = Node::Zero();
    for (int k = 0; k < 3; ++k) at += q.weight[k] * c[k];
    EXPECT_NEAR((p - at).norm(), std::sqrt(q.squared), 1e-12);
    EXPECT_NEAR(q.weight[0] + q.weight[1] + q.weight[2], 1, 1e-14);
    double best = 1e9;
    const int n = 150;
    for (int a = 0; a <= n; ++a)
      for (int b = 0; a + b <= n; ++b) best = std::min(best, (p - c[0] - (a * (c[1] - c[0]) + b * (c[2] - c[0])) / n).norm());
    EXPECT_LE(std::sqrt(q.squared), best + 1e-12);
    EXPECT_GT(std::sqrt(q.squared), best - 2e-2);
  }
}

TEST(ContactClosest, EdgesAgainstSampling) {
  for (int i = 0; i < 300; ++i) {
    Node a = random_node(3), b = random_node(3), c = random_node(3), d = random_node(3);
    if (i % 5 == 0) d = c + (b - a) * .7;          // parallel
    if (i % 7 == 0) b = a;                         // a point
    const ClosestEdges q = closest_on_edges(a, b, c, d);
    EXPECT_NEAR((a + q.s * (b - a) - c - q.t * (d - c)).norm(), std::sqrt(q.squared), 1e-12);
    double best = 1e9;
    for (int s = 0; s <= 150; ++s)
      for (int t = 0; t <= 150; ++t) best = std::min(best, (a + s / 150. * (b - a) - c - t / 150. * (d - c)).norm());
    EXPECT_LE(std::sqrt(q.squared), best + 1e-12);
    EXPECT_GT(std::sqrt(q.squared), best - 2e-2);
  }
}

namespace {

const std::vector<Isa>& vector_widths() {
  static const std::vector<Isa> all = [] {
    std::vector<Isa> runs{Isa::sse2};
    for (Isa isa : {Isa::avx2, Isa::avx512})
      if (isa <= choose_isa()) runs.push_back(isa);
    return runs;
  }();
  return all;
}

/// Nodes of bodies, some of them held or without mass, and of tools.
std::vector<Share> random_shares(long count) {
  std::vector<Share> shares;
  for (long i = 0; i < count; ++i) {
    const Node r = random_node(3);
    shares.push_back(r[0] > .4 ? Share() : Share{r[0] < -.8 ? 0 : 1.5 + r[1], 1.5 + r[2], 1, r[1] > 0 ? 1. : 0.});
  }
  return shares;
}
void expect_shares(const std::vector<Share>& shares, const Link& link, const SharesPack& found, int lane) {
  Workspace work;
  work.share = shares;
  const PairShares<double> sum = PairConstants{Features(), work, 1, 1}.shares_of(link);
  EXPECT_NEAR(found.w[lane], sum.w, 1e-10 * (1 + sum.w));
  EXPECT_NEAR(found.area[lane], sum.mean_area(), 1e-13);
  EXPECT_EQ(found.movers[lane], sum.movers);
  EXPECT_EQ(found.held[lane], sum.held);
}

/// Does the direction lie outside the slab of the facet that has the edge ab and the corner c, by its slope across the edge?
double slope_into_slab(const Node& a, const Node& b, const Node& c, const Node& away) {
  const Node along = (b - a).normalized(), r = c - a, inward = r - r.dot(along) * along;
  return away.normalized().dot(inward.normalized());
}

/// A point and a facet at random in every lane, with nodes of their own: the point first.
struct Candidates {
  explicit Candidates(int dimension) {
    const int nodes = dimension + 1;
    for (int l = 0; l < kLanes; ++l) {
      for (int k = 0; k < nodes; ++k) x.push_back(random_node(dimension));
      pack.point[l] = nodes * l;
      for (int k = 0; k < dimension; ++k) corner[l][k] = nodes * l + 1 + k;
      pack.corner[l] = corner[l];
    }
  }
  Candidates(const Candidates&) = delete;
  NodeField x;
  FacePack pack;
  int corner[kLanes][3] = {};
};

}  // namespace

TEST(ContactClosest, FacesInLanesAreThoseOneByOne) {
  for (const Isa isa : vector_widths()) {
    long inside = 0;
    for (int turn = 0; turn < 300; ++turn) {
      Candidates candidates(3);
      NodeField& x = candidates.x;
      FacePack& pack = candidates.pack;
      for (int l = 0; l < kLanes; ++l) {
        if (l == 5) x[4 * l] = .5 * (x[4 * l + 1] + x[4 * l + 2]) + Node((x[4 * l + 2] - x[4 * l + 1]).cross3(x[4 * l + 3] - x[4 * l + 1]));  // over an edge
        if (l == 6) x[4 * l + 3] = 2 * x[4 * l + 2] - x[4 * l + 1];                                                                          // no area
      }
      const std::vector<Share> shares = random_shares(static_cast<long>(x.size()));
      closest_kernels_of(isa).faces(x.front().data(), &shares.front().inverse_mass, &pack, 1);
      for (int l = 0; l < kLanes; ++l) {
        const Closest c = closest_on_triangle(x[4 * l], x[4 * l + 1], x[4 * l + 2], x[4 * l + 3]);
        ASSERT_EQ(pack.inside[l] == 1, c.feature == Closest::face) << "lane " << l << " of turn " << turn;
        const Node apart(pack.apart[0][l], pack.apart[1][l], pack.apart[2][l], 0);
        Closest found;
        if (pack.inside[l] == 1) lie_in_face(pack.beta[l], pack.gamma[l], apart, found);
        else lie_on_border(static_cast<int>(pack.side[l]), pack.s[l], apart, found);
        EXPECT_NEAR(pack.squared[l], c.squared, 1e-12);
        EXPECT_NEAR(found.squared, c.squared, 1e-12);
        if (l == 6) continue;  // sides lie on one another: either is right
        EXPECT_EQ(found.feature, c.feature);
        EXPECT_EQ(found.which, c.which);
        for (int k = 0; k < 3; ++k) {
          EXPECT_NEAR(found.weight[k], c.weight[k], 1e-12);
          EXPECT_NEAR(found.apart[k], c.apart[k], 1e-12);
        }
        if (pack.inside[l] == 0) continue;
        ++inside;
        Link link;
        link.link({4 * l, 4 * l + 1, 4 * l + 2, 4 * l + 3}, 1, -found.weight[0], -found.weight[1], -found.weight[2]);
        expect_shares(shares, link, pack.shares, l);
      }
    }
    EXPECT_GT(inside, 200);
  }
}

TEST(ContactClosest, SegmentsInLanesAreThoseOneByOne) {
  for (const Isa isa : vector_widths()) {
    long inside = 0;
    for (int turn = 0; turn < 300; ++turn) {
      Candidates candidates(2);
      NodeField& x = candidates.x;
      FacePack& pack = candidates.pack;
      for (int l = 0; l < kLanes; ++l) {
        if (l == 5) x[3 * l] = x[3 * l + 2] + Node(x[3 * l + 1][1] - x[3 * l + 2][1], x[3 * l + 2][0] - x[3 * l + 1][0], 0, 0);  // over an end
        if (l == 6) x[3 * l + 2] = x[3 * l + 1];                                                                                 // no length
      }
      const std::vector<Share> shares = random_shares(static_cast<long>(x.size()));
      closest_kernels_of(isa).segments(x.front().data(), &shares.front().inverse_mass, &pack, 1);
      for (int l = 0; l < kLanes; ++l) {
        const Closest c = closest_on_segment_facet(x[3 * l], x[3 * l + 1], x[3 * l + 2]);
        ASSERT_EQ(pack.inside[l] == 1, c.feature == Closest::face) << "lane " << l << " of turn " << turn;
        Closest found;
        lie_on_segment(pack.beta[l], Node(pack.apart[0][l], pack.apart[1][l], pack.apart[2][l], 0), found);
        EXPECT_NEAR(pack.squared[l], c.squared, 1e-12);
        EXPECT_NEAR(found.squared, c.squared, 1e-12);
        EXPECT_EQ(found.feature, c.feature);
        EXPECT_EQ(found.which, c.which);
        for (int k = 0; k < 2; ++k) EXPECT_NEAR(found.weight[k], c.weight[k], 1e-12);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(found.apart[k], c.apart[k], 1e-12);
        if (pack.inside[l] == 0) continue;
        ++inside;
        Link link;
        link.link({3 * l, 3 * l + 1, 3 * l + 2}, 1, -found.weight[0], -found.weight[1]);
        expect_shares(shares, link, pack.shares, l);
      }
    }
    EXPECT_GT(inside, 200);
  }
}

TEST(ContactClosest, EdgesInLanesAreThoseOneByOne) {
  const double wedge = 1e-3;
  for (const Isa isa : vector_widths()) {
    long crossing = 0, outside = 0, not_outside = 0;
    for (int turn = 0; turn < 600; ++turn) {
      NodeField x;
      EdgePack pack;
      int node[kLanes][8];
      for (int l = 0; l < kLanes; ++l) {
        for (int k = 0; k < 8; ++k) x.push_back(random_node(3));
        for (int k = 0; k < 4; ++k) {
          node[l][k] = 8 * l + k;
          node[l][4 + k] = l % 2 && k % 2 ? 8 * l + k / 2 * 2 : 8 * l + 4 + k;  // some edges have one facet
        }
        pack.node[l] = node[l];
        if (l == 6) x[8 * l + 3] = x[8 * l + 2] + 3 * (x[8 * l + 1] - x[8 * l]);  // parallel
        if (l == 7) x[8 * l + 1] = x[8 * l];                                      // a point
      }
      const std::vector<Share> shares = random_shares(static_cast<long>(x.size()));
      closest_kernels_of(isa).edges(x.front().data(), &shares.front().inverse_mass, wedge, &pack, 1);
      for (int l = 0; l < kLanes; ++l) {
        const Node *a = &x[8 * l], *b = a + 2;
        const ClosestEdges c = closest_on_edges(a[0], a[1], b[0], b[1]);
        ASSERT_EQ(pack.inside[l] == 1, c.crossing) << "lane " << l << " of turn " << turn;
        EXPECT_NEAR(pack.distance[l], std::sqrt(c.squared), 1e-10);
        if (!c.crossing) continue;
        ++crossing;
        Link link;
        link.link({node[l][0], node[l][1], node[l][2], node[l][3]}, 1 - pack.s[l], pack.s[l], pack.t[l] - 1, -pack.t[l]);
        expect_shares(shares, link, pack.shares, l);
        EXPECT_NEAR(pack.s[l], c.s, 1e-10);
        EXPECT_NEAR(pack.t[l], c.t, 1e-10);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(pack.distance[l] * pack.normal[k][l], c.apart[k], 1e-10);
        bool out = true;
        for (int k = 0; k < 4; ++k) {
          const Node* edge = k < 2 ? a : b;
          if (node[l][4 + k] != node[l][k / 2 * 2]) out = out && !(slope_into_slab(edge[0], edge[1], x[node[l][4 + k]], k < 2 ? Node(-c.apart) : c.apart) > wedge);
        }
        EXPECT_EQ(pack.outside[l] == 1, out) << "lane " << l << " of turn " << turn;
        (out ? outside : not_outside)++;
      }
    }
    EXPECT_GT(crossing, 200);
    EXPECT_GT(outside, 20);
    EXPECT_GT(not_outside, 100);
  }
}

// "No touch" must be certain; and it must not cry wolf where the features stay well apart.
TEST(ContactContinuous, AgreesWithDenseSampling) {
  int touches = 0, free = 0;
  for (int i = 0; i < 6000; ++i) {
    const int kind = i % 3;  // 2D point-segment, 3D point-triangle, edge-edge
    const int dimension = kind == 0 ? 2 : 3, count = kind == 0 ? 3 : 4;
    Node x[4], d[4];
    for (int k = 0; k < count; ++k) {
      x[k] = random_node(dimension);
      d[k] = random_node(dimension, 1.5);
    }
    const auto distance = [&](double t) {
      Node y[4];
      for (int k = 0; k < count; ++k) y[k] = x[k] + t * d[k];
      return std::sqrt(kind == 0 ? closest_on_segment_facet(y[0], y[1], y[2]).squared
                       : kind == 1 ? closest_on_triangle(y[0], y[1], y[2], y[3]).squared
                                   : closest_on_edges(y[0], y[1], y[2], y[3]).squared);
    };
    const int samples = 4000;
    double least = 1e9, speed = 0;
    for (int s = 0; s <= samples; ++s) least = std::min(least, distance(s / double(samples)));
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b) speed = std::max(speed, (d[a] - d[b]).norm());
    const double limit = 1e-4;
    const bool meets = kind == 2 ? edges_meet(x, d, limit) : point_meets_facet(count - 1, x, d, limit);
    if (least < limit) {
      EXPECT_TRUE(meets) << i;
    }
    if (least > 2 * limit + speed / samples) {
      EXPECT_FALSE(meets) << i << " least " << least;
      ++free;
    }
    touches += meets;
  }
  EXPECT_GT(touches, 200);
  EXPECT_GT(free, 1000);
}

TEST(ContactContinuous, SlidingPastAtASmallGapIsNoTouch) {
  const Node x[4] = {Node(-.9, 0, 1e-7, 0), Node(-1, -1, 0, 0), Node(1, -1, 0, 0), Node(0, 1, 0, 0)};
  const Node d[4] = {Node(1.5, 0, 0, 0), Node::Zero(), Node::Zero(), Node::Zero()};
  EXPECT_FALSE(point_meets_facet(3, x, d, 1e-10));
}

// Long edges that are nearly parallel and already close: the direction between
// them is known from their cross product only.
TEST(ContactContinuous, NearlyParallelEdgesThatCross) {
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double angle = std::pow(10, -3.5 * std::abs(u(engine))), gap = std::pow(10, -3 - 4 * std::abs(u(engine)));
    const Node x[4] = {Node(-1, -angle, gap, 0), Node(1, angle, gap, 0), Node(-2, 0, 0, 0), Node(2, 0, 0, 0)};
    const double turn = 5 * gap * u(engine);
    const Node d[4] = {Node(0, 0, -2 * gap + turn, 0), Node(0, 0, -2 * gap - turn, 0), Node::Zero(), Node::Zero()};
    EXPECT_TRUE(edges_meet(x, d, 1e-3 * gap)) << i;  // in the middle the way is -2 gap
    const Node half[4] = {Node(.1, 0, -.9 * gap, 0), Node(.1, 0, -.9 * gap, 0), Node::Zero(), Node::Zero()};
    EXPECT_FALSE(edges_meet(x, half, 1e-3 * gap)) << i;
  }
}

// Features that turn about the point where they nearly touch: their ends move a million gaps, the point does not.
TEST(ContactContinuous, TurningAboutASmallGapIsNoTouch) {
  for (double gap : {1e-6, 1e-9, 1e-12}) {
    const Node edges[4] = {Node(-1, 0, gap, 0), Node(1, 0, gap, 0), Node(0, -1, 0, 0), Node(0, 1, 0, 0)};
    const Node turn[4] = {Node(0, 0, 1e-2, 0), Node(0, 0, -1e-2, 0), Node(0, 0, -2e-2, 0), Node(0, 0, 2e-2, 0)};
    EXPECT_FALSE(edges_meet(edges, turn, 1e-3 * gap)) << gap;
    // The same, and two gaps closer: they touch.
    Node closer[4];
    for (int k = 0; k < 4; ++k) closer[k] = turn[k] - (k < 2 ? Node(0, 0, 2 * gap, 0) : Node(Node::Zero()));
    EXPECT_TRUE(edges_meet(edges, closer, 1e-3 * gap)) << gap;

    const Node flat[3] = {Node(0, gap, 0, 0), Node(-1, 0, 0, 0), Node(1, 0, 0, 0)};
    const Node rock[3] = {Node::Zero(), Node(0, 1e-2, 0, 0), Node(0, -1e-2, 0, 0)};
    EXPECT_FALSE(point_meets_facet(2, flat, rock, 1e-3 * gap)) << gap;
    const Node fall[3] = {Node(0, -2 * gap, 0, 0), rock[1], rock[2]};
    EXPECT_TRUE(point_meets_facet(2, flat, fall, 1e-3 * gap)) << gap;
  }
}

// Features a millionth apart whose nodes move by up to a million gaps: a pass is always seen, and hardly anything else is.
TEST(ContactContinuous, SmallGapsAgainstSampling) {
  std::uniform_real_distribution<double> u(-1, 1);
  int passes = 0, free = 0, cried = 0;
  for (int i = 0; i < 6000; ++i) {
    const int kind = i % 3;  // 2D point-segment, 3D point-triangle, edge-edge
    const int count = kind == 0 ? 3 : 4, across = kind == 0 ? 1 : 2;
    const double gap = 1e-6, way = gap * std::pow(10, 3 + 3 * u(engine));
    Node x[4] = {Node(-1, .3 * u(engine), 0, 0), Node(1, .3 * u(engine), 0, 0), Node(.3 * u(engine), -1, 0, 0), Node(.3 * u(engine), 1, 0, 0)};
    if (kind == 0) {
      x[0] = Node(.5 * u(engine), 0, 0, 0);
      x[1] = Node(-1, 0, 0, 0);
      x[2] = Node(1, 0, 0, 0);
    }
    if (kind == 1) x[0] = Node(.1 * u(engine), .1 * u(engine), 0, 0), x[1] = Node(-1, -1, 0, 0), x[2] = Node(1, -1, 0, 0), x[3] = Node(0, 1, 0, 0);
    for (int k = 0; k < (kind == 2 ? 2 : 1); ++k) x[k][across] += gap;
    Node d[4];
    for (int k = 0; k < count; ++k) {
      d[k] = .01 * way * random_node(kind == 0 ? 2 : 3);
      d[k][across] = way * u(engine);
    }
    // The height of the first feature over the second, at the point where they are closest, by sampling.
    const auto height = [&](double t) {
      Node y[4];
      for (int k = 0; k < count; ++k) y[k] = x[k] + t * d[k];
      if (kind == 0) return ((y[2][0] - y[1][0]) * (y[0][1] - y[1][1]) - (y[2][1] - y[1][1]) * (y[0][0] - y[1][0])) / 2;
      const Node n = kind == 1 ? cross3(y[2] - y[1], y[3] - y[1]) : cross3(y[1] - y[0], y[3] - y[2]);
      return dot3(n, kind == 1 ? Node(y[0] - y[1]) : Node(y[0] - y[2])) / n.norm();
    };
    double least = 1;
    for (int s = 0; s <= 2000; ++s) least = std::min(least, height(s / 2000.));
    const bool meets = kind == 2 ? edges_meet(x, d, 1e-3 * gap) : point_meets_facet(count - 1, x, d, 1e-3 * gap);
    if (least < 0) {
      EXPECT_TRUE(meets) << i;
      ++passes;
    } else if (least > .01 * gap) {
      ++free;
      cried += meets;
    }
  }
  EXPECT_GT(passes, 1000);
  EXPECT_GT(free, 1000);
  EXPECT_LT(cried, free / 100) << "of " << free;
}

// Neighbours in one plane that rounding has moved a little out of it have not passed through each other.
TEST(ContactCrossing, FeaturesInOnePlaneDoNotPierce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-2e-16, 2e-16);
  const Node p(-.208, 1, .8, 0), q(-.39, 1, .6, 0), a(-.208, 1, 1, 0), b(-.39, 1, .8, 0), c(-.39, 1, 1, 0);
  const Node over(-.208, 1, .95, 0), beyond(-.5, 1, .9, 0);  // a segment in the same plane that runs across the facet
  for (int i = 0; i < 20000; ++i) {
    Node at[5] = {p, q, a, b, c}, across[2] = {over, beyond};
    for (Node& n : at) n[1] += noise(random);
    for (Node& n : across) n[1] += noise(random);
    ASSERT_FALSE(pierces(at[0], at[1], at[2], at[3], at[4], true)) << i;
    ASSERT_FALSE(pierces(across[0], across[1], at[2], at[3], at[4], true)) << i;
    ASSERT_FALSE(segments_cross(Node(0, at[0][1], 0, 0), Node(.3, at[1][1], 0, 0), Node(.4, at[2][1], 0, 0), Node(.7, at[3][1], 0, 0), true)) << i;
  }
  // A billionth of their size is more than rounding.
  const Node up(0, 1e-9, 0, 0), centre = (a + b + c) / 3;
  EXPECT_TRUE(pierces(centre + up, centre - up, a, b, c, false));
}

// Two blocks that have met: an edge that stands 3e-8 off one that runs along it to 5e-8, and goes through the plane of that one's
// side face. The volume that the two edges span is a hundredth of the rounding of a product of their coordinates.
TEST(ContactCrossing, EdgesSideBySideDoNotPierceTheFacesBehind) {
  const Node p(-1.9177918551014278e-06, .33333333333082826, -2.7700304083259816e-11, 0), q(-1.7991047040509931e-06, .50000000000001954, -3.2161357386641134e-11, 0);
  const Node a(-.1999909478690636, .3999999999992212, -1.2048563982717011e-11, 0), b(-1.9033706914785115e-06, .39999999999868252, -3.0885936566731568e-11, 0),
      c(-1.7519346683897214e-06, .60000000000089093, -2.6802785489306593e-11, 0);
  EXPECT_FALSE(pierces(p, q, a, b, c, true));
  const Node into(-1e-6, 0, 0, 0);
  EXPECT_TRUE(pierces(p + into, q + into, a, b, c, true));
}

// Every vertex-facet and edge-edge pair within the radius is listed, no other.
TEST(ContactSearch, ListAgainstAllPairs) {
  for (int dimension : {2, 3}) {
    World world;
    world.dimension = dimension;
    if (dimension == 2) {
      world.add_strip(Vec3(-1, .05, 0), 23, 2, .1, .1, 1, 0, .02);
      std::vector<Vec3> line;
      for (int i = 0; i <= 40; ++i) line.emplace_back(-2 + .1 * i, .08 * std::sin(3.0 * i), 0);
      world.add_tool("die", contact_test::polyline(line), 0, [](double) { return Vec3(0, -.3, 0); });
    } else {
      world.add_box(Vec3(-.4, -.35, .1), 7, 6, 2, .1, 1, 0);
      world.add_tool("die", contact_test::sheet(9, 1.1, [](double a, double b) { return .05 * std::sin(5 * a) * std::cos(4 * b); }), 0,
                     [](double) { return Vec3(.013, .017, 0); });
    }
    const Features f = build_features(world.setup(), world.x);
    // The tool turned and moved: the search goes into its frame.
    std::vector<ToolMotion> motion(1);
    motion[0].position0 = world.path[0](0);
    motion[0].rotation0 = Eigen::AngleAxisd(dimension == 2 ? .1 : .3, dimension == 2 ? Vec3(0, 0, 1) : Vec3(.2, .3, 1).normalized()).toRotationMatrix();
    NodeField place;
    for (const Node& p : f.place) place.push_back(node(pose0(motion[0], vec3(p))));
    for (double radius : {.02, .1, .4}) {
      Workspace work;
      const NearList list = build_list(f, world.x, {ToolIndex(f, f.place, {true}), motion, {true}, {false}, {PlanePose()}}, {}, radius, work);
      std::set<std::pair<int, int>> listed, expected, edges_listed, edges_expected;
      for (const auto& g : list.groups)
        for (int i = g.first; i < g.last; ++i) EXPECT_TRUE(listed.insert({g.vertex, list.facets[i].facet}).second);
      for (const auto& e : list.edges) EXPECT_TRUE(edges_listed.insert({e.first, e.second}).second);
      const auto at = [&](int v) -> const Node& { return v < f.body_nodes ? world.x[v] : place[v - f.body_nodes]; };
      for (int side = 0; side < 2; ++side)
        for (int v : f.surfaces[side].vertices)
          for (int i = f.surfaces[1 - side].first_facet; i < f.surfaces[1 - side].last_facet; ++i) {
            const auto& c = f.facets[i];
            const double d2 = dimension == 2 ? closest_on_segment_facet(at(v), at(c[0]), at(c[1])).squared : closest_on_triangle(at(v), at(c[0]), at(c[1]), at(c[2])).squared;
            if (d2 <= radius * radius) expected.insert({v, i});
          }
      for (int a = f.surfaces[0].first_edge; a < f.surfaces[0].last_edge; ++a)
        for (int b = f.surfaces[1].first_edge; b < f.surfaces[1].last_edge; ++b) {
          const auto &p = f.edges[a].node, &q = f.edges[b].node;
          if (closest_on_edges(at(p[0]), at(p[1]), at(q[0]), at(q[1])).squared <= radius * radius) edges_expected.insert({a, b});
        }
      EXPECT_EQ(listed, expected) << dimension << "D radius " << radius;
      EXPECT_EQ(edges_listed, edges_expected);
      if (radius == .4) {
        EXPECT_GT(expected.size(), 50u);
      }
    }
  }
}

TEST(ContactCrossing, FindsWhatPiercesAndWhatIsInside) {
  World world;
  world.dimension = 3;
  world.add_box(Vec3(-.5, -.5, .1), 5, 5, 2, .2, 1, 0);
  world.add_tool("die", contact_test::sheet(1, 2, [](double, double) { return 0.; }), 0, [](double t) { return Vec3(.013, 0, t); });
  Contact contact = world.make();
  EXPECT_EQ(contact.count_crossings(world.x, world.motion(0, 0)), 0);
  // The plane cuts the sides between two layers of nodes: 20 vertical edges, 20 diagonals; its own diagonal pierces two sides.
  EXPECT_EQ(contact.count_crossings(world.x, world.motion(.2, .2)), 42);
}
