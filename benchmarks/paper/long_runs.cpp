// A million steps of a vibrating cell, of a spinning body and of a clamped strip, by the
// classical method, the law as printed and the law of the package.
#include <functional>

#include "paper/figures.h"
#include "paper/single_cell.h"

namespace forming_sim::bench {
namespace {

constexpr long kSteps = 1000000;
constexpr int kLooks = 50;
constexpr long kOfALook = kSteps / kLooks;

struct Case {
  const char* name;
  double turns;         ///< 0: does not spin
  Mesh mesh;
  /// Velocities at the start, v^(-1/2).
  std::function<void(SteppedBody&, double dt)> start;
};

struct Look {
  double volume = 0, angle = 0, energy = 0, momentum = 0;
};
struct Found {
  std::vector<Look> looks;  ///< means over kSteps / kLooks steps, weighted by sin^2
  double angle = 0;         ///< at the end
  std::string broken;       ///< why the run ended before kSteps
};

double turned(const SteppedBody& body) {
  // The mean rotation about z: of all nodes from where they started.
  double sine = 0, cosine = 0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const Node &a = body.X[i], &b = body.x[i];
    sine += body.mass()[i] * (a[0] * b[1] - a[1] * b[0]);
    cosine += body.mass()[i] * (a[0] * b[0] + a[1] * b[1]);
  }
  return std::atan2(sine, cosine);
}

Found run(const Case& what, const std::string& law) {
  SteppedBody body(what.mesh, cell_material(law));
  const double dt = 0.5 * body.stable_step();
  what.start(body, dt);
  Found found;
  Look sum;
  double before = 0, weights = 0;
  for (long n = 0; n < kSteps; ++n) {
    try {
      body.accelerate(dt);
    } catch (const Error& error) {
      found.broken = "after " + std::to_string(n) + " steps: " + error.what();
      break;
    }
    if (n % 37 == 0) {  // a rhythm that no vibration keeps
      const double now = turned(body);
      found.angle += std::remainder(now - before, 2 * M_PI);
      before = now;
      const double s = std::sin(M_PI * static_cast<double>(n % kOfALook) / static_cast<double>(kOfALook)), w = s * s;
      sum.volume += w * body.volume_ratio();
      sum.angle += w * found.angle;
      sum.energy += w * body.energy();
      sum.momentum += w * body.angular_momentum().z();
      weights += w;
    }
    body.move(dt);
    if ((n + 1) % kOfALook != 0) continue;
    found.looks.push_back({sum.volume / weights, sum.angle / weights, sum.energy / weights, sum.momentum / weights});
    sum = {};
    weights = 0;
  }
  found.angle += std::remainder(turned(body) - before, 2 * M_PI);
  return found;
}

Mesh block() {
  BlankConfig blank;
  blank.shape = "plate";
  blank.origin = Vec3(-0.5, -0.5, -0.25);
  blank.length = blank.width = 1;
  blank.thickness = 0.5;
  blank.cells_along = blank.cells_across = blank.cells_through = 2;
  return generate_blank(blank);
}

Mesh strip() {
  BlankConfig blank;
  blank.shape = "strip";
  blank.length = 1;
  blank.thickness = 0.25;
  blank.cells_along = 8;
  blank.cells_through = 2;
  return generate_blank(blank);
}

std::function<void(SteppedBody&, double)> spin(double turns) {
  return [turns](SteppedBody& body, double dt) {
    const double omega = 2 * M_PI * turns / (static_cast<double>(kSteps) * dt);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.v[i] = omega * Node(-body.X[i][1], body.X[i][0], 0, 0);
  };
}

}  // namespace

std::vector<Row> long_runs(const Request& request) {
  const Case cases[] = {
      {"cell", 0, square(1),
       [](SteppedBody& body, double) {  // stretches along x, gets thinner along y: strains of 1.5e-3
         for (std::size_t i = 0; i < body.x.size(); ++i) body.v[i] = 10 * Node(body.X[i][0], -body.X[i][1], 0, 0);
       }},
      {"block, 20 turns", 20, block(), spin(20)},
      {"block, 40 turns", 40, block(), spin(40)},
      {"clamped strip", 0, strip(),
       [](SteppedBody& body, double) {  // thrown upwards: bends by a few per cent of its length
         for (std::size_t i = 0; i < body.x.size(); ++i) {
           if (body.X[i][0] < 1e-9) body.free[i] = Node::Zero();
           body.v[i] = Node(0, 30 * body.X[i][0] * body.X[i][0], 0, 0);
         }
       }}};
  std::vector<Row> rows;
  for (const Case& what : cases) {
    const std::string name = what.name, file = what.turns > 0 ? "block_" + std::to_string(static_cast<int>(what.turns)) : name.substr(name.rfind(' ') + 1);
    Figure volume("long_runs_" + file + "_volume", "A million steps: " + name, "steps / 1000", "mean V/V0 (area in 2D)");
    Figure energy("long_runs_" + file + "_energy", "A million steps: " + name, "steps / 1000", "energy / energy at the start");
    for (const std::string law : {"classical", "paper", "green_elastic"}) {
      const Clock clock;
      const Found found = run(what, law);
      const double time = clock.seconds();
      if (found.looks.size() < kLooks) {
        Row row = just(name, law + ": runs to the end", 0, time);
        row.expected = 1, row.error = -1, row.holds = false, row.note = found.broken;
        rows.push_back(row);
        continue;
      }
      const std::vector<Look>& looks = found.looks;
      const Look &first = looks.front(), &last = looks.back();
      double off = 0, gained = 0, spun = 0;
      for (std::size_t i = 0; i < looks.size(); ++i) {
        const double at = static_cast<double>(kSteps) / 1000 * (static_cast<double>(i) + 0.5) / kLooks;
        volume.add(law, at, looks[i].volume);
        energy.add(law, at, looks[i].energy / first.energy);
        off = std::max(off, std::abs(looks[i].volume - first.volume));
        gained = std::max(gained, std::abs(looks[i].energy / first.energy - 1));
        spun = std::max(spun, std::abs(looks[i].momentum / first.momentum - 1));
      }
      // What a method should keep is expected of all of them.
      rows.push_back(at_most(name, law + ": change of V/V0", off, 1e-5, time));
      if (!rows.back().holds && what.turns > 0) rows.back().note = "a step of a turning body makes tr L dt = -(omega dt)^2 of pressure less than its volume says";
      rows.push_back(at_most(name, law + ": change of energy / energy", gained, 1e-3, time));
      if (what.turns > 0) {
        rows.push_back(near(name, law + ": turns", found.angle / (2 * M_PI), what.turns, 1e-3, time));
        rows.push_back(at_most(name, law + ": change of angular momentum / itself", spun, 1e-9, time));
      } else {
        rows.push_back(at_most(name, law + ": change of mean angle, degrees", std::abs(last.angle - first.angle) * 180 / M_PI, 1e-3, time));
      }
    }
    volume.write(request.directory);
    energy.write(request.directory);
  }
  rows.front().note = "10^6 steps of half the stable one; changes are those of means over 20000 steps, largest on the way";
  return rows;
}

}  // namespace forming_sim::bench
