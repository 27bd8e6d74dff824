// Pairs that are one contact act as one, and no others.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "forming_sim/contact/alike.h"
#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

/// Vertex 9 of a tool, at entry 2, over the edge 7 of a body from entry 0 to 1; the edges 3 and 5 of the tool end there.
struct Corner {
  Workspace work;
  LargeArray<ContactPair> pairs;
  std::vector<Rub> rubs;

  Corner() {
    work.vertex = {0, 1, 9, 10, 11};
    work.body_entries = 2;
    const Node up(0, 0, 1, 0);
    add({PairKey::make(PairKey::vertex_facet, 9, Closest::edge, 7), 1, 0, 1e-5, false, up}).link({2, 0, 1}, 1, -.4, -.6);
    add({PairKey::make(PairKey::edge_edge, 3, 0, 7), 1, 0, 1e-5, false, up}).link({2, 3, 0, 1}, 1, 0, -.4, -.6);
    add({PairKey::make(PairKey::edge_edge, 7, 0, 8), 0, 1, 1e-5, false, -up}).link({0, 1, 4, 2}, .401, .599, -.001, -.999);
  }
  ContactPair& add(const ContactPair& pair) {
    pairs.push_back(pair);
    ContactPair& added = pairs.back();
    added.layer = 1.1e-5;
    added.stiffness = 3;
    added.w = 2;
    added.impulse = 5;
    added.movers = pairs.size() < 3 ? (pairs.size() == 1 ? 0b110 : 0b1100) : 0b0011;
    added.rub = static_cast<int>(rubs.size());
    rubs.push_back({Node(pairs.size() == 3 ? -.1 : .1, 0, 0, 0), .2, 2});
    rubs.back().before = .5;
    rubs.back().beta = .25;
    return added;
  }
};

TEST(Alike, OneBearsWhatThreeDo) {
  Corner c;
  AlikePairs().join(c.work, c.pairs, c.rubs);
  EXPECT_EQ(c.pairs[0].stiffness, 9);
  EXPECT_EQ(c.pairs[0].impulse, 15);
  EXPECT_EQ(c.pairs[0].w, 2);
  EXPECT_NEAR(c.rubs[0].slip[0], .3, 1e-15);  // the last pair is seen from the other side
  EXPECT_EQ(c.rubs[0].before, 1.5);
  EXPECT_EQ(c.rubs[0].beta, .75);
  for (int k = 1; k < 3; ++k) {
    EXPECT_EQ(c.pairs[k].stiffness, 0);
    EXPECT_EQ(c.pairs[k].impulse, 0);
    EXPECT_EQ(c.pairs[k].w, 0);
    EXPECT_EQ(c.rubs[k].slip, Node(Node::Zero()));
    EXPECT_EQ(c.rubs[k].before, 0);
  }
}

// Where there is no pair of the vertex, the edges that end there are alike.
TEST(Alike, EdgesWithoutTheirVertex) {
  Corner c;
  c.pairs.erase(c.pairs.begin());
  AlikePairs().join(c.work, c.pairs, c.rubs);
  EXPECT_EQ(c.pairs[0].stiffness, 6);
  EXPECT_EQ(c.pairs[1].stiffness, 0);
}

TEST(Alike, WhatDiffersStays) {
  const std::vector<std::function<void(Corner&)>> differences = {
      [](Corner& c) { c.pairs[1].gap *= 1.02; },
      [](Corner& c) { c.pairs[1].layer *= 1.001; },
      [](Corner& c) { c.pairs[1].normal = Node(0, .02, .9998, 0).normalized(); },
      [](Corner& c) { c.pairs[1].weight[2] = -.45, c.pairs[1].weight[3] = -.55; },
      [](Corner& c) { c.pairs[1].weight[0] = .97, c.pairs[1].weight[1] = .03; },
      [](Corner& c) { c.pairs[1].rub = -1; },
      [](Corner& c) { c.pairs[1].w = 0; },
      [](Corner& c) { for (ContactPair& p : c.pairs) p.layer = 3e-5; },  // pressed hard: each holds its own
  };
  for (std::size_t k = 0; k < differences.size(); ++k) {
    Corner c;
    differences[k](c);
    AlikePairs().join(c.work, c.pairs, c.rubs);
    EXPECT_EQ(c.pairs[1].stiffness, 3) << k;
    EXPECT_EQ(c.pairs[1].impulse, 5) << k;
  }
}

// Many corners, each a group of its own, and the table is used again, larger and smaller.
TEST(Alike, EachOfManyCornersFindsItsOwn) {
  AlikePairs alike;
  for (const int corners : {1, 7, 400, 3, 1000}) {
    Workspace work;
    LargeArray<ContactPair> pairs;
    std::vector<Rub> rubs;
    const Node up(0, 0, 1, 0);
    work.body_entries = 0;
    for (int c = 0; c < corners; ++c)
      for (int n = 0; n < 5; ++n) work.vertex.push_back(5 * c + n);
    for (int c = 0; c < corners; ++c)
      for (const int tool_edge : {10000 + 2 * c, 10001 + 2 * c}) {  // two edges that end at a vertex, over the edge c of a body
        ContactPair pair{PairKey::make(PairKey::edge_edge, tool_edge, 0, c), 1, 0, 1e-5, false, up};
        pair.link({5 * c + 2, 5 * c + 3 + tool_edge % 2, 5 * c, 5 * c + 1}, 1, 0, -.4, -.6);
        pair.layer = 1.1e-5;
        pair.stiffness = 3;
        pair.w = 2;
        pair.movers = 0b1100;
        pair.rub = -1;
        pairs.push_back(pair);
      }
    std::sort(pairs.begin(), pairs.end(), [](const ContactPair& a, const ContactPair& b) { return a.key < b.key; });
    alike.join(work, pairs, rubs);
    int bearing = 0, none = 0;
    for (const ContactPair& pair : pairs) {
      bearing += pair.stiffness == 6;
      none += pair.stiffness == 0 && pair.w == 0;
    }
    EXPECT_EQ(bearing, corners);
    EXPECT_EQ(none, corners);
  }
}

}  // namespace
}  // namespace forming_sim
