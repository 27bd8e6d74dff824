// What thickness a pair's layer has when the pair is born, and from which pair it takes it over.
#include <gtest/gtest.h>

#include "contact/give_layers.h"
#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/layers.h"
#include "forming_sim/contact/law.h"

using namespace forming_sim;
using contact_test::give_layers;

namespace {

constexpr double h0 = 1e-3;

ContactPair pair_of(const PairKey& key, int own, int surface, double gap) {
  ContactPair pair;
  pair.key = key;
  pair.own = own;
  pair.surface = surface;
  pair.gap = gap;
  pair.nodes = 1;
  pair.node[0] = 0;
  pair.weight[0] = 1;
  return pair;
}
Workspace at_rest() {
  Workspace work;
  work.v = {Node::Zero()};
  return work;
}
PairKey on_facet(int vertex, int facet) { return PairKey::make(PairKey::vertex_facet, vertex, Closest::face, facet); }
PairKey on_vertex(int vertex, int other) { return PairKey::make(PairKey::vertex_vertex, std::min(vertex, other), 0, std::max(vertex, other)); }
PairKey on_edge(int edge, int other) { return PairKey::make(PairKey::edge_edge, edge, 0, other); }

/// The layers that `pairs` get after a step that ended with `before`, in the order of their keys.
std::vector<double> layers(LargeArray<PairRecord> before, LargeArray<ContactPair> pairs) {
  std::sort(before.begin(), before.end(), [](const PairRecord& a, const PairRecord& b) { return a.key < b.key; });
  std::sort(pairs.begin(), pairs.end(), [](const ContactPair& a, const ContactPair& b) { return a.key < b.key; });
  std::vector<Rub> rubs;
  const Workspace work = at_rest();
  give_layers(Layers({before, {}}, {}, work, 1e-6, 1e-6, h0, h0), pairs, rubs);
  std::vector<double> found;
  for (const ContactPair& pair : pairs) found.push_back(pair.layer);
  return found;
}

}  // namespace

TEST(ContactLayers, BornOutsideWholeBornInsideWithoutForce) {
  const std::vector<double> found = layers({}, {pair_of(on_facet(1, 0), 0, 1, 2 * h0), pair_of(on_facet(2, 0), 0, 1, .3 * h0)});
  EXPECT_EQ(found[0], h0);
  EXPECT_EQ(found[1], .3 * h0);
}

// Vertex 7 of surface 0 rounds vertex 3 of surface 1 from facet 20 to facet 21, and back: whichever of the two numbers
// names the pair of vertices, and whichever of the two surfaces the facet is of, the layer goes over.
TEST(ContactLayers, GoesOverAroundAVertex) {
  for (const auto& [vertex, corner] : {std::pair{7, 3}, std::pair{3, 7}}) {
    const int own = vertex < corner ? 0 : 1;  // the surface of the first feature of the pair of vertices
    const PairRecord facet{on_facet(vertex, 20), 0, 1, h0, .8 * h0}, round{on_vertex(vertex, corner), own, 1 - own, h0, .8 * h0};
    EXPECT_EQ(layers({facet}, {pair_of(on_vertex(vertex, corner), own, 1 - own, .8 * h0)})[0], h0) << vertex;
    EXPECT_EQ(layers({round}, {pair_of(on_facet(vertex, 21), 0, 1, .8 * h0)})[0], h0) << vertex;
    // A facet of another surface has nothing to do with it.
    EXPECT_EQ(layers({round}, {pair_of(on_facet(vertex, 21), 0, 2, .8 * h0)})[0], .8 * h0) << vertex;
  }
}

// Either of two edges may be the one that goes on.
TEST(ContactLayers, GoesOverFromEdgeToEdge) {
  const PairRecord before{on_edge(4, 40), 0, 1, h0, .9 * h0};
  EXPECT_EQ(layers({before}, {pair_of(on_edge(4, 41), 0, 1, .9 * h0)})[0], h0);
  EXPECT_EQ(layers({before}, {pair_of(on_edge(5, 40), 0, 1, .9 * h0)})[0], h0);
  EXPECT_EQ(layers({before}, {pair_of(on_edge(5, 41), 0, 1, .9 * h0)})[0], .9 * h0);
}

// A pair that lives keeps its layer; one that is gone gives it once: the potential does not rise.
TEST(ContactLayers, IsGivenOnceAndNoPotentialWithIt) {
  const PairRecord before{on_facet(7, 20), 0, 1, h0, .5 * h0};
  EXPECT_EQ(layers({before}, {pair_of(on_facet(7, 20), 0, 1, .5 * h0), pair_of(on_facet(7, 21), 0, 1, .6 * h0)})[1], .6 * h0);
  const std::vector<double> two = layers({before}, {pair_of(on_facet(7, 21), 0, 1, .4 * h0), pair_of(on_facet(7, 22), 0, 1, .6 * h0)});
  EXPECT_NEAR(two[0], .8 * h0, 1e-12 * h0);  // as deep in its layer as the one before
  EXPECT_EQ(two[1], .6 * h0);
  EXPECT_LE(mild_potential(.4 * h0, two[0], 1) + mild_potential(.6 * h0, two[1], 1), mild_potential(.5 * h0, h0, 1) * (1 + 1e-12));
}

// Pressed in a layer that was raised and is gone: the pair is new, and the sweeps start from its force.
TEST(ContactLayers, AForceOutlivesItsRaisedLayer) {
  const double force = 3, dt = 1e-6;
  PairRecords before;
  before.pairs = {{on_facet(7, 20), 0, 1, .3 * h0, 1.2 * h0, force}};
  LargeArray<ContactPair> pairs{pair_of(on_facet(7, 20), 0, 1, .9 * h0)};
  pairs[0].w = 1;
  std::vector<Rub> rubs;
  const Workspace work = at_rest();
  give_layers(Layers(before, {}, work, dt, dt, h0, h0), pairs, rubs);
  EXPECT_EQ(pairs[0].layer, .9 * h0);
  EXPECT_EQ(pairs[0].impulse, dt * force);
}
